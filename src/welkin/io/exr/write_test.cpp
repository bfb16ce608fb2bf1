// Writing: what goes in comes out, and what cannot be kept is counted or refused.

#include <functional>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/io/exr/exr_test_files.h"

namespace welkin::io {
namespace {

using namespace exr_test;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Values that `type` holds exactly: smooth, so that lossy compressions have their ordinary errors.
Image picture(int width, int height, int channels, PixelType type) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) {
        const auto value = static_cast<float>(value_at(x, y, static_cast<std::size_t>(c), Imf::FLOAT));
        image.at(x, y)[c] = type == PixelType::half     ? static_cast<float>(Imath::half(value))
                            : type == PixelType::uint32 ? std::floor(1e6f * value)
                                                        : value;
      }
  return image;
}

double largest_relative_error(const Image& a, const Image& b) {
  double largest = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int i = 0; i < a.width() * a.channels(); ++i) {
      const double expected = a.at(0, y)[i];
      largest =
          std::max(largest, std::abs(static_cast<double>(b.at(0, y)[i]) - expected) / std::abs(expected));
    }
  return largest;
}

Image round_trip(const Folder& folder, const Image& image, const WriteOptions& options) {
  const std::string path = folder / "trip.exr";
  write(path, std::vector<WritePart>{{"", image.view(), {"R", "G", "B"}}}, options);
  const auto reader = open(std::filesystem::path(path));
  EXPECT_EQ(reader->info().parts[0].type, options.type.value_or(PixelType::float32));
  EXPECT_EQ(reader->info().parts[0].compression, options.compression.empty() ? "zip" : options.compression);
  expect_equals_library(path);
  return read_all(*reader);
}

/// Largest relative error of each compression for (half, float, uint32). 0: exact. PXR24 keeps 16 of 24 bits
/// of a float's significand. B44 and B44A keep 6 bits of differences in blocks of 16 halves; other types are
/// exact. DWA at level 45 quantizes cosine terms to what an eye does not see, colour in half; here 1%.
struct Bound {
  const char* compression;
  double half, float32, uint32;
};
constexpr Bound kBounds[]{{"none", 0, 0, 0},        {"rle", 0, 0, 0},       {"zips", 0, 0, 0},
                          {"zip", 0, 0, 0},         {"", 0, 0, 0},          {"piz", 0, 0, 0},
                          {"pxr24", 0, 0x1p-16, 0}, {"b44", 0.02, 0, 0},    {"b44a", 0.02, 0, 0},
                          {"dwaa", 0.01, 0.01, 0},  {"dwab", 0.01, 0.01, 0}};

TEST(ExrWrite, EveryCompressionKeepsEveryTypeWithinItsBound) {
  const Folder folder;
  for (const Bound& bound : kBounds) {
    for (const auto& [type, maximum] :
         {std::pair{PixelType::half, bound.half}, std::pair{PixelType::float32, bound.float32},
          std::pair{PixelType::uint32, bound.uint32}})
      for (const auto& [width, height] : {std::pair{1, 1}, std::pair{301, 67}, std::pair{40, 700}}) {
        const Image image = picture(width, height, 3, type);
        WriteOptions options;
        options.type = type;
        options.compression = bound.compression;
        const double error = largest_relative_error(image, round_trip(folder, image, options));
        EXPECT_LE(error, maximum) << bound.compression << ' ' << name_of(type) << ' ' << width << 'x'
                                  << height;
      }
  }
}

TEST(ExrWrite, KeepsNegativesInfinitiesAndNans) {
  const Folder folder;
  Image image(7, 5, 3);
  const float values[]{-1.5f, kInfinity, -kInfinity, kNan, -0.0f, 65504.0f, 0x1p-24f, -0x1p-14f};
  for (int i = 0; i < 7 * 3; ++i)
    for (int y = 0; y < 5; ++y) image.at(0, y)[i] = values[(i + y) % 8];
  for (const auto type : {PixelType::half, PixelType::float32}) {
    WriteOptions options;
    options.type = type;
    const Image back = round_trip(folder, image, options);
    for (int y = 0; y < 5; ++y)
      for (int i = 0; i < 7 * 3; ++i) EXPECT_EQ(bits(image.at(0, y)[i]), bits(back.at(0, y)[i]));
  }
}

TEST(ExrWrite, CountsAndClipsWhatATypeCannotHold) {
  const Folder folder;
  const std::string path = folder / "clip.exr";
  float values[]{65505.0f, -1e9f, 65504.0f, kInfinity, kNan, -2.0f, 5e9f, 1.4f};
  const std::vector<WritePart> part{{"", {values, 8, 1, 1, 8}, {"Y"}}};
  WriteOptions options;
  options.type = PixelType::half;
  const WriteReport half = write(path, part, options);
  EXPECT_EQ(half.above, 3u);
  EXPECT_EQ(half.below + half.not_finite, 0u);
  Image back = read_all(*open(std::filesystem::path(path)));
  EXPECT_EQ(back.at(0, 0)[0], 65504.0f);
  EXPECT_EQ(back.at(1, 0)[0], -65504.0f);
  EXPECT_EQ(back.at(3, 0)[0], kInfinity);
  EXPECT_TRUE(std::isnan(back.at(4, 0)[0]));

  options.type = PixelType::uint32;
  const WriteReport integer = write(path, part, options);
  EXPECT_EQ(integer.above, 1u);
  EXPECT_EQ(integer.below, 2u);
  EXPECT_EQ(integer.not_finite, 2u);
  back = read_all(*open(std::filesystem::path(path)));
  EXPECT_EQ(back.at(0, 0)[0], 65505.0f);
  EXPECT_EQ(back.at(1, 0)[0], 0.0f);
  EXPECT_EQ(back.at(6, 0)[0], 4294967295.0f);
  EXPECT_EQ(back.at(7, 0)[0], 1.0f);

  options.type = PixelType::float32;
  const WriteReport whole = write(path, part, options);
  EXPECT_EQ(whole.above + whole.below + whole.not_finite, 0u);
}

