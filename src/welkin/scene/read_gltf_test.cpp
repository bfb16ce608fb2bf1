#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "welkin/scene/scene_file_cases.h"

namespace welkin::scene {
namespace {

Scene read_text(const std::string& text, const Folder& folder = {}) {
  return read_bytes(bytes_of(text), "test.gltf", folder);
}

Vec3d world_vertex(const Scene& scene, std::size_t instance, std::size_t vertex) {
  const Instance& which = scene.instances.at(instance);
  const Vec3<float>& p = scene.meshes.at(static_cast<std::size_t>(which.mesh)).positions.at(vertex);
  return point_to(which.to_world, {p.x, p.y, p.z});
}

Vec3d area_of(const Scene& scene) {
  Vec3d sum{0, 0, 0};
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    for (const auto& t : mesh.triangles) {
      const auto at = [&](std::size_t i) {
        const Vec3<float>& p = mesh.positions[t[i]];
        return Vec3d{p.x, p.y, p.z};
      };
      sum = sum + 0.5 * cross(at(1) - at(0), at(2) - at(0));
    }
  }
  return sum;
}

bool has_warning(const Scene& scene, const std::string& part) {
  int found = 0;
  for (const std::string& warning : scene.warnings) found += warning.find(part) != std::string::npos;
  return found == 1;
}

TEST(ReadGltf, ReadsInterleavedMeshes) {
  const Scene scene = read_text(gltf_text(square_bytes()));
  EXPECT_NO_THROW(scene.check());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.uv[0].at(2), (std::array<float, 2>{1, 0}));
  EXPECT_NEAR(length(area_of(scene) - Vec3d{0, 0, 1}), 0, 1e-6);
  EXPECT_EQ(mesh.normals.at(3).z, 1);
}

TEST(ReadGltf, AGlbIsTheSame) {
  const Bytes buffer = square_bytes();
  std::string text = gltf_text(buffer);
  replace(text, R"(,"uri":"data:application/octet-stream;base64,)" + base64(buffer) + "\"", "");
  while (text.size() % 4) text += ' ';
  const auto size = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
  Bytes glb = bytes_of("glTF");
  append<std::uint32_t>(glb, {2, size(28 + text.size() + buffer.size()), size(text.size()), 0x4E4F534A});
  const Bytes json = bytes_of(text);
  glb.insert(glb.end(), json.begin(), json.end());
  append<std::uint32_t>(glb, {size(buffer.size()), 0x004E4942});
  glb.insert(glb.end(), buffer.begin(), buffer.end());
  const Scene scene = read_bytes(glb, "test.glb");
  EXPECT_EQ(scene.meshes.at(0).triangles, read_text(gltf_text(buffer)).meshes.at(0).triangles);
  EXPECT_NEAR(length(area_of(scene) - Vec3d{0, 0, 1}), 0, 1e-6);
  const int refused = read_damaged(glb, "test.glb");
  EXPECT_GT(refused, 400) << "all that are cut off";
  std::string message;
  glb.pop_back();
  EXPECT_EQ(fault_of(glb, "test.glb", &message), ErrorKind::damaged);
  EXPECT_NE(message.find("test.glb: "), std::string::npos);
  EXPECT_NE(message.find("cut off"), std::string::npos);
}

TEST(ReadGltf, StripsAndFansAreTheSameSquare) {
  for (const auto& [mode, indices] : {std::pair{5, std::vector<std::uint16_t>{0, 1, 3, 2}},
                                      std::pair{6, std::vector<std::uint16_t>{0, 1, 2, 3}}}) {
    Bytes buffer = square_bytes();
    buffer.resize(128);
    for (const std::uint16_t index : indices) append<std::uint16_t>(buffer, {index});
    append<std::uint32_t>(buffer, {0});
    std::string text = gltf_text(buffer);
    replace(text, "\"count\":6", "\"count\":4");
    replace(text, "\"indices\":3", "\"indices\":3,\"mode\":" + std::to_string(mode));
    const Scene scene = read_text(text);
    EXPECT_EQ(scene.meshes.at(0).triangles.size(), 2u) << mode;
    EXPECT_NEAR(length(area_of(scene) - Vec3d{0, 0, 1}), 0, 1e-6) << mode;
  }
}

