#include "welkin/map_file/joining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
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

  /// The world, turned by quarters: it has the same mean and the same values along the axes, opposite ones in
  /// opposite directions, and is no mirror image.
  static void expect_world_but_turned(const Map& map) {
    const Sampler sampler(map.clone(), {});
    const auto seen = [&](const Vec3d& d) {
      std::vector<float> value(3);
      sampler.look_up(std::vector{d}, value);
      return static_cast<double>(value[0]);
    };
    const std::vector<Vec3d> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    Matrix3 turn;
    for (int row = 0; row < 3; ++row) {
      int nearest = 0;
      const Vec3d own = axes[static_cast<std::size_t>(2 * row)];
      for (int i = 1; i < 6; ++i) {
        const auto off = [&](int k) {
          return std::fabs(world(axes[static_cast<std::size_t>(k)]) - seen(own));
        };
        if (off(i) < off(nearest)) nearest = i;
      }
      const Vec3d d = axes[static_cast<std::size_t>(nearest)];
      EXPECT_NEAR(seen(own), world(d), 0.02);
      turn.rows[static_cast<std::size_t>(row)] = {d.x, d.y, d.z};
    }
    EXPECT_NEAR(determinant(turn), 1, 1e-9);
    const Matrix3 to_world = transpose(turn);
    for (const Vec3d d :
         {Vec3d{0.8, 0.6, 0}, Vec3d{0, 0.6, -0.8}, Vec3d{-0.6, 0, 0.8}, Vec3d{0.6, -0.64, 0.48}})
      EXPECT_NEAR(seen(d), world(to_world * d), 0.02);
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

/// The faces of other programs' strips, and Welkin's crosses turned otherwise; all in the native world's
/// names.
TEST_F(Joining, OtherOrdersAreFoundAndTold) {
  const std::pair<const char*, const char*> cases[] = {{"vstrip", "nz,py,px,nx:90,ny,pz"},
                                                       {"hstrip", "pz,nx,nz,px,py,ny"},
                                                       {"3x2", "nx,pz,px,ny:270,nz:90,py:270"},
                                                       {"hcross", "nz:90,px,py,nx:180,ny,pz:270"},
                                                       {"faces", "ny,py,nx,px,nz:180,pz"}};
  for (const auto& [layout, faces] : cases) {
    const LoadedMap loaded = read_map(written(cube("native"), layout, faces));
    ASSERT_EQ(loaded.info.image.warnings.size(), 1u) << layout << " " << faces;
    EXPECT_NE(
        loaded.info.image.warnings[0].find("in a usual order, but in the native world, the faces being"),
        std::string::npos)
        << loaded.info.image.warnings[0];
    expect_world_but_turned(loaded.map);
  }
}

/// Of a strip in the order of a panorama viewer: the top and bottom say where the front is.
TEST_F(Joining, TheFrontIsWhereTheTopAndBottomAreUpright) {
  expect_world(read_map(written(cube("native"), "hstrip", "pz,nx,nz,px,py,ny")).map);
  expect_world(read_map(written(cube("native"), "vstrip", "px,pz,nx,nz,ny,py")).map);
}

TEST_F(Joining, TurnedFacesOfCrossesAreFound) {
  for (const char* convention : {"native", "three.js"}) {
    for (const std::pair<const char*, const char*>& each :
         {std::pair("vcross", "py,px,pz,nx,ny,nz:180"), std::pair("hcross", "py:90,px,pz,nx,nz,ny:180")}) {
      std::string faces = each.second;
      if (std::string(convention) == "three.js") {
        faces.replace(faces.find("px"), 2, "??").replace(faces.find("nx"), 2, "px");
        faces.replace(faces.find("??"), 2, "nx");
      }
      const LoadedMap loaded = read_map(written(cube(convention), each.first, faces));
      ASSERT_EQ(loaded.info.image.warnings.size(), 1u) << each.first;
      expect_world(loaded.map);
    }
  }
}

TEST_F(Joining, HowSureAReadingIsIsTold) {
  const std::string text = read_map(written(cube("three.js"), "vstrip")).info.image.warnings.at(0);
  double step = 0, as_they_lie = 0, next = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("(steps"),
                        "(steps across edges of %lf stops, as they lie %lf, next best %lf)", &step,
                        &as_they_lie, &next),
            3)
      << text;
  const Map map = read_map(folder_ / "sky.pfm", {.orientation = Matrix3{}}).map;
  const FaceEdges edges = measure_face_edges(map);
  EXPECT_NEAR(as_they_lie, edges.across, 0.01 * edges.across);
  EXPECT_LT(2 * step, next);
  EXPECT_LE(next, as_they_lie * 1.001);
}

TEST_F(Joining, FacesThatJoinInNoWayAreTold) {
  Map mixed = cube("native");
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 48; ++x)
        std::fill_n(mixed.level.chart(face).at(x, y), 3,
                    static_cast<float>(1.1 + std::sin((face + 1) * 0.13 * x + 2 * face) *
                                                 std::cos(0.11 * (6 - face) * y)));
    }
  }
  const LoadedMap loaded = read_map(written(mixed, "vstrip"));
  ASSERT_EQ(loaded.info.image.warnings.size(), 1u);
  EXPECT_NE(loaded.info.image.warnings[0].find("do not join"), std::string::npos);
  EXPECT_EQ(loaded.info.image.warnings[0].find("read so"), std::string::npos)
      << loaded.info.image.warnings[0];
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
