#include "welkin/map_file/map_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
using sphere::AnyParameterization;

class MapFile : public testing::Test {
 protected:
  MapFile() : folder_(fs::temp_directory_path() / ("welkin_map_file_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~MapFile() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  fs::path folder_;
};

/// A map whose every value is different.
Map numbered(const AnyParameterization& p, int width, int height, int channels) {
  Map map(p, width, height, channels);
  float next = 1;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < width * channels; ++i) map.level.chart(chart).row(y)[i] = next++;
    }
  }
  return map;
}

void expect_same(const Map& a, const Map& b) {
  ASSERT_EQ(a.parameterization.spec(), b.parameterization.spec());
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  ASSERT_EQ(a.channel_names, b.channel_names);
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        // Reading fills texels that are not valid, as it fills borders.
        if (!a.parameterization.valid(chart, (x + 0.5) / a.width(), (y + 0.5) / a.height())) continue;
        for (int c = 0; c < a.channels(); ++c) {
          ASSERT_EQ(a.level.chart(chart).at(x, y)[c], b.level.chart(chart).at(x, y)[c])
              << a.parameterization.spec();
        }
      }
    }
  }
}

TEST_F(MapFile, EveryLayoutComesBackFromItsOwnMetadata) {
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    const int width = 6;
    const int height = std::max(1, static_cast<int>(std::lround(width / p.aspect())));
    const Map map = numbered(p, width, height, 3);
    for (const Layout& layout : layouts_of(p)) {
      const bool files = layout.kind == LayoutKind::files;
      const fs::path path = file(name + (files ? "_%s.exr" : ".exr"));
      write_map(path, map, layout);
      const LoadedMap back = read_map(path);
      expect_same(map, back.map);
      EXPECT_EQ(back.info.reason, "declared by the file");
      EXPECT_EQ(back.info.shape->layout.name, layout.name);
    }
  }
}

TEST_F(MapFile, FacesAndOrientationComeBack) {
  Map map = numbered(AnyParameterization::make("cube"), 4, 4, 3);
  const Layout layout = parse_map_shape("cube:hcross").layout;
  WriteMapOptions options;
  options.faces = "nz:90,px,ny:180,py:mirror,nx,pz:270";
  for (const double sign : {1.0, -1.0}) {
    map.orientation = Matrix3{{{{0, 0, sign}, {0, 1, 0}, {-1, 0, 0}}}};
    write_map(file("turned.exr"), map, layout, options);
    const LoadedMap back = read_map(file("turned.exr"));
    expect_same(map, back.map);
    EXPECT_EQ(back.map.orientation, map.orientation);
  }
}

TEST_F(MapFile, SafetyBordersComeOffAgain) {
  for (const char* shape : {"octahedral", "cube:flat", "paraboloid:hstrip", "cube:layers"}) {
    const MapShape parsed = parse_map_shape(shape);
    Map map = numbered(parsed.parameterization, 8, 8, 3);
    fill_borders(map);
    WriteMapOptions options;
    options.border = 6;
    write_map(file("bordered.exr"), map, parsed.layout, options);
    const LoadedMap back = read_map(file("bordered.exr"));
    EXPECT_EQ(back.info.border, 6);
    expect_same(map, back.map);
  }
}

TEST_F(MapFile, GuessesBySize) {
  const auto guess = [&](int width, int height) {
    const Image picture(width, height, 3);
    const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
    io::write(file("plain.pfm"), {&part, 1});
    const MapFileInfo info = MapReader(file("plain.pfm")).info();
    return info.shape ? info.shape->text() : "none";
  };
  EXPECT_EQ(guess(64, 32), "latlong");
  EXPECT_EQ(guess(65, 33), "latlong");
  EXPECT_EQ(guess(64, 48), "cube:hcross");
  EXPECT_EQ(guess(48, 64), "cube:vcross");
  EXPECT_EQ(guess(60, 10), "cube:hstrip");
  EXPECT_EQ(guess(10, 60), "cube:vstrip");
  EXPECT_EQ(guess(30, 20), "cube:3x2");
  EXPECT_EQ(guess(32, 32), "none");
}

TEST_F(MapFile, ReadsOpenExrsEnvmapAttribute) {
  Image picture(8, 4, 3);
  for (int i = 0; i < 96; ++i) picture.view().data[i] = static_cast<float>(i);
  const io::WritePart part{"", static_cast<const Image&>(picture).view(), {"R", "G", "B"}};
  io::WriteOptions options;
  options.envmap = "latlong";
  io::write(file("env.exr"), {&part, 1}, options);
  const LoadedMap map = read_map(file("env.exr"));
  EXPECT_EQ(map.map.parameterization.spec(), "openexr-latlong,width=8,height=4");
  // Texel centres of the first row lie on the pole, those of the first column on the meridian of −Z.
  const auto& p = map.map.parameterization;
  EXPECT_NEAR(p.to_sphere(0, 0.5 / 8, 0.5 / 4).y, 1, 1e-12);
  EXPECT_NEAR(p.to_sphere(0, 0.5 / 8, 0.5).z, -1, 1e-12);
  EXPECT_NEAR(p.to_sphere(0, 7.5 / 8, 0.5).z, -1, 1e-12);
}

TEST_F(MapFile, RefusesWhatDoesNotFit) {
  const auto message = [&](const fs::path& path, ReadMapOptions options) -> std::string {
    try {
      read_map(path, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "read";
  };
  const Image picture(40, 30, 3);
  const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
  io::write(file("a.pfm"), {&part, 1});
  ReadMapOptions options;
  options.shape = "latlong";
  EXPECT_NE(message(file("a.pfm"), options).find("40×30 does not fit latlong"), std::string::npos);
  options.shape = "cube:vcross";
  EXPECT_NE(message(file("a.pfm"), options).find("does not fit cube:vcross"), std::string::npos);
  options.shape = "cube:faces";
  EXPECT_NE(message(file("a.pfm"), options).find("put %s in the name"), std::string::npos);
  options.shape = "cube:layers";
  EXPECT_NE(message(file("a.pfm"), options).find("needs 6 parts"), std::string::npos);
  options.shape = "cube:hcross";
  options.part = 3;
  EXPECT_NE(message(file("a.pfm"), options).find("has no part 3"), std::string::npos);
  options.part = 0;
  options.channels = {"X"};
  EXPECT_NE(message(file("a.pfm"), options).find("unknown channel 'X'"), std::string::npos);
}

TEST_F(MapFile, RefusesFacesOfDifferentSizes) {
  const Map map = numbered(AnyParameterization::make("cube"), 4, 4, 3);
  write_map(file("f_%s.pfm"), map, parse_map_shape("cube:faces").layout);
  const Image other(5, 5, 3);
  const io::WritePart part{"", other.view(), {"R", "G", "B"}};
  io::write(file("f_ny.pfm"), {&part, 1});
  ReadMapOptions options;
  options.shape = "cube";
  try {
    read_map(file("f_%s.pfm"), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("f_ny.pfm: is 5×5, but the first face is 4×4"),
              std::string::npos);
  }
}

TEST_F(MapFile, DamagedDeclarationsNameTheFile) {
  const Image picture(8, 4, 3);
  const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
  io::WriteOptions options;
  options.attributes["welkin.parameterization"] = "latlnog";
  io::write(file("bad.exr"), {&part, 1}, options);
  try {
    read_map(file("bad.exr"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bad.exr: unknown parameterization"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace welkin