TEST(ReadGltf, SparseElementsReplaceOthers) {
  Bytes buffer = square_bytes();
  append<std::uint32_t>(buffer, {2});
  append<float>(buffer, {3, 3, 0});
  std::string text = gltf_text(buffer);
  replace(text, R"("count":4,"type":"VEC3"})",
          R"("count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":2,"componentType":5125},)"
          R"("values":{"bufferView":2,"byteOffset":4}}})");
  replace(text, R"("byteLength":12})", R"("byteLength":12},{"buffer":0,"byteOffset":140,"byteLength":16})");
  replace(text, R"("byteLength":140)", R"("byteLength":156)");
  const Scene scene = read_text(text);
  EXPECT_EQ(scene.meshes.at(0).positions.at(2).x, 3);
  EXPECT_EQ(scene.meshes.at(0).positions.at(1).x, 1);
  replace(text, R"("sparse":{"count":1)", R"("sparse":{"count":5)");
  EXPECT_EQ(fault_of(bytes_of(text), "test.gltf"), ErrorKind::damaged);
}

TEST(ReadGltf, NodesStandInEachOther) {
  // Moved, then turned by 90° about +Y (z to x), then doubled; its child is shifted by a matrix.
  const Scene scene = read_text(gltf_text(
      square_bytes(), "{}",
      R"({"translation":[1,2,3],"rotation":[0,0.70710678118,0,0.70710678118],"scale":[2,2,2],"children":[1]},)"
      R"({"name":"child","mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]})"));
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "child");
  // (1, 0, 0) → (1, 0, 5) → (2, 0, 10) → (10, 0, −2) → (11, 2, 1)
  EXPECT_NEAR(length(world_vertex(scene, 0, 1) - Vec3d{11, 2, 1}), 0, 1e-6);
}

