#include "welkin/io/interpret.h"

#include <lcms2.h>

#include "welkin/io/colour/code_points.h"
#include "welkin/io/colour/colour_space.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// A reader of an image in memory whose file declares what a test wants.
class FakeReader : public FormatReader {
 public:
  FakeReader(Image image, std::vector<std::string> channels, Declared declared) : image_(std::move(image)) {
    declared_ = std::move(declared);
    info_.format = "fake";
    info_.parts.push_back(
        {"", image_.width(), image_.height(), std::move(channels), PixelType::float32, "none"});
  }
  void decode(std::size_t, std::span<const int> channels, ImageView<float> out) override {
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        for (std::size_t k = 0; k < channels.size(); ++k) {
          const float stored = image_.at(x, y)[channels[k]];
          const bool encoded = info_.colour == Colour::srgb &&
                               info_.parts[0].channels[static_cast<std::size_t>(channels[k])] != "A";
          out.at(x, y)[k] =
              encoded ? static_cast<float>(srgb_to_linear(static_cast<double>(stored))) : stored;
        }
      }
    }
  }

 private:
  Image image_;
};

std::unique_ptr<Reader> interpreted(Image image, std::vector<std::string> channels, Declared declared,
                                    const ReadOptions& options = {}) {
  return interpret(std::make_unique<FakeReader>(std::move(image), std::move(channels), std::move(declared)),
                   options);
}

Image of_values(int width, int height, int channels, const std::vector<float>& values) {
  Image image(width, height, channels);
  std::copy(values.begin(), values.end(), image.at(0, 0));
  return image;
}

/// A profile of R G B with a power as its curve, or of grey.
std::vector<std::byte> profile_of(const Chromaticities& c, double gamma, bool grey = false) {
  const cmsCIExyY white{c.white[0], c.white[1], 1};
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, gamma);
  cmsHPROFILE profile = nullptr;
  if (grey) {
    profile = cmsCreateGrayProfile(&white, curve);
  } else {
    const cmsCIExyYTRIPLE primaries{
        {c.red[0], c.red[1], 1}, {c.green[0], c.green[1], 1}, {c.blue[0], c.blue[1], 1}};
    cmsToneCurve* curves[3] = {curve, curve, curve};
    profile = cmsCreateRGBProfile(&white, &primaries, curves);
  }
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::vector<std::byte> bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return bytes;
}

TEST(Interpret, EveryOrientationStandsUpright) {
  // The letter F of 3×2, as Exif's examples show it in the eight orientations: upright it is 1 2 / 3 4 / 5 6.
  const std::vector<float> upright{1, 2, 3, 4, 5, 6};
  const std::vector<std::pair<int, std::vector<float>>> stored[2] = {
      {{1, {1, 2, 3, 4, 5, 6}}, {2, {2, 1, 4, 3, 6, 5}}, {3, {6, 5, 4, 3, 2, 1}}, {4, {5, 6, 3, 4, 1, 2}}},
      // Row 0 is the left, right, right, left side; column 0 the top, top, bottom, bottom.
      {{5, {1, 3, 5, 2, 4, 6}}, {6, {2, 4, 6, 1, 3, 5}}, {7, {6, 4, 2, 5, 3, 1}}, {8, {5, 3, 1, 6, 4, 2}}}};
  for (const bool turned : {false, true}) {
    for (const auto& [orientation, values] : stored[turned]) {
      Declared declared;
      declared.orientation = orientation;
      const auto reader = interpreted(of_values(turned ? 3 : 2, turned ? 2 : 3, 1, values), {"Y"}, declared);
      const Image image = read_part(*reader);
      ASSERT_EQ(image.width(), 2) << orientation;
      ASSERT_EQ(image.height(), 3) << orientation;
      for (int i = 0; i < 6; ++i)
        EXPECT_EQ(*image.at(i % 2, i / 2), upright[static_cast<std::size_t>(i)])
            << orientation << " at " << i;
    }
  }
}

TEST(Interpret, AnUprightLinearPictureIsLeftToItsFormat) {
  const auto reader = interpreted(of_values(1, 1, 3, {1, 2, 3}), {"R", "G", "B"}, {});
  EXPECT_NE(dynamic_cast<FakeReader*>(reader.get()), nullptr);
}

