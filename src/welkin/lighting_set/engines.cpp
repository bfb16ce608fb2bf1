#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/lighting_set/engine.h"
#include "welkin/lighting_set/resources.h"

namespace welkin {
namespace {

using enum SetContent;

SetFile specular_file(std::string name, std::string about, int width, int levels, std::string curve,
                      std::string convention, std::string type, std::string compression = "") {
  SetFile file;
  file.content = specular;
  file.name = std::move(name);
  file.about = std::move(about);
  file.width = width;
  file.levels = levels;
  file.curve = std::move(curve);
  file.convention = std::move(convention);
  file.type = std::move(type);
  file.compression = std::move(compression);
  return file;
}

SetFile diffuse_file(std::string name, std::string about, int width, std::string convention, std::string type,
                     std::string compression = "") {
  SetFile file;
  file.content = diffuse;
  file.name = std::move(name);
  file.about = std::move(about);
  file.width = width;
  file.convention = std::move(convention);
  file.type = std::move(type);
  file.compression = std::move(compression);
  return file;
}

SetFile harmonics_file(std::string name, std::string about, std::string basis, std::string convention) {
  SetFile file;
  file.content = harmonics;
  file.name = std::move(name);
  file.about = std::move(about);
  file.basis = std::move(basis);
  file.convention = std::move(convention);
  return file;
}

SetFile table_file(std::string name, std::string about, std::string table, std::string type) {
  SetFile file;
  file.content = SetContent::table;
  file.name = std::move(name);
  file.about = std::move(about);
  file.table = std::move(table);
  file.type = std::move(type);
  return file;
}

SetFile panorama_file(std::string name, std::string about, std::string convention, std::string type = "") {
  SetFile file;
  file.content = background;
  file.name = std::move(name);
  file.about = std::move(about);
  file.to = "latlong";
  file.convention = std::move(convention);
  file.type = std::move(type);
  return file;
}

Engine general() {
  Engine engine;
  engine.name = "general";
  engine.title = "any renderer";
  engine.summary = "specular and diffuse cubes, DFG table, harmonics, in the native world";
  engine.source = "docs/conventions.md, docs/chains.md";
  engine.files = {
      specular_file("specular.ktx2", "GGX; level = roughness · (levels − 1)", 256, 0, "linear", "native",
                    "bc6h", "zstd"),
      diffuse_file("diffuse.ktx2", "irradiance / π, looked up along the normal", 32, "native", "half"),
      table_file("dfg.ktx2", "f0 · red + f90 · green, over n·v and roughness", "bevy", "half"),
      harmonics_file("harmonics.json", "radiance, real orthonormal, order 2", "orthonormal", "native"),
  };
  engine.snippet = lighting_set::snippet("general.glsl");
  return engine;
}

Engine three_js() {
  Engine engine;
  engine.name = "three.js";
  engine.title = "three.js r187";
  engine.summary = "one UASTC HDR cube that KTX2Loader takes as it is, and a LightProbe";
  engine.run = true;
  engine.source =
      "examples/jsm/loaders/KTX2Loader.js, "
      "src/renderers/shaders/ShaderChunk/cube_uv_reflection_fragment.glsl.js";
  engine.files = {
      specular_file("environment.ktx2", "scene.environment and scene.background", 256, 6, "three.js",
                    "three.js", "uastc-hdr", "zstd"),
      harmonics_file("harmonics.json", "for a LightProbe", "three.js", "three.js"),
  };
  engine.limits.types = {"uastc-hdr"};
  engine.limits.types_reason =
      "KTX2Loader gives uncompressed cubes back as flat pictures and refuses BC6H cubes";
  engine.limits.fewest_levels = 4;
  engine.limits.most_levels = 6;
  engine.limits.levels_reason = "its last level is the diffuse light, and of 8 texels or more";
  engine.limits.power_of_two = true;
  engine.limits.narrowest = 64;
  engine.limits.width_reason = "it reads faces of a power of two, from 64 on";
  engine.snippet = lighting_set::snippet("three.js");
  return engine;
}

/// Releases that have no chains of cubes in files.
Engine older_three_js() {
  Engine engine;
  engine.name = "three.js,r186";
  engine.title = "three.js up to r186";
  engine.summary = "a panorama, which it filters itself, and a LightProbe";
  engine.source = "src/extras/PMREMGenerator.js, examples/jsm/loaders/RGBELoader.js";
  engine.files = {panorama_file("panorama.hdr", "scene.environment and scene.background", "three.js"),
                  harmonics_file("harmonics.json", "for a LightProbe", "three.js", "three.js")};
  engine.snippet = lighting_set::snippet("three.js-r186.js");
  return engine;
}

Engine model_viewer() {
  Engine engine;
  engine.name = "model-viewer";
  engine.title = "model-viewer 4";
  engine.summary = "a panorama, which it filters itself";
  engine.source = "packages/model-viewer/src/three-components/TextureUtils.ts";
  engine.files = {panorama_file("panorama.hdr", "environment-image and skybox-image", "three.js")};
  engine.snippet = lighting_set::snippet("model-viewer.html");
  return engine;
}

Engine filament() {
  Engine engine;
  engine.name = "filament";
  engine.title = "Filament 1.53";
  engine.summary = "two KTX 1 cubes and harmonics, as its cmgen writes them";
  engine.run = true;
  engine.source = "tools/cmgen/src/cmgen.cpp, libs/ktxreader/src/Ktx1Reader.cpp";
  engine.files = {
      specular_file("environment_ibl.ktx", "reflections", 256, 5, "filament", "filament", "half"),
      [] {
        SetFile file = panorama_file("environment_skybox.ktx", "the skybox", "filament", "half");
        file.to = "cube";
        file.width = 512;
        return file;
      }(),
      harmonics_file("sh.txt", "irradiance, for IndirectLight.Builder.irradianceSh", "filament", "filament"),
  };
  engine.limits.types = {"half", "float"};
  engine.limits.types_reason = "its KTX 1 reader in the browser takes half and float cubes";
  engine.limits.fewest_levels = 5;
  engine.limits.most_levels = 5;
  engine.limits.levels_reason = "its shader reads five levels";
  engine.limits.power_of_two = true;
  engine.limits.width_reason = "its levels halve faces of a power of two";
  engine.snippet = lighting_set::snippet("filament.js");
  return engine;
}

Engine playcanvas() {
  Engine engine;
  engine.name = "playcanvas";
  engine.title = "PlayCanvas 2.23";
  engine.summary = "a DDS of half floats that is its atlas of reflections and diffuse light";
  engine.run = true;
  engine.source = "src/scene/graphics/env-lighting.js, src/framework/parsers/texture/dds.js";
  SetFile file;
  file.content = atlas;
  file.name = "environment.dds";
  file.about = "scene.envAtlas";
  file.convention = "playcanvas";
  file.type = "half";
  engine.files = {std::move(file)};
  engine.limits.levels_reason = "its atlas has sizes, levels and roughnesses of its own";
  engine.snippet = lighting_set::snippet("playcanvas.js");
  return engine;
}

Engine babylon(bool right_handed) {
  Engine engine;
  engine.name = right_handed ? "babylon,right-handed" : "babylon";
  engine.title = right_handed ? "Babylon.js 9, scenes with useRightHandedSystem" : "Babylon.js 9";
  engine.summary = "one .env file, which holds the harmonics too";
  engine.run = true;
  engine.source = "packages/dev/core/src/Misc/environmentTextureTools.ts";
  engine.files = {specular_file("environment.env", "reflections, background and diffuse light", 256, 0,
                                "babylon", right_handed ? "babylon-right-handed" : "babylon", "")};
  // The curve begins at roughness 1/16, below which the engine reads level 0 too.
  engine.files[0].mirror_level0 = true;
  engine.limits.all_levels = true;
  engine.limits.levels_reason = "an .env file has all levels, down to one texel";
  engine.limits.power_of_two = true;
  engine.limits.width_reason = "an .env file has faces of a power of two";
  engine.snippet = lighting_set::snippet("babylon.js");
  return engine;
}

Engine gltf(bool right_handed) {
  Engine engine;
  engine.name = right_handed ? "gltf,right-handed" : "gltf";
  engine.title = right_handed
                     ? "glTF with EXT_lights_image_based, in Babylon.js 9, scenes with useRightHandedSystem"
                     : "glTF with EXT_lights_image_based, in Babylon.js 9";
  engine.summary = "one .glb, a scene that holds nothing but the light";
  engine.run = true;
  engine.source =
      "KhronosGroup/glTF, extensions/2.0/Vendor/EXT_lights_image_based; "
      "packages/dev/loaders/src/glTF/2.0/Extensions/EXT_lights_image_based.ts";
  engine.files = {specular_file("environment.glb", "reflections and diffuse light", 256, 5,
                                std::string(kGltfCurve), right_handed ? "babylon-right-handed" : "babylon",
                                "")};
  engine.files[0].mirror_level0 = true;
  engine.limits.fewest_levels = 2;
  engine.limits.levels_reason = "its first level is a mirror's, its last that of roughness 1";
  engine.limits.power_of_two = true;
  engine.limits.narrowest = 16;
  engine.limits.width_reason = "the extension has faces of a power of two, down to some 16 texels";
  engine.snippet = lighting_set::snippet("gltf.js");
  return engine;
}

Engine cesium() {
  Engine engine;
  engine.name = "cesium";
  engine.title = "CesiumJS 1.145";
  engine.summary = "a KTX2 cube of half floats, and nine harmonics";
  engine.run = true;
  engine.source = "packages/engine/Source/Scene/ImageBasedLighting.js";
  engine.files = {
      specular_file("environment.ktx2", "reflections", 256, 0, "cesium", "cesium", "half"),
      harmonics_file("harmonics.json", "for sphericalHarmonicCoefficients", "filament", "cesium"),
  };
  engine.limits.types = {"half", "float"};
  engine.limits.types_reason = "its loader takes KTX2 cubes of half and float without supercompression";
  engine.limits.power_of_two = true;
  engine.limits.width_reason = "its loader takes faces of a power of two";
  engine.snippet = lighting_set::snippet("cesium.js");
  return engine;
}

Engine bevy() {
  Engine engine;
  engine.name = "bevy";
  engine.title = "Bevy";
  engine.summary = "two KTX2 cubes for an EnvironmentMapLight";
  engine.source = "crates/bevy_pbr/src/light_probe/environment_map.wesl, crates/bevy_image/src/ktx2.rs";
  engine.files = {
      diffuse_file("diffuse.ktx2", "EnvironmentMapLight::diffuse_map", 32, "bevy", "rgb9e5", "zstd"),
      specular_file("specular.ktx2", "EnvironmentMapLight::specular_map", 256, 0, "bevy", "bevy", "rgb9e5",
                    "zstd"),
  };
  engine.limits.types = {"rgb9e5", "half", "r11g11b10", "bc6h"};
  engine.limits.types_reason = "it filters the texture, which graphics cards don't of 32-bit floats";
  engine.snippet = lighting_set::snippet("bevy.rs");
  return engine;
}

Engine godot() {
  Engine engine;
  engine.name = "godot";
  engine.title = "Godot 4";
  engine.summary = "a panorama, which it filters itself";
  engine.source = "scene/resources/3d/sky_material.cpp";
  engine.files = {panorama_file("panorama.exr", "PanoramaSkyMaterial.panorama", "godot", "half")};
  engine.snippet = lighting_set::snippet("godot.gd");
  return engine;
}

Engine o3de() {
  Engine engine;
  engine.name = "o3de";
  engine.title = "Open 3D Engine";
  engine.summary = "DDS cubes, named so that its importer knows them";
  engine.source = "Gems/Atom/Asset/ImageProcessingAtom; which way its faces look was not found out";
  SetFile sky = panorama_file("environment_iblskyboxcm.dds", "the skybox", "left-handed", "rgb9e5");
  sky.to = "cube";
  sky.width = 1024;
  engine.files = {specular_file("environment_iblspecularcm256.dds", "reflections", 256, 0, "linear",
                                "left-handed", "rgb9e5"),
                  diffuse_file("environment_ibldiffusecm.dds", "irradiance / π", 32, "left-handed", "rgb9e5"),
                  std::move(sky)};
  return engine;
}

Engine khronos() {
  Engine engine;
  engine.name = "khronos";
  engine.title = "Khronos glTF Sample Viewer";
  engine.summary = "KTX2 cubes of GGX, Charlie and Lambert, and its three tables";
  engine.source = "source/GltfState/environment.js, source/ibl_sampler.js";
  SetFile cloth = specular_file("charlie.ktx2", "u_CharlieEnvSampler", 256, 0, "linear", "native", "half");
  cloth.content = sheen;
  engine.files = {specular_file("ggx.ktx2", "u_GGXEnvSampler", 256, 0, "linear", "native", "half"),
                  std::move(cloth),
                  diffuse_file("lambertian.ktx2", "u_LambertianEnvSampler", 256, "native", "half"),
                  table_file("lut_ggx.png", "u_GGXLUT", "khronos", "uint8"),
                  table_file("lut_charlie.png", "u_CharlieLUT, of which blue is read", "khronos", "uint8"),
                  table_file("lut_sheen_E.png", "u_SheenELUT", "khronos-sheen", "uint8")};
  return engine;
}

Engine imported(const char* name, const char* title, const char* file, const char* basis, const char* summary,
                const char* source) {
  Engine engine;
  engine.name = name;
  engine.title = title;
  engine.summary = summary;
  engine.source = source;
  engine.files = {panorama_file(file, "import it as a cube map", name),
                  harmonics_file("harmonics.h", "the shader's constants", basis, name)};
  return engine;
}

}  // namespace

std::string_view name_of(SetContent content) {
  switch (content) {
    case specular:
      return "specular";
    case sheen:
      return "sheen";
    case atlas:
      return "atlas";
    case diffuse:
      return "diffuse";
    case background:
      return "background";
    case harmonics:
      return "harmonics";
    case table:
      break;
  }
  return "table";
}

const std::vector<Engine>& engines() {
  static const std::vector<Engine> all{
      general(),
      babylon(false),
      babylon(true),
      bevy(),
      cesium(),
      filament(),
      gltf(false),
      gltf(true),
      godot(),
      khronos(),
      model_viewer(),
      o3de(),
      playcanvas(),
      three_js(),
      older_three_js(),
      imported(
          "unity", "Unity", "panorama.hdr", "unity",
          "a panorama, which it filters on import, and its shaders' harmonics",
          "com.unity.render-pipelines.core/ShaderLibrary/ImageBasedLighting.hlsl; its importer's settings"),
      imported("unreal", "Unreal Engine 5", "panorama.hdr", "unreal",
               "a long-lat panorama, which it filters on import, and its shaders' harmonics",
               "Engine/Source/Runtime/Engine/Private/TextureCube.cpp, ReflectionEnvironmentShared.ush"),
  };
  return all;
}

const Engine& engine_from_name(std::string_view name) {
  const std::vector<Engine>& all = engines();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Engine& e) { return e.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const Engine& each : all) names.push_back(each.name);
  throw Error(ErrorKind::bad_request, unknown_name("engine", std::string(name), names));
}

}  // namespace welkin
