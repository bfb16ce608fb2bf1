#include "welkin/map_file/map_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <tuple>

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

/// Of a picture's size alone, the shape that its file would have.
TEST(InspectPicture, IsWhatAFileSays) {
  const auto held_in = [](int width, int height, const ReadMapOptions& options) {
    const std::string header = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    std::vector<std::byte> bytes(header.size() + static_cast<std::size_t>(12 * width * height));
    std::copy(header.begin(), header.end(), reinterpret_cast<char*>(bytes.data()));
    return MapReader(bytes, "frames", options).info();
  };
  ReadMapOptions eye;
  eye.eye = Eye::right;
  ReadMapOptions bordered;
  bordered.shape = "latlong";
  bordered.border = 2;
  for (const auto& [width, height, options] : {std::tuple{64, 32, ReadMapOptions{}},
                                               {64, 48, {}},
                                               {30, 20, {}},
                                               {32, 32, {}},
                                               {64, 64, eye},
                                               {44, 24, bordered}}) {
    ReadMapOptions unjoined = options;
    unjoined.join_faces = false;
    const MapFileInfo wanted = held_in(width, height, unjoined);
    const MapFileInfo found = inspect_picture({width, height}, {"R", "G", "B"}, "frames", options);
    ASSERT_EQ(wanted.shape.has_value(), found.shape.has_value()) << width;
    if (wanted.shape) {
      EXPECT_EQ(wanted.shape->text(), found.shape->text());
    }
    EXPECT_EQ(wanted.reason, found.reason);
    EXPECT_EQ(wanted.chart.width, found.chart.width);
    EXPECT_EQ(wanted.chart.height, found.chart.height);
    EXPECT_EQ(wanted.channels, found.channels);
    EXPECT_EQ(wanted.stereo, found.stereo);
  }
}

TEST(InspectPicture, RefusesWhatIsNone) {
  EXPECT_THROW(inspect_picture({0, 32}, {"R"}, "frames"), Error);
  EXPECT_THROW(inspect_picture({64, 32}, {}, "frames"), Error);
  EXPECT_THROW(inspect_picture({64, 32}, {"R"}, "%s"), Error);
  ReadMapOptions cube;
  cube.shape = "cube:hcross";
  EXPECT_THROW(inspect_picture({64, 32}, {"R"}, "frames", cube), Error);
}

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
  options.shape = "paraboloid";
  EXPECT_NE(message(file("a.pfm"), options).find("40×30 does not fit paraboloid"), std::string::npos);
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

/// What was asked is believed: pictures of one chart may have any aspect.
TEST_F(MapFile, WhatIsWrittenIsReadWhateverTheAspect) {
  for (const char* name :
       {"latlong", "latlong,left=-50,right=70,top=20,bottom=-70", "vr180", "cylinder", "mercator",
        "sky-latlong", "equal-area", "octahedral", "angular", "fisheye-equisolid,fov=200"}) {
    const auto p = AnyParameterization::make(name);
    for (const ChartSize size : {ChartSize{24, 24}, {16, 60}, {70, 8}}) {
      const Map map = numbered(p, size.width, size.height, 3);
      for (const char* extension : {"pfm", "webp", "png", "hdr", "exr", "ktx2", "tif", "jpg"}) {
        const fs::path path = file(std::string("any.") + extension);
        write_map(path, map);
        ReadMapOptions options;
        options.shape = p.spec();
        for (const bool asked : {true, false}) {
          const bool declares = std::string(extension) != "pfm" && std::string(extension) != "webp";
          if (!asked && !declares) continue;
          const LoadedMap back = read_map(path, asked ? options : ReadMapOptions());
          EXPECT_EQ(back.map.parameterization.spec(), p.spec()) << path;
          EXPECT_EQ(back.map.width(), size.width);
          EXPECT_EQ(back.map.height(), size.height);
          // The file's own word needs no warning.
          const bool square = std::abs(p.aspect() * size.height - size.width) <= 1 || p.traits().free_aspect;
          EXPECT_EQ(back.info.image.warnings.size(), declares || square ? 0U : 1U) << path << ' ' << name;
          if (std::string(extension) == "pfm" || std::string(extension) == "exr") expect_same(map, back.map);
        }
      }
    }
  }
}

TEST_F(MapFile, FacesThatAreNotSquareAreReadWhereTheFileSaysSo) {
  const Map map = numbered(AnyParameterization::make("cube"), 8, 4, 3);
  const Layout layout = parse_map_shape("cube:hcross").layout;
  ReadMapOptions options;
  options.shape = "cube:hcross";
  write_map(file("faces.exr"), map, layout);
  expect_same(map, read_map(file("faces.exr"), options).map);
  write_map(file("faces.pfm"), map, layout);
  EXPECT_THROW(read_map(file("faces.pfm"), options), Error);
}