TEST(ExrWrite, AttributesEnvmapAndChannels) {
  const Folder folder;
  const std::string path = folder / "attributes.exr";
  const Image image = picture(8, 4, 5, PixelType::float32);
  WriteOptions options;
  options.attributes = {
      {"comments", "two\nlines"}, {"welkin:lobe", "ggx"}, {"compression", "none"}, {"focus", "3"}};
  options.envmap = "latlong";
  write(path, std::vector<WritePart>{{"only", image.view(), {"B", "depth.Z", "A", "R", "G"}}}, options);
  const auto reader = open(std::filesystem::path(path));
  const std::map<std::string, std::string> expected{{"comments", "two\nlines"}, {"welkin:lobe", "ggx"}};
  EXPECT_EQ(reader->info().attributes, expected);
  EXPECT_EQ(reader->info().envmap, "latlong");
  EXPECT_EQ(reader->info().parts[0].name, "only");
  EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"R", "G", "B", "A", "depth.Z"}));
  EXPECT_TRUE(reader->info().notes.empty());
  const Image back = read_all(*reader);
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(back.at(x, 2)[0], image.at(x, 2)[3]);
    EXPECT_EQ(back.at(x, 2)[4], image.at(x, 2)[1]);
  }
}

TEST(ExrWrite, PartsOfUnequalSizeComeBackAtTheirOwn) {
  const Folder folder;
  const std::string path = folder / "parts.exr";
  const Image a = picture(32, 16, 3, PixelType::half), b = picture(16, 20, 1, PixelType::half);
  for (const auto* compression : {"zip", "dwab"}) {
    WriteOptions options;
    options.compression = compression;
    options.type = PixelType::half;
    write(path, std::vector<WritePart>{{"a", a.view(), {"R", "G", "B"}}, {"b", b.view(), {"Y"}}}, options);
    const auto reader = open(std::filesystem::path(path));
    ASSERT_EQ(reader->info().parts.size(), 2u);
    EXPECT_EQ(bits(*read_all(*reader, 1).at(3, 17)), bits(*read_by_library(path, 1, "Y").at(3, 17)));
    EXPECT_EQ(reader->info().parts[0].name, "a");
    EXPECT_EQ(reader->info().parts[1].name, "b");
    EXPECT_TRUE(reader->info().notes.empty());
    const Image back = read_all(*reader, 1);
    ASSERT_EQ(back.width(), 16);
    ASSERT_EQ(back.height(), 20);
    EXPECT_LE(largest_relative_error(b, back), std::string(compression) == "zip" ? 0.0 : 0.01);
    EXPECT_LE(largest_relative_error(a, read_all(*reader, 0)),
              std::string(compression) == "zip" ? 0.0 : 0.01);
  }
}

TEST(ExrWrite, PartOfALargerImage) {
  const Folder folder;
  Image larger = picture(60, 50, 3, PixelType::half);
  const auto part = larger.view().part(7, 11, 33, 21);
  for (const auto type : {PixelType::half, PixelType::float32}) {
    WriteOptions options;
    options.type = type;
    write(folder / "part.exr", std::vector<WritePart>{{"", part, {"R", "G", "B"}}}, options);
    const Image back = read_all(*open(std::filesystem::path(folder / "part.exr")));
    ASSERT_EQ(back.width(), 33);
    for (int y = 0; y < 21; ++y)
      for (int i = 0; i < 33 * 3; ++i) ASSERT_EQ(back.at(0, y)[i], part.row(y)[i]);
  }
}

TEST(ExrWrite, TheSameBytesEachTime) {
  const Folder folder;
  const Image image = picture(200, 300, 3, PixelType::float32);
  for (const auto* compression : {"zip", "piz", "dwaa"}) {
    WriteOptions options;
    options.compression = compression;
    for (const auto* name : {"a.exr", "b.exr"})
      write(folder / name, std::vector<WritePart>{{"", image.view(), {"R", "G", "B"}}}, options);
    EXPECT_EQ(bytes_of_file(folder / "a.exr"), bytes_of_file(folder / "b.exr"));
  }
}

TEST(ExrWrite, RefusesWhatTheFormatCannotStore) {
  const Folder folder;
  const Image image = picture(4, 4, 2, PixelType::half);
  const std::string path = folder / "refused.exr";
  const auto cause = [&](const std::vector<WritePart>& parts, const WriteOptions& options) -> std::string {
    try {
      write(path, parts, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "written";
  };
  const WritePart good{"", image.view(), {"R", "G"}};
  WriteOptions bytes, compression, envmap;
  bytes.type = PixelType::uint8;
  compression.compression = "zups";
  envmap.envmap = "octahedral";
  EXPECT_NE(cause({good}, bytes).find("uint8 (one of: half, float, uint32)"), std::string::npos);
  EXPECT_NE(cause({good}, compression).find("did you mean 'zips'"), std::string::npos)
      << cause({good}, compression);
  EXPECT_NE(cause({good}, envmap).find("'octahedral'"), std::string::npos);
  EXPECT_NE(cause({{"", image.view(), {"R", "R"}}}, {}).find("two channels"), std::string::npos);
  EXPECT_NE(cause({{"", image.view(), {"R", ""}}}, {}).find("channel name ''"), std::string::npos);
  EXPECT_NE(cause({good, good}, {}).find("needs a name"), std::string::npos);
  EXPECT_NE(cause({{"a", image.view(), {"R", "G"}}, {"a", image.view(), {"R", "G"}}}, {}).find("two parts"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace welkin::io