TEST(Interpret, AlphaIsMultipliedInWhereItIsRead) {
  Declared declared;
  declared.alpha = AlphaKind::straight;
  const auto reader = interpreted(of_values(1, 1, 4, {1, 0.5f, 2, 0.25f}), {"R", "G", "B", "A"}, declared);
  const Image image = read_part(*reader);
  EXPECT_EQ(image.at(0, 0)[0], 0.25f);
  EXPECT_EQ(image.at(0, 0)[2], 0.5f);
  EXPECT_EQ(image.at(0, 0)[3], 0.25f);
  Image colours(1, 1, 2);
  reader->read(0, std::vector{2, 1}, colours.view());
  EXPECT_EQ(colours.at(0, 0)[0], 2.0f);
}

TEST(Interpret, ColoursThatWereMultipliedEncodedAreLinear) {
  // 188 of 255 at half coverage: stored 94.
  Declared declared;
  declared.alpha = AlphaKind::encoded;
  auto fake = std::make_unique<FakeReader>(of_values(1, 1, 4, {94 / 255.0f, 0, 0, 0.5f}),
                                           std::vector<std::string>{"R", "G", "B", "A"}, declared);
  fake->set_colour(Colour::srgb);
  const Image image = read_part(*interpret(std::move(fake), {}));
  EXPECT_NEAR(image.at(0, 0)[0], 0.5 * srgb_to_linear(188 / 255.0), 1e-6);
}

TEST(Interpret, ACurveMeetsColoursWithoutTheirAlpha) {
  // A whole colour of 0.6 at half coverage: stored 0.3. Multiplied again once it is linear.
  const std::pair<Curve, double> curves[] = {{Curve::pq, to_linear(Curve::pq, 1, 0.6)},
                                             {Curve::gamma, std::pow(0.6, 2.8)},
                                             {Curve::bt709, to_linear(Curve::bt709, 1, 0.6)},
                                             {Curve::hlg, 0}};
  for (const auto& [curve, linear] : curves) {
    Declared declared;
    declared.alpha = AlphaKind::encoded;
    declared.curve = curve;
    declared.gamma = 2.8;
    const double scene = to_linear(Curve::hlg, 1, 0.6);
    const double expected = curve == Curve::hlg ? scene * hlg_display_gain(scene) : linear;
    const auto reader =
        interpreted(of_values(3, 1, 4, {0.3f, 0.3f, 0.3f, 0.5f, 0.6f, 0.6f, 0.6f, 1, 0, 0, 0, 0}),
                    {"R", "G", "B", "A"}, declared);
    const Image image = read_part(*reader);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(image.at(0, 0)[c], 0.5 * expected, 1e-5 * expected) << c;
      EXPECT_NEAR(image.at(1, 0)[c], expected, 1e-5 * expected) << c;
      EXPECT_EQ(image.at(2, 0)[c], 0.0f);
    }
    EXPECT_EQ(image.at(0, 0)[3], 0.5f);
    // Without alpha among the channels too.
    Image green(3, 1, 1);
    reader->read(0, std::vector{1}, green.view());
    EXPECT_EQ(*green.at(0, 0), image.at(0, 0)[1]);
  }
}

TEST(Interpret, AProfileMeetsColoursWithoutTheirAlpha) {
  for (const bool grey : {false, true}) {
    Declared declared;
    declared.alpha = AlphaKind::encoded;
    declared.icc = profile_of(grey ? kBt709 : *chromaticities_of(12), 1.8, grey);
    const std::vector<std::string> names =
        grey ? std::vector<std::string>{"Y", "A"} : std::vector<std::string>{"R", "G", "B", "A"};
    const int channels = static_cast<int>(names.size());
    std::vector<float> stored(names.size(), 0.2f);
    stored.back() = 0.25f;
    const Image image = read_part(*interpreted(of_values(1, 1, channels, stored), names, declared));
    for (int c = 0; c + 1 < channels; ++c)
      EXPECT_NEAR(image.at(0, 0)[c], 0.25 * std::pow(0.8, 1.8), 1e-3) << grey << c;
  }
}

TEST(Interpret, EncodedColoursGreaterThanTheirAlphaStayWithinTheRange) {
  Declared declared;
  declared.alpha = AlphaKind::encoded;
  declared.curve = Curve::pq;
  const Image image =
      read_part(*interpreted(of_values(1, 1, 4, {0.5f, 0, 0, 1 / 255.0f}), {"R", "G", "B", "A"}, declared));
  EXPECT_NEAR(image.at(0, 0)[0], 10000 / kDiffuseWhite / 255, 1e-4);
}

TEST(Interpret, AlphaOfLinearColoursIsAssociated) {
  Declared declared;
  declared.alpha = AlphaKind::encoded;
  ReadOptions linear;
  linear.colour = Colour::linear;
  declared.curve = Curve::pq;
  const auto reader =
      interpreted(of_values(1, 1, 4, {0.25f, 0, 0, 0.5f}), {"R", "G", "B", "A"}, declared, linear);
  EXPECT_EQ(read_part(*reader).at(0, 0)[0], 0.25f);
  EXPECT_TRUE(reader->info().notes.empty());
}