TEST(ReadGltf, MaterialsHaveAllTheirNumbers) {
  const Scene scene = read_text(gltf_text(
      square_bytes(),
      R"({"name":"all","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.6},)"
      R"("emissiveFactor":[0.1,0.2,0.3],"alphaMode":"MASK","alphaCutoff":0.7,"doubleSided":true,"extensions":{)"
      R"("KHR_materials_ior":{"ior":1.33},"KHR_materials_transmission":{"transmissionFactor":0.9},)"
      R"("KHR_materials_clearcoat":{"clearcoatFactor":0.8,"clearcoatRoughnessFactor":0.05},)"
      R"("KHR_materials_sheen":{"sheenColorFactor":[0.4,0.5,0.6],"sheenRoughnessFactor":0.3},)"
      R"("KHR_materials_anisotropy":{"anisotropyStrength":0.25,"anisotropyRotation":1.5},)"
      R"("KHR_materials_emissive_strength":{"emissiveStrength":10}}},)"
      R"({"name":"flat","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]},"extensions":{"KHR_materials_unlit":{}}})"));
  ASSERT_EQ(scene.materials.size(), 3u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.base_color, (std::array<float, 3>{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(m.alpha, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_FLOAT_EQ(m.emission[2], 3);
  EXPECT_TRUE(m.masked && !m.blended && m.two_sided);
  EXPECT_EQ(m.alpha_cutoff, 0.7f);
  EXPECT_EQ(m.ior, 1.33f);
  EXPECT_EQ(m.transmission, 0.9f);
  EXPECT_EQ(m.clearcoat, 0.8f);
  EXPECT_EQ(m.clearcoat_roughness, 0.05f);
  EXPECT_EQ(m.sheen_color[1], 0.5f);
  EXPECT_EQ(m.sheen_roughness, 0.3f);
  EXPECT_EQ(m.anisotropy, 0.25f);
  EXPECT_EQ(m.anisotropy_angle, 1.5f);
  EXPECT_EQ(scene.materials[1].emission, (std::array<float, 3>{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(scene.materials[1].base_color, (std::array<float, 3>{}));
  EXPECT_EQ(scene.materials[2].metallic, 1) << "as glTF's default";
}

// 188 of sRGB is 0.5029 (IEC 61966-2-1); as data it is 188/255.
TEST(ReadGltf, PicturesAreLinearByTheirUse) {
  const std::string uri = "data:image/png;base64," + base64(small_png());
  const Scene scene = read_text(gltf_text(
      square_bytes(),
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
      R"({"offset":[0.5,0.25],"scale":[2,3],"rotation":1}}},"metallicRoughnessTexture":{"index":0}},)"
      R"("emissiveTexture":{"index":1}})",
      R"({"mesh":0})",
      R"(,"textures":[{"source":0},{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],)"
      R"("images":[{"uri":")" +
          uri + "\"}]"));
  const Material& m = scene.materials.at(0);
  ASSERT_EQ(scene.pictures.size(), 3u) << "sRGB, data, and with other edges";
  const Picture& base = scene.pictures.at(static_cast<std::size_t>(m.base_map.picture));
  EXPECT_NEAR(base.image.at(0, 0)[0], 0.5029, 1e-3);
  EXPECT_NEAR(base.image.at(1, 0)[1], 0.5029, 5e-3) << "not multiplied by its coverage";
  EXPECT_NEAR(base.image.at(1, 0)[3], 128 / 255.0, 1e-6);
  const Picture& data = scene.pictures.at(static_cast<std::size_t>(m.metallic_roughness_map.picture));
  EXPECT_NEAR(data.image.at(0, 0)[0], 188 / 255.0, 1e-6);
  const Picture& emission = scene.pictures.at(static_cast<std::size_t>(m.emission_map.picture));
  EXPECT_EQ(emission.across, Wrap::clamp);
  EXPECT_EQ(emission.down, Wrap::mirror);
  EXPECT_EQ(m.base_map.offset, (std::array<float, 2>{0.5f, 0.25f}));
  EXPECT_EQ(m.base_map.scale, (std::array<float, 2>{2, 3}));
  EXPECT_EQ(m.base_map.angle, 1);
}

TEST(ReadGltf, ExtensionsHaveTheirPictures) {
  const std::string uri = "data:image/png;base64," + base64(small_png());
  const Scene scene = read_text(gltf_text(
      square_bytes(),
      R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessTexture":{"index":0}},)"
      R"("KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenColorTexture":{"index":0},)"
      R"("sheenRoughnessTexture":{"index":0}},)"
      R"("KHR_materials_anisotropy":{"anisotropyStrength":1,"anisotropyTexture":{"index":0}}}})",
      R"({"mesh":0})", R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + "\"}]"));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  const Material& m = scene.materials.at(0);
  ASSERT_EQ(scene.pictures.size(), 2u) << "sRGB and data";
  EXPECT_NE(m.sheen_color_map.picture, m.sheen_roughness_map.picture) << "the colour alone is sRGB";
  EXPECT_EQ(m.sheen_roughness_map.picture, m.anisotropy_map.picture);
  EXPECT_EQ(m.sheen_roughness_map.picture, m.clearcoat_roughness_map.picture);
  EXPECT_FALSE(scene.meshes.at(0).tangents.empty()) << "anisotropy has a direction";
}

/// The square with the colours of its corners behind its indices.
std::string colored_square(const std::string& accessor, const Bytes& colors, const std::string& materials) {
  Bytes buffer = square_bytes();
  buffer.insert(buffer.end(), colors.begin(), colors.end());
  std::string text = gltf_text(buffer, materials);
  const auto size = std::to_string(colors.size());
  replace(text, R"("TEXCOORD_0":2)", R"("TEXCOORD_0":2,"COLOR_0":4)");
  replace(text, R"("type":"SCALAR"})",
          R"("type":"SCALAR"},{"bufferView":2,"count":4,"normalized":)" + accessor + "}");
  replace(text, R"("byteLength":12})",
          R"("byteLength":12},{"buffer":0,"byteOffset":140,"byteLength":)" + size + "}");
  replace(text, R"("byteLength":140)", R"("byteLength":)" + std::to_string(140 + colors.size()));
  return text;
}

TEST(ReadGltf, VerticesHaveColors) {
  Bytes three, four;
  append<float>(three, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.25f, 0.5f, 0.75f});
  append<std::uint8_t>(four, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 51, 102, 153, 204});
  const Scene rgb = read_text(colored_square(R"(false,"componentType":5126,"type":"VEC3")", three, "{}"));
  EXPECT_TRUE(rgb.warnings.empty()) << rgb.warnings[0];
  ASSERT_EQ(rgb.meshes.at(0).colors.size(), 4u);
  EXPECT_EQ(rgb.meshes[0].colors[3], (std::array<float, 4>{0.25f, 0.5f, 0.75f, 1}));
  const std::string text = colored_square(R"(true,"componentType":5121,"type":"VEC4")", four, "{}");
  const Scene rgba = read_text(text);
  ASSERT_EQ(rgba.meshes.at(0).colors.size(), 4u);
  EXPECT_EQ(rgba.meshes[0].colors[1], (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_FLOAT_EQ(rgba.meshes[0].colors[3][3], 0.8f);
  EXPECT_GT(read_damaged(bytes_of(text), "test.gltf"), 400);
  // What isn't a colour is mended and told.
  const float nan = std::numeric_limits<float>::quiet_NaN(), below = -1;
  std::memcpy(three.data(), &nan, 4);
  std::memcpy(three.data() + 12, &below, 4);
  const Scene mended = read_text(colored_square(R"(false,"componentType":5126,"type":"VEC3")", three, "{}"));
  EXPECT_NO_THROW(mended.check());
  EXPECT_EQ(mended.meshes.at(0).colors[0][0], 0);
  EXPECT_TRUE(has_warning(mended, "2 colours of vertices"));
  std::string message;
  EXPECT_EQ(fault_of(bytes_of(colored_square(R"(false,"componentType":5126,"type":"VEC2")", three, "{}")),
                     "test.gltf", &message),
            ErrorKind::damaged);
  EXPECT_NE(message.find("colours"), std::string::npos) << message;
}

TEST(ReadGltf, MissingPicturesCountAsWhite) {
  const Scene scene = read_text(
      gltf_text(square_bytes(),
                R"({"normalTexture":{"index":0},"emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]})",
                R"({"mesh":0})", R"(,"textures":[{"source":0}],"images":[{"uri":"gone.png"}])"));
  EXPECT_FALSE(scene.materials.at(0).normal_map);
  EXPECT_TRUE(has_warning(scene, "gone.png")) << "once";
}

// The bitangent goes up in the picture, against v.
TEST(ReadGltf, NormalMapsBringTangents) {
  const std::string uri = "data:image/png;base64," + base64(small_png());
  const std::string more = R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + "\"}]";
  std::string text =
      gltf_text(square_bytes(), R"({"normalTexture":{"index":0,"scale":0.5}})", R"({"mesh":0})", more);
  for (const bool flat : {false, true}) {
    if (flat) replace(text, R"("NORMAL":1,)", "");
    const Scene scene = read_text(text);
    EXPECT_NO_THROW(scene.check());
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), flat ? 6u : 4u);
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
    for (const auto& tangent : mesh.tangents) EXPECT_EQ(tangent, (std::array<float, 4>{1, 0, 0, 1}));
    EXPECT_EQ(scene.materials.at(0).normal_scale, 0.5f);
  }
}

