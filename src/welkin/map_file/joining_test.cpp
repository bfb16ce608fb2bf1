#include "welkin/map_file/joining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "welkin/filter/resample.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/borders.h"
#include "welkin/map_file/map_file.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

/// A smooth world without symmetries.
double world(const Vec3d& d) {
  return 1.2 + 0.5 * d.x + 0.3 * d.y - 0.25 * d.z + 0.2 * d.x * d.z + 0.3 * std::sin(3 * d.y + 2 * d.x);
}

/// A cube of that world, as a program of this convention has it.
Map cube(const std::string& convention, int size = 48) {
  const auto p = sphere::AnyParameterization::make("cube");
  Map map(p, size, size, 3);
  map.orientation = orientation_for(convention_from_name(convention), p);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3d d = transpose(map.orientation) * p.to_sphere(face, (x + 0.5) / size, (y + 0.5) / size);
        for (int c = 0; c < 3; ++c)
          map.level.chart(face).at(x, y)[c] = static_cast<float>(world(d) * (c + 1));
      }
    }
  }
  fill_borders(map);
  return map;
}

class Joining : public ::testing::Test {
 protected:
  Joining() : folder_(fs::temp_directory_path() / ("welkin-joining-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Joining() override { fs::remove_all(folder_); }

  /// A file that says nothing of its faces.
  fs::path written(const Map& map, const std::string& layout, const std::string& faces = "") const {
    const fs::path path = folder_ / (layout == "faces" ? "sky_%s.pfm" : "sky.pfm");
    WriteMapOptions options;
    options.faces = faces;
    write_map(path, map, parse_map_shape("cube:" + layout).layout, options);
    return path;
  }

  static void expect_world(const Map& map) {
    const Sampler sampler(map.clone(), {});
    std::vector<float> value(3);
    for (const Vec3d d : {Vec3d{1, 0.1, 0.2}, Vec3d{-1, 0.3, 0.1}, Vec3d{0.2, 1, 0.1}, Vec3d{0.3, -1, -0.2},
                          Vec3d{0.1, 0.2, 1}, Vec3d{0.3, 0.1, -1}}) {
      const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      sampler.look_up(std::vector{d}, value);
      EXPECT_NEAR(static_cast<double>(value[0]), world({d.x / length, d.y / length, d.z / length}), 0.02);
    }
  }

  fs::path folder_;
};

TEST_F(Joining, FacesOfTheNativeWorldAreReadInSilence) {
  for (const char* layout : {"faces", "vstrip", "hstrip", "hcross", "vcross", "3x2"}) {
    const LoadedMap loaded = read_map(written(cube("native"), layout));
    EXPECT_TRUE(loaded.info.image.warnings.empty()) << layout << ": " << loaded.info.image.warnings.front();
    expect_world(loaded.map);
  }
}

TEST_F(Joining, FacesOfEnginesAreFoundAndTold) {
  for (const char* layout : {"faces", "vstrip", "hstrip", "3x2"}) {
    const LoadedMap loaded = read_map(written(cube("three.js"), layout));
    ASSERT_EQ(loaded.info.image.warnings.size(), 1u) << layout;
    EXPECT_NE(loaded.info.image.warnings[0].find("three.js"), std::string::npos)
        << loaded.info.image.warnings[0];
    expect_world(loaded.map);
  }
}

TEST_F(Joining, TurnedTopsAndBottomsAreFound) {
  for (const char* convention : {"native", "three.js"}) {
    for (const char* faces : {"px,nx,py:90,ny:270,pz,nz", "px,nx,py:180,ny,pz,nz"}) {
      const LoadedMap loaded = read_map(written(cube(convention), "vstrip", faces));
      ASSERT_EQ(loaded.info.image.warnings.size(), 1u) << faces;
      expect_world(loaded.map);
    }
  }
}

TEST_F(Joining, UpsideDownFacesAreFound) {
  const LoadedMap loaded = read_map(
      written(cube("three.js"), "hstrip",
              "px:180:mirror,nx:180:mirror,py:180:mirror,ny:180:mirror,pz:180:mirror,nz:180:mirror"));
  EXPECT_EQ(loaded.info.image.warnings.size(), 1u);
  expect_world(loaded.map);
}

TEST_F(Joining, WhatIsAskedIsBelievedAndTold) {
  ReadMapOptions options;
  options.orientation = Matrix3{};
  MapReader reader(written(cube("three.js"), "vstrip"), options);
  EXPECT_TRUE(reader.info().image.warnings.empty());
  reader.check_faces();
  ASSERT_EQ(reader.info().image.warnings.size(), 1u);
  EXPECT_TRUE(reader.info().orientation == Matrix3{});
}

TEST_F(Joining, FacesThatJoinInNoWayAreTold) {
  const LoadedMap loaded = read_map(written(cube("native"), "vstrip", "nz,py,px,nx:90,ny,pz"));
  ASSERT_EQ(loaded.info.image.warnings.size(), 1u);
  EXPECT_NE(loaded.info.image.warnings[0].find("do not join"), std::string::npos);
  ReadMapOptions options;
  options.shape = "cube:vstrip";
  EXPECT_TRUE(read_map(folder_ / "sky.pfm", options).info.image.warnings.empty());
}

TEST_F(Joining, FacesOfOneColourAreLeftAloneAndTold) {
  Map constant = cube("native", 16);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 16; ++y) std::fill_n(constant.level.chart(face).row(y), 48, 0.5f);
  }
  fill_borders(constant);
  const fs::path path = written(constant, "vstrip");
  ASSERT_EQ(read_map(path).info.image.warnings.size(), 1u);
  ReadMapOptions options;
  options.shape = "cube:vstrip";
  EXPECT_TRUE(read_map(path, options).info.image.warnings.empty());
}

}  // namespace
}  // namespace welkin
