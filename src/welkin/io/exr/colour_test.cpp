// What EXR files say of colour, and luminance with chroma at the full resolution.

#include "welkin/io/exr/colour.h"

#include <ImfChromaticitiesAttribute.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <functional>

#include "welkin/io/exr/exr_test_files.h"
#include "welkin/io/format.h"

namespace welkin::io {
namespace {

using namespace exr_test;

const std::map<std::string, Imf::PixelType> kRgb{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}};

TestPart small_part(const std::map<std::string, Imf::PixelType>& channels = kRgb) {
  return part_of({{0, 0}, {7, 3}}, {{0, 0}, {7, 3}}, Imf::ZIP_COMPRESSION, channels);
}

/// The format's own reader, which says what is declared.
std::unique_ptr<FormatReader> open_format(std::span<const std::byte> bytes) {
  return exr_format().open({bytes, "test.exr", {}});
}

struct Opened {
  Declared declared;
  std::vector<std::string> warnings;  ///< of all parts
};

Opened opened(const std::vector<TestPart>& parts) {
  const Folder folder;
  write_file(folder / "a.exr", parts);
  const auto bytes = bytes_of_file(folder / "a.exr");
  const auto reader = open_format(bytes);
  Opened result{reader->declared(), {}};
  for (const PartInfo& part : reader->info().parts)
    result.warnings.insert(result.warnings.end(), part.warnings.begin(), part.warnings.end());
  return result;
}

const Imf::Chromaticities kP3({0.68f, 0.32f}, {0.265f, 0.69f}, {0.15f, 0.06f}, {0.3127f, 0.329f});

TEST(ExrColour, ChromaticitiesAreDeclared) {
  EXPECT_FALSE(opened({small_part()}).declared.primaries) << "not said";
  TestPart part = small_part();
  Imf::addChromaticities(part.header, kP3);
  const Opened result = opened({part});
  ASSERT_TRUE(result.declared.primaries);
  EXPECT_FLOAT_EQ(static_cast<float>(result.declared.primaries->red[0]), 0.68f);
  EXPECT_FLOAT_EQ(static_cast<float>(result.declared.primaries->green[1]), 0.69f);
  EXPECT_FLOAT_EQ(static_cast<float>(result.declared.primaries->blue[0]), 0.15f);
  EXPECT_FLOAT_EQ(static_cast<float>(result.declared.primaries->white[1]), 0.329f);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.declared.alpha, AlphaKind::associated);
}

TEST(ExrColour, ChromaticitiesThatSpanNoTriangleAreIgnoredAndTold) {
  for (const auto& bad : {Imf::Chromaticities({0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}),
                          Imf::Chromaticities({NAN, 0.3f}, {0.3f, 0.6f}, {0.1f, 0.1f}, {0.3f, 0.3f}),
                          Imf::Chromaticities({1e30f, 0.3f}, {0.3f, 0.6f}, {0.1f, 0.1f}, {0.3f, 0.3f}),
                          Imf::Chromaticities({0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.3f, 0.0f})}) {
    TestPart part = small_part();
    Imf::addChromaticities(part.header, bad);
    const Opened result = opened({part});
    EXPECT_FALSE(result.declared.primaries);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("'chromaticities' holds no primaries"), std::string::npos);
  }
}