TEST(ReadGltf, CamerasLookAlongMinusZ) {
  const Scene scene = read_text(gltf_text(
      square_bytes(), "{}", R"({"mesh":0,"children":[1]},{"camera":0,"translation":[1,2,3],"scale":[3,3,3]})",
      R"(,"cameras":[{"type":"perspective","name":"eye","perspective":{"yfov":1.0471975512,"znear":0.1,"aspectRatio":1.5}}])"));
  ASSERT_EQ(scene.cameras.size(), 1u);
  const SceneCamera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "eye");
  EXPECT_NEAR(camera.vertical_fov, 60, 1e-6);
  EXPECT_EQ(camera.aspect, 1.5);
  EXPECT_NEAR(length(camera.rotation * Vec3d{0, 0, 1} - Vec3d{0, 0, -1}), 0, 1e-12) << "ahead";
  EXPECT_NEAR(length(camera.rotation * Vec3d{-1, 0, 0} - Vec3d{1, 0, 0}), 0, 1e-12) << "right";
  EXPECT_NEAR(length(camera.rotation * Vec3d{0, 1, 0} - Vec3d{0, 1, 0}), 0, 1e-12) << "up";
  EXPECT_EQ(camera.position.z, 3);
}

TEST(ReadGltf, LightsShineAlongMinusZ) {
  const Scene scene = read_text(gltf_text(
      square_bytes(), "{}",
      R"({"mesh":0,"children":[1]},{"rotation":[-0.70710678118,0,0,0.70710678118],"extensions":{"KHR_lights_punctual":{"light":0}}})",
      R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot",)"
      R"("color":[1,0.5,0],"intensity":20,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.3}}]}})"));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, PointLight::Kind::spot);
  EXPECT_NEAR(length(scene.lights[0].direction - Vec3d{0, -1, 0}), 0, 1e-6);
  EXPECT_EQ(scene.lights[0].intensity, (std::array<float, 3>{20, 10, 0}));
  EXPECT_EQ(scene.lights[0].outer_cone, 0.3);
}