TEST(Interpret, AColourThatIsReadAloneIsConvertedAll) {
  Declared declared;
  declared.primaries = chromaticities_of(9);
  const auto reader = interpreted(of_values(1, 1, 4, {0, 9, 1, 0}), {"R", "Z", "G", "B"}, declared);
  const Image all = read_part(*reader);
  Image one(1, 1, 2);
  reader->read(0, std::vector{3, 1}, one.view());
  EXPECT_EQ(one.at(0, 0)[0], all.at(0, 0)[3]);
  EXPECT_EQ(one.at(0, 0)[1], 9.0f);
  EXPECT_NEAR(all.at(0, 0)[0], -0.5876, 1e-4);
}

TEST(Interpret, LayersAreConvertedEach) {
  Declared declared;
  declared.primaries = chromaticities_of(9);
  const auto reader = interpreted(of_values(1, 1, 6, {0, 1, 0, 1, 1, 1}),
                                  {"a.R", "a.G", "a.B", "b.c.R", "b.c.G", "b.c.B"}, declared);
  const Image image = read_part(*reader);
  EXPECT_NEAR(image.at(0, 0)[1], 1.1329, 1e-4);
  for (int c = 3; c < 6; ++c) EXPECT_NEAR(image.at(0, 0)[c], 1, 1e-6);
}

TEST(Interpret, ProfilesAreMadeLinearInBt709) {
  Declared declared;
  declared.icc = profile_of(*chromaticities_of(12), 2.2);  // Display P3's primaries
  const auto reader = interpreted(of_values(2, 1, 3, {1, 0, 0, 0.5f, 0.5f, 0.5f}), {"R", "G", "B"}, declared);
  const Image image = read_part(*reader);
  EXPECT_NEAR(image.at(0, 0)[0], 1.2249, 1e-3);
  EXPECT_NEAR(image.at(0, 0)[1], -0.0421, 1e-3);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(1, 0)[c], std::pow(0.5, 2.2), 1e-3);
  EXPECT_TRUE(reader->info().warnings.empty());

  ReadOptions keep;
  keep.keep_primaries = true;
  const Image own =
      read_part(*interpreted(of_values(1, 1, 3, {1, 0, 0.5f}), {"R", "G", "B"}, declared, keep));
  EXPECT_NEAR(own.at(0, 0)[0], 1, 1e-4);
  EXPECT_NEAR(own.at(0, 0)[1], 0, 1e-6);
  EXPECT_NEAR(own.at(0, 0)[2], std::pow(0.5, 2.2), 1e-4);
}

TEST(Interpret, AProfileOfGreyServesGrey) {
  Declared declared;
  declared.icc = profile_of(kBt709, 1.8, true);
  const Image image = read_part(*interpreted(of_values(1, 1, 1, {0.5f}), {"Y"}, declared));
  EXPECT_NEAR(*image.at(0, 0), std::pow(0.5, 1.8), 1e-3);
  const auto mismatched = interpreted(of_values(1, 1, 3, {0.5f, 0.5f, 0.5f}), {"R", "G", "B"}, declared);
  EXPECT_EQ(mismatched->info().warnings.size(), 1u);
}

TEST(Interpret, TheProfileOfSrgbIsTheExactFormula) {
  cmsHPROFILE profile = cmsCreate_sRGBProfile();
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  Declared declared;
  declared.icc.resize(size);
  cmsSaveProfileToMem(profile, declared.icc.data(), &size);
  cmsCloseProfile(profile);
  const auto reader = interpreted(of_values(1, 1, 3, {0.5f, 0.25f, 1}), {"R", "G", "B"}, declared);
  EXPECT_EQ(reader->info().colour, Colour::srgb);
  EXPECT_NE(dynamic_cast<FakeReader*>(reader.get()), nullptr);
}

TEST(Interpret, AProfileThatCannotBeReadIsTold) {
  for (const std::size_t size : {1u, 127u, 200u, 400u}) {
    Declared declared;
    declared.icc = profile_of(*chromaticities_of(12), 2.2);
    declared.icc.resize(size);
    const auto reader = interpreted(of_values(1, 1, 3, {1, 1, 1}), {"R", "G", "B"}, declared);
    EXPECT_EQ(reader->info().warnings.size(), 1u) << size;
  }
}

}  // namespace
}  // namespace welkin::io::test