TEST(ExrColour, NamesOfTheColorInteropForum) {
  const auto named = [](const std::string& id) {
    TestPart part = small_part();
    part.header.insert("colorInteropID", Imf::StringAttribute(id));
    return opened({part});
  };
  const Opened ap1 = named("lin_ap1_scene");
  ASSERT_TRUE(ap1.declared.primaries);
  EXPECT_DOUBLE_EQ(ap1.declared.primaries->red[0], 0.713);
  EXPECT_DOUBLE_EQ(ap1.declared.primaries->white[0], 0.32168);
  EXPECT_TRUE(ap1.warnings.empty());
  EXPECT_DOUBLE_EQ(named("lin_ap0_scene").declared.primaries->green[1], 1.0);
  EXPECT_DOUBLE_EQ(named("lin_rec2020_scene").declared.primaries->green[1], 0.797);
  EXPECT_DOUBLE_EQ(named("lin_p3d65_scene").declared.primaries->red[0], 0.680);
  for (const char* bt709 : {"lin_rec709_scene", "lin_srgb", "data", "unknown"}) {
    EXPECT_FALSE(named(bt709).declared.primaries) << bt709;
    EXPECT_TRUE(named(bt709).warnings.empty()) << bt709;
  }
  const Opened gamma = named("g22_adobergb_scene");
  EXPECT_EQ(gamma.declared.curve, Curve::gamma);
  EXPECT_EQ(gamma.declared.gamma, 2.2);
  EXPECT_DOUBLE_EQ(gamma.declared.primaries->green[0], 0.21);
  const Opened srgb = named("srgb_texture");
  ASSERT_EQ(srgb.warnings.size(), 1u);
  EXPECT_NE(srgb.warnings[0].find("'srgb_texture' is not linear"), std::string::npos);
  for (const char* other : {"lin_ciexyzd65_scene", "arri_logc4", "nonsense"}) {
    ASSERT_EQ(named(other).warnings.size(), 1u) << other;
    EXPECT_NE(named(other).warnings[0].find("is not known"), std::string::npos);
  }
}

TEST(ExrColour, PartsThatDifferAreTold) {
  std::vector<TestPart> parts{small_part(), small_part()};
  parts[0].header.setName("a");
  parts[1].header.setName("b");
  for (TestPart& part : parts) Imf::addChromaticities(part.header, kP3);
  EXPECT_TRUE(opened(parts).declared.primaries) << "all say the same";
  EXPECT_TRUE(opened(parts).warnings.empty());
  // OpenEXR's Header::erase leaks.
  parts = {small_part(), small_part()};
  parts[0].header.setName("a");
  parts[1].header.setName("b");
  parts[1].header.insert("colorInteropID", Imf::StringAttribute("lin_ap1_scene"));
  const Opened differ = opened(parts);
  EXPECT_FALSE(differ.declared.primaries);
  ASSERT_EQ(differ.warnings.size(), 1u);
  EXPECT_NE(differ.warnings[0].find("not that of the file's other parts"), std::string::npos);
}

/// Y RY BY A of a colour that varies, at the full resolution or half of it.
void write_chroma(const std::string& path, const Imf::Header& like, bool tiled, const Imath::V3f& weights,
                  const std::function<Imath::V3f(int, int)>& colour) {
  constexpr int kWidth = 24, kHeight = 10;
  TestPart part{Imf::Header(kWidth, kHeight)};
  part.header.compression() = like.compression();
  if (Imf::hasChromaticities(like)) Imf::addChromaticities(part.header, Imf::chromaticities(like));
  for (const char* name : {"Y", "RY", "BY", "A"})
    part.header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (tiled) make_tiled(part, 8, 8);
  part.header.setType(tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  Image planes(kWidth, kHeight, 4);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Imath::V3f rgb = colour(x, y);
      const float luminance = rgb.dot(weights);
      float* to = planes.at(x, y);
      to[0] = luminance;
      to[1] = (rgb.x - luminance) / luminance;
      to[2] = (rgb.z - luminance) / luminance;
      to[3] = 0.5f;
    }
  }
  Imf::FrameBuffer frame;
  const std::array<const char*, 4> names{"Y", "RY", "BY", "A"};
  for (std::size_t c = 0; c < 4; ++c)
    frame.insert(names[c],
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes.at(0, 0) + c), 16, 16 * kWidth));
  Imf::MultiPartOutputFile file(path.c_str(), &part.header, 1);
  if (tiled) {
    Imf::TiledOutputPart output(file, 0);
    output.setFrameBuffer(frame);
    output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
  } else {
    Imf::OutputPart output(file, 0);
    output.setFrameBuffer(frame);
    output.writePixels(kHeight);
  }
}