TEST(ReadGltf, MendsNormalsAndDropsTrianglesWithoutArea) {
  Bytes buffer = square_bytes();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(buffer.data() + 12, &nan, 4);
  const std::uint16_t same = 0;
  std::memcpy(buffer.data() + 128 + 8, &same, 2);  // 0 1 2, 0 0 3
  const Scene scene = read_text(gltf_text(buffer));
  EXPECT_NO_THROW(scene.check());
  EXPECT_EQ(scene.meshes.at(0).triangles.size(), 1u);
  EXPECT_EQ(scene.meshes.at(0).normals.at(0).z, 1);
  EXPECT_TRUE(has_warning(scene, "1 triangles without area"));
  EXPECT_TRUE(has_warning(scene, "1 normals"));
}

TEST(ReadGltf, TellsUnknownExtensionsOnceByName) {
  const Scene scene =
      read_text(gltf_text(square_bytes(), "{}", R"({"mesh":0})",
                          R"(,"extensionsUsed":["EXT_unheard_of","EXT_unheard_of","KHR_materials_ior"])"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("EXT_unheard_of"), std::string::npos);
}

TEST(ReadGltf, RefusesWhatIsWrong) {
  struct Case {
    const char* from;
    const char* to;
    ErrorKind kind;
    const char* says;
  };
  const Case cases[] = {
      {"\"version\":\"2.0\"", "\"version\":\"1.0\"", ErrorKind::unsupported, "version '1.0'"},
      {"\"asset\"", "\"other\"", ErrorKind::damaged, "asset"},
      {"\"scene\":0", "\"scene\":7", ErrorKind::damaged, "no scene 7"},
      {"{\"nodes\":[0]}", "{\"nodes\":[4]}", ErrorKind::damaged, "no node 4"},
      {"{\"mesh\":0}", "{\"mesh\":3}", ErrorKind::damaged, "mesh that there isn't"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}", ErrorKind::damaged, "its own ancestor"},
      {"{\"mesh\":0}", "{\"name\":\"empty\"}", ErrorKind::unsupported, "no triangles"},
      {"\"material\":0", "\"material\":9", ErrorKind::damaged, "material that there isn't"},
      {"\"POSITION\":0", "\"POSITION\":9", ErrorKind::damaged, "accessor that there isn't"},
      {"\"POSITION\":0", "\"POSITION\":2", ErrorKind::damaged, "components"},
      {"\"TEXCOORD_0\":2", "\"TEXCOORD_0\":0", ErrorKind::damaged, "components"},
      {"\"count\":4", "\"count\":5", ErrorKind::damaged, "don't fit"},
      {"\"count\":4", "\"count\":18446744073709551615", ErrorKind::too_large, "200,000,000"},
      {"\"count\":6", "\"count\":7", ErrorKind::damaged, "don't fit"},
      {"\"bufferView\":1", "\"bufferView\":8", ErrorKind::damaged, "invalid bufferView"},
      {"\"byteOffset\":128", "\"byteOffset\":18446744073709551600", ErrorKind::damaged, "leaves its buffer"},
      {"\"byteStride\":32", "\"byteStride\":8", ErrorKind::damaged, "overlap"},
      {"\"byteLength\":140", "\"byteLength\":141", ErrorKind::damaged, "should have 141 bytes"},
      {"\"byteLength\":140", "\"byteLength\":-1", ErrorKind::damaged, "byteLength"},
      {";base64,", ";base64,!", ErrorKind::damaged, "base64"},
      {"data:application/octet-stream;base64,", "other.bin?", ErrorKind::not_found, "other.bin?"},
      {"\"scene\":0", "\"scene\":0,\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]",
       ErrorKind::unsupported, "KHR_draco_mesh_compression"},
      {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[0,1,1]}", ErrorKind::unsupported, "no triangles"},
      {"{\"mesh\":0}",
       "{\"mesh\":0,\"translation\":[1e300,0,0],\"children\":[1]},{\"scale\":[1e308,1e308,1e308],"
       "\"children\":[2]},"
       "{\"scale\":[1e308,1e308,1e308]}",
       ErrorKind::damaged, "not finite"},
  };
  for (const Case& each : cases) {
    std::string text = gltf_text(square_bytes()), message;
    replace(text, each.from, each.to);
    EXPECT_EQ(fault_of(bytes_of(text), "test.gltf", &message), each.kind) << each.to << ": " << message;
    EXPECT_NE(message.find(each.says), std::string::npos) << each.to << ": " << message;
  }
  Bytes buffer = square_bytes();
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(buffer.data(), &infinite, 4);
  EXPECT_EQ(fault_of(bytes_of(gltf_text(buffer)), "test.gltf"), ErrorKind::bad_value);
  buffer = square_bytes();
  const std::uint16_t far = 4;
  std::memcpy(buffer.data() + 128, &far, 2);
  EXPECT_EQ(fault_of(bytes_of(gltf_text(buffer)), "test.gltf"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of("{"), "a.gltf"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of(std::string(100'000, '[')), "a.gltf"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of("{" + std::string(100'000, '[')), "a.gltf"), ErrorKind::damaged);
  EXPECT_EQ(fault_of({}, "a.gltf"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of("solid"), "a.stl"), ErrorKind::unsupported);
}

TEST(ReadGltf, DamagedFilesAreErrorsOrScenes) {
  const std::string uri = "data:image/png;base64," + base64(small_png());
  const std::string text = gltf_text(square_bytes(), R"({"normalTexture":{"index":0}})",
                                     R"({"mesh":0,"children":[1]},{"translation":[1,2,3]})",
                                     R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + "\"}]");
  EXPECT_GT(read_damaged(bytes_of(text), "test.gltf"), 400) << "all that are cut off";
}

}  // namespace
}  // namespace welkin::scene
