// Files of several parts and layers, and which of these become a map.

#include <gtest/gtest.h>
#include <unistd.h>

#include <deque>
#include <filesystem>
#include <numeric>

#include "welkin/map_file/map_file.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class SelectPictures : public testing::Test {
 protected:
  SelectPictures()
      : folder_(fs::temp_directory_path() / ("welkin_select_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~SelectPictures() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  fs::path folder_;
};

/// A picture whose channel c is `first` + c everywhere.
io::WritePart even(std::deque<Image>& keep, const std::string& name, int width, int height, float first,
                   const std::vector<std::string>& channels) {
  Image& image = keep.emplace_back(width, height, static_cast<int>(channels.size()));
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * image.channels(); ++i)
      image.view().row(y)[i] = first + static_cast<float>(i % image.channels());
  }
  return {name, static_cast<const Image&>(image).view(), channels};
}

TEST_F(SelectPictures, TheLayerWithColourIsReadUnderPlainNames) {
  std::deque<Image> keep;
  const io::WritePart part =
      even(keep, "", 8, 4, 1, {"V.Combined.B", "V.Combined.R", "V.Combined.G", "V.Depth.Z"});
  io::write(file("layers.exr"), {&part, 1});
  const LoadedMap map = read_map(file("layers.exr"));
  EXPECT_EQ(map.map.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(map.map.level.chart(0).at(3, 2)[0], 2);
  EXPECT_EQ(map.map.level.chart(0).at(3, 2)[1], 3);
  EXPECT_EQ(map.map.level.chart(0).at(3, 2)[2], 1);
  EXPECT_EQ(map.info.channels, (std::vector<std::string>{"V.Combined.R", "V.Combined.G", "V.Combined.B"}));
  ASSERT_EQ(map.info.layers.size(), 2u);
  EXPECT_EQ(map.info.layers[1].name, "V.Depth");
  EXPECT_TRUE(map.info.image.warnings.empty());
  ReadMapOptions options;
  options.layer = "Depth";
  const LoadedMap depth = read_map(file("layers.exr"), options);
  EXPECT_EQ(depth.map.channel_names, (std::vector<std::string>{"Z"}));
  EXPECT_EQ(depth.map.level.chart(0).at(0, 0)[0], 4);
}

TEST_F(SelectPictures, ThePartWithColourIsRead) {
  std::deque<Image> keep;
  const std::vector<io::WritePart> parts{even(keep, "depth", 4, 4, 9, {"Z"}),
                                         even(keep, "beauty", 8, 4, 1, {"R", "G", "B"}),
                                         even(keep, "aov", 8, 4, 5, {"R", "G", "B"})};
  io::write(file("parts.exr"), parts);
  const auto first = [&](const ReadMapOptions& options) {
    return read_map(file("parts.exr"), options).map.level.chart(0).at(0, 0)[0];
  };
  MapReader reader(file("parts.exr"));
  EXPECT_EQ(reader.info().picture, 1u);
  EXPECT_EQ(reader.info().shape->text(), "latlong") << "by the size of the part that is read";
  ASSERT_EQ(reader.info().image.warnings.size(), 1u);
  EXPECT_NE(reader.info().image.warnings[0].find("'beauty' is read"), std::string::npos);
  EXPECT_EQ(first({}), 1);
  ReadMapOptions options;
  options.layer = "aov";
  EXPECT_EQ(first(options), 5);
  options.layer.clear();
  options.part = 2;
  EXPECT_EQ(first(options), 5);
  EXPECT_TRUE(MapReader(file("parts.exr"), options).info().image.warnings.empty()) << "it was asked for";
  options.part = 0;
  options.shape = "octahedral";
  EXPECT_EQ(first(options), 9);
}

TEST_F(SelectPictures, FacesInPartsHaveTheirOwnNamesOfChannels) {
  std::deque<Image> keep;
  std::vector<io::WritePart> faces;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
    const std::string name = face;
    faces.push_back(even(keep, name, 4, 4, 10 * static_cast<float>(faces.size()),
                         {name + ".R", name + ".G", name + ".B"}));
  }
  io::write(file("faces.exr"), faces);
  const LoadedMap cube = read_map(file("faces.exr"));
  EXPECT_EQ(cube.info.shape->text(), "cube:layers");
  EXPECT_TRUE(cube.info.image.warnings.empty());
  for (int face = 0; face < 6; ++face) {
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(cube.map.level.chart(face).at(1, 1)[c], static_cast<float>(10 * face + c));
  }
  // Six square passes of one picture are no faces.
  faces[3] = even(keep, "depth", 4, 4, 1, {"Z"});
  io::write(file("faces.exr"), faces);
  EXPECT_FALSE(MapReader(file("faces.exr")).info().shape);
}

TEST_F(SelectPictures, EnvmapsOfFewTexelsShowTheWholeWorld) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(2, 1), std::pair(2, 2), std::pair(3, 2)}) {
    std::deque<Image> keep;
    const io::WritePart part = even(keep, "", width, height, 1, {"R", "G", "B"});
    io::WriteOptions options;
    options.envmap = "latlong";
    io::write(file("few.exr"), {&part, 1}, options);
    const LoadedMap map = read_map(file("few.exr"));
    const auto& p = map.map.parameterization;
    EXPECT_EQ(p.name(), "openexr-latlong");
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      std::vector<float> row(static_cast<std::size_t>(width));
      texel_solid_angles(p, width, height, 0, y, row.data());
      sum = std::accumulate(row.begin(), row.end(), sum);
    }
    EXPECT_NEAR(sum, 4 * kPi, 1e-4) << width << "×" << height;
    for (const Vec3d& d : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{-0.6, 0, -0.8}}) {
      const auto at = p.from_sphere(d);
      EXPECT_TRUE(at.u >= -1e-9 && at.u <= 1 + 1e-9 && at.v >= -1e-9 && at.v <= 1 + 1e-9) << width << height;
    }
  }
}

}  // namespace
}  // namespace welkin