TEST(ExrColour, FullChromaBecomesRgb) {
  const auto colour = [](int x, int y) {
    return Imath::V3f(0.1f + 0.02f * static_cast<float>(x), 0.5f, 2.0f - 0.1f * static_cast<float>(y));
  };
  const Folder folder;
  for (const bool tiled : {false, true}) {
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
      for (const bool p3 : {false, true}) {
        Imf::Header like(1, 1);
        like.compression() = compression;
        if (p3) Imf::addChromaticities(like, kP3);
        const std::string path = folder / "yc.exr";
        write_chroma(path, like, tiled, Imf::RgbaYca::computeYw(p3 ? kP3 : Imf::Chromaticities()), colour);
        ReadOptions as_stored;
        as_stored.keep_primaries = true;
        const auto reader = open(std::filesystem::path(path), as_stored);
        EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
        const Image image = read_all(*reader);
        for (int y = 0; y < image.height(); ++y) {
          for (int x = 0; x < image.width(); ++x) {
            const Imath::V3f rgb = colour(x, y);
            // Rounding of four float operations on values of at most 3.
            EXPECT_NEAR(image.at(x, y)[0], rgb.x, 2e-6);
            EXPECT_NEAR(image.at(x, y)[1], rgb.y, 4e-6);
            EXPECT_NEAR(image.at(x, y)[2], rgb.z, 2e-6);
            EXPECT_EQ(image.at(x, y)[3], 0.5f);
          }
        }
        Image two(24, 10, 2);
        reader->read(0, std::vector<int>{2, 0}, two.view());
        EXPECT_EQ(two.at(5, 5)[0], image.at(5, 5)[2]);
        EXPECT_EQ(two.at(5, 5)[1], image.at(5, 5)[0]);
      }
    }
  }
}

TEST(ExrColour, LayersAreConvertedToBt709) {
  const Folder folder;
  for (const auto& names : {std::vector<std::string>{"V.R", "V.G", "V.B"}, {"r", "g", "b"}}) {
    TestPart part = small_part(
        {{names[0], Imf::FLOAT}, {names[1], Imf::FLOAT}, {names[2], Imf::FLOAT}, {"Z", Imf::FLOAT}});
    Imf::addChromaticities(part.header, kP3);
    write_file(folder / "p3.exr", {part});
    ReadOptions keep;
    keep.keep_primaries = true;
    const auto reader = open(std::filesystem::path(folder / "p3.exr"));
    const auto stored = open(std::filesystem::path(folder / "p3.exr"), keep);
    const auto at = [&](Reader& from, const std::string& name) {
      const std::vector<std::string>& all = from.info().parts[0].channels;
      const auto index = std::find(all.begin(), all.end(), name) - all.begin();
      return static_cast<double>(read_all(from).at(3, 2)[index]);
    };
    const double r = at(*stored, names[0]), g = at(*stored, names[1]), b = at(*stored, names[2]);
    // Rows of the matrix from P3 to BT.709, both of white D65.
    EXPECT_NEAR(at(*reader, names[0]), 1.2249 * r - 0.2247 * g, 1e-3);
    EXPECT_NEAR(at(*reader, names[1]), -0.0421 * r + 1.0419 * g, 1e-3);
    EXPECT_NEAR(at(*reader, names[2]), -0.0196 * r - 0.0786 * g + 1.0983 * b, 1e-3);
    EXPECT_EQ(at(*reader, "Z"), at(*stored, "Z"));
  }
}

TEST(ExrColour, GreyOfFullChromaIsExact) {
  const Folder folder;
  write_chroma(folder / "grey.exr", Imf::Header(1, 1), false, {0.0f, 1.0f, 0.0f}, [](int x, int) {
    return Imath::V3f(0.1f * static_cast<float>(x + 1), 0.1f * static_cast<float>(x + 1),
                      0.1f * static_cast<float>(x + 1));
  });
  const Image image = read_all(*open(std::filesystem::path(folder / "grey.exr")));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(6, 2)[c], 0.1f * 7);
}

TEST(ExrColour, ColourBesideChromaIsReadAsItIs) {
  const Folder folder;
  std::map<std::string, Imf::PixelType> channels = kRgb;
  for (const char* name : {"Y", "RY", "BY"}) channels[name] = Imf::HALF;
  write_file(folder / "a.exr", {small_part(channels)});
  expect_equals_library(folder / "a.exr");
}

TEST(ExrColour, ChannelsBesideChromaAreTold) {
  const Opened result =
      opened({small_part({{"Y", Imf::HALF}, {"RY", Imf::HALF}, {"BY", Imf::HALF}, {"Z", Imf::FLOAT}})});
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0], "channel 'Z' beside luminance and chroma is left out");
}

}  // namespace
}  // namespace welkin::io
