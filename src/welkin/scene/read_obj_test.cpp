#include <gtest/gtest.h>

#include "welkin/scene/scene_file_cases.h"
#include "welkin/scene/shape_cases.h"

namespace welkin::scene {
namespace {

// A cube of quadrilaterals and one pentagon's worth of relative indices is all that is needed.
const char* const kCube =
    "mtllib cube.mtl\n"
    "o cube\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl red\n"
    "f 5/1 6/2 7/3 8/4\nf 2/1 1/2 4/3 3/4\nf 6/1 2/2 3/3 7/4\n"
    "usemtl lamp\n"
    "f -8/1 -4/2 -1/3 -5/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";
const char* const kMaterials =
    "newmtl red\nKd 0.8 0.1 0.05\nKs 0.5 0.5 0.5\nNs 98\nNi 1.4\nmap_Kd skin.png\n"
    "newmtl lamp\nKd 0 0 0\nKe 5 4 3\n";

TEST(ReadObj, ReadsFacesAndMaterials) {
  const Folder folder{{"cube.mtl", bytes_of(kMaterials)}, {"skin.png", small_png()}};
  const Scene scene = read_bytes(bytes_of(kCube), "cube.obj", folder);
  EXPECT_NO_THROW(scene.check());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  ASSERT_EQ(scene.meshes.size(), 2u) << "one for each material";
  EXPECT_EQ(triangle_count(scene), 12u);
  EXPECT_NEAR(volume_of(scene.meshes[0]) + volume_of(scene.meshes[1]), 1, 1e-6);
  EXPECT_TRUE(scene.meshes[0].normals.empty()) << "flat";
  ASSERT_EQ(scene.materials.size(), 3u);
  const Material& red = scene.materials[0];
  EXPECT_EQ(red.base_color[0], 0.8f);
  EXPECT_EQ(red.ior, 1.4f);
  EXPECT_NEAR(red.roughness, std::pow(2.0 / 100, 0.25), 1e-6) << "α² = 2/(n + 2)";
  ASSERT_TRUE(red.base_map);
  EXPECT_NEAR(scene.pictures.at(0).image.at(0, 0)[0], 0.5029, 1e-3);
  EXPECT_EQ(scene.materials[1].emission, (std::array<float, 3>{5, 4, 3}));
  EXPECT_EQ(scene.materials[1].ior, 1) << "nothing shines";
  // v runs up there, down here.
  EXPECT_EQ(scene.meshes[0].uv[0].at(0), (std::array<float, 2>{0, 1}));
}

TEST(ReadObj, NormalsAreKept) {
  const Scene scene =
      read_bytes(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nf 1//1 2//1 3//1\n"), "a.obj");
  EXPECT_EQ(scene.meshes.at(0).normals.at(1).z, 1);
}

// 0.735357 of sRGB is 0.5 (IEC 61966-2-1). A vertex without a colour is white.
TEST(ReadObj, VerticesHaveColors) {
  const Scene scene = read_bytes(
      bytes_of("v 0 0 0 1 0 0.735357\nv 1 0 0 0 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 2 4 3\n"), "a.obj");
  EXPECT_NO_THROW(scene.check());
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.colors.size(), 4u);
  EXPECT_NEAR(mesh.colors[0][2], 0.5, 1e-5);
  EXPECT_EQ(mesh.colors[1], (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_EQ(mesh.colors[2], (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_TRUE(
      read_bytes(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "a.obj").meshes.at(0).colors.empty());
}

TEST(ReadObj, MissingFilesAreTold) {
  const Scene scene = read_bytes(bytes_of(kCube), "cube.obj");
  EXPECT_EQ(triangle_count(scene), 12u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("cube.mtl"), std::string::npos);
  const Scene bare = read_bytes(bytes_of(kCube), "cube.obj", {{"cube.mtl", bytes_of(kMaterials)}});
  ASSERT_EQ(bare.warnings.size(), 1u);
  EXPECT_NE(bare.warnings[0].find("skin.png"), std::string::npos);
  EXPECT_FALSE(bare.materials[0].base_map);
}

TEST(ReadObj, RefusesWhatIsWrong) {
  std::string message;
  EXPECT_EQ(fault_of(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "a.obj", &message),
            ErrorKind::damaged);
  EXPECT_NE(message.find("vertex 4"), std::string::npos) << message;
  // Numbers that the library under it would take for 0.
  for (const char* word : {"nan", "-inf", "x", "+nan"})
    EXPECT_EQ(
        fault_of(bytes_of(std::string("v 0 0 0\nv 1 ") + word + " 0\nv 0 1 0\nf 1 2 3\n"), "a.obj", &message),
        ErrorKind::bad_value);
  EXPECT_NE(message.find("line 2: '+nan'"), std::string::npos) << message;
  EXPECT_EQ(fault_of(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/9 2/9 3/9\n"), "a.obj"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//9 2//9 3//9\n"), "a.obj"), ErrorKind::damaged);
  EXPECT_EQ(fault_of(bytes_of("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "a.obj"), ErrorKind::unsupported) << "no faces";
  EXPECT_EQ(fault_of(bytes_of(""), "a.obj"), ErrorKind::unsupported);
  EXPECT_EQ(fault_of(bytes_of("v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "a.obj"), ErrorKind::bad_value);
}

TEST(ReadObj, DamagedFilesAreErrorsOrScenes) {
  const Folder folder{{"cube.mtl", bytes_of(kMaterials)}, {"skin.png", small_png()}};
  EXPECT_GT(read_damaged(bytes_of(kCube), "cube.obj", folder), 50);
}

}  // namespace
}  // namespace welkin::scene