/// Two maps in one picture, the left eye's first.
Image two_pictures(const Map& left, const Map& right, bool below) {
  const int width = left.width(), height = left.height();
  Image both(below ? width : 2 * width, below ? 2 * height : height, left.channels());
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * left.channels(); ++i) {
      both.view().row(y)[i] = left.level.chart(0).row(y)[i];
      (below ? both.view().row(height + y) : both.view().row(y) + width * left.channels())[i] =
          right.level.chart(0).row(y)[i];
    }
  }
  return both;
}

TEST_F(MapFile, EachEyeIsReadFromItsHalf) {
  for (const auto& [spec, below] : {std::pair("latlong", true),
                                    {"latlong", false},
                                    {"vr180", true},
                                    {"vr180", false},
                                    {"cube:hcross", false}}) {
    const MapShape shape = parse_map_shape(spec);
    const bool cube = shape.parameterization.charts() > 1;
    const Map picture = cube ? numbered(AnyParameterization::make("mercator"), 16, 12, 3)
                             : numbered(shape.parameterization, spec[0] == 'l' ? 12 : 6, 6, 3);
    Map other = picture.clone();
    for (int y = 0; y < other.height(); ++y) {
      for (int i = 0; i < other.width() * 3; ++i) other.level.chart(0).row(y)[i] += 1000;
    }
    const Image both = two_pictures(picture, other, below);
    const io::WritePart part{"", both.view(), {"R", "G", "B"}};
    io::write(file("both.pfm"), {&part, 1});
    for (const Eye eye : {Eye::left, Eye::right}) {
      for (const bool said : {true, false}) {
        ReadMapOptions options;
        options.shape = spec;
        options.eye = eye;
        if (said) options.stereo = below ? io::Stereo::top_bottom : io::Stereo::left_right;
        const LoadedMap seen = read_map(file("both.pfm"), options);
        EXPECT_TRUE(seen.info.image.warnings.empty()) << spec;
        // Each eye's picture alone.
        const io::WritePart half{"", (eye == Eye::left ? picture : other).level.chart(0), {"R", "G", "B"}};
        io::write(file("half.pfm"), {&half, 1});
        options = {};
        options.shape = spec;
        expect_same(read_map(file("half.pfm"), options).map, seen.map);
      }
    }
  }
}

TEST_F(MapFile, EyesAreToldOrRefused) {
  const auto refusal = [&](const ReadMapOptions& options) {
    try {
      return MapReader(file("both.pfm"), options).info().image.warnings.empty() ? std::string("quiet")
                                                                                : std::string("warned");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  const auto picture_of = [&](int width, int height) {
    const Image picture(width, height, 3);
    const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
    io::write(file("both.pfm"), {&part, 1});
  };
  picture_of(32, 32);
  ReadMapOptions options;
  options.eye = Eye::left;
  EXPECT_EQ(refusal(options), "quiet");  // a lat-long for each eye
  EXPECT_EQ(MapReader(file("both.pfm"), options).info().shape->text(), "latlong");
  EXPECT_EQ(MapReader(file("both.pfm"), options).info().stereo, io::Stereo::top_bottom);
  // Without an eye the left one is read; the user may mean squeezed texels; none is none.
  options = {};
  options.stereo = io::Stereo::top_bottom;
  EXPECT_EQ(refusal(options), "warned");
  options = {};
  options.shape = "latlong";
  EXPECT_EQ(refusal(options), "warned");
  EXPECT_EQ(MapReader(file("both.pfm"), options).info().chart.height, 32);
  options.stereo = io::Stereo::mono;
  options.eye = Eye::right;
  EXPECT_NE(refusal(options).find("one picture for both eyes"), std::string::npos);
  picture_of(31, 33);
  options.stereo = io::Stereo::left_right;
  EXPECT_NE(refusal(options).find("its width is odd"), std::string::npos);
  options.stereo = io::Stereo::not_said;
  EXPECT_NE(refusal(options).find("cannot tell how two eyes' pictures lie in 31×33"), std::string::npos);
  // Squeezed halves: how they lie must be said.
  picture_of(64, 32);
  EXPECT_NE(refusal(options).find("cannot tell"), std::string::npos);
  options.stereo = io::Stereo::top_bottom;
  EXPECT_EQ(refusal(options), "warned");
  options.shape = "cube:layers";
  EXPECT_NE(refusal(options).find("parts"), std::string::npos);
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
