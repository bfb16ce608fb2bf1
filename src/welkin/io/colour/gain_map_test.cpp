#include "welkin/io/colour/gain_map.h"

#include <cmath>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/jpeg/jpeg_test_files.h"

namespace welkin::io::test {
namespace {

Image of_colour(int width, int height, const std::vector<float>& colour) {
  Image image(width, height, static_cast<int>(colour.size()));
  for (int i = 0; i < width * height; ++i)
    std::copy(colour.begin(), colour.end(),
              image.at(0, 0) + static_cast<std::ptrdiff_t>(i) * image.channels());
  return image;
}

Bytes jpeg(const Image& image, Colour colour = Colour::srgb) {
  WriteOptions options;
  options.quality = 100;
  options.colour = colour;
  return encoded("jpg", image, options);
}

std::string with_description(const std::string& attributes, const std::string& elements = "") {
  return std::string(kXmpMarker) +
         "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
         "xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>"
         "<rdf:Description xmlns:hdrgm='http://ns.adobe.com/hdr-gain-map/1.0/' hdrgm:Version='1.0' " +
         attributes + ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

const std::string kIso("urn:iso:std:iso:ts:21496:-1\0", 28);

std::string words(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) {
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255);
  }
  return text;
}

Bytes joined(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

constexpr double kBase = 188;  // of 255
const double kLinear = srgb_to_linear(kBase / 255);

Bytes base_with(const std::string& body, char marker) {
  const auto value = static_cast<float>(kLinear);
  return with_marker(jpeg(of_colour(16, 8, {value, value, value})), marker, body);
}

TEST(GainMap, AdobesWordsMakeItHdr) {
  const Bytes gains =
      with_marker(jpeg(of_colour(4, 2, {1, 1, 1}), Colour::linear), '\xe1',
                  with_description("hdrgm:GainMapMin='0' hdrgm:GainMapMax='3' hdrgm:Gamma='1' "
                                   "hdrgm:OffsetSDR='0' hdrgm:OffsetHDR='0'"));
  const Bytes file = joined(base_with(with_description(""), '\xe1'), gains);
  const Image image = decoded(file);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(5, 5)[c], 8 * kLinear, 1e-4);
  EXPECT_TRUE(info_of(file).warnings.empty());
  EXPECT_EQ(info_of(file).notes.at(0), "made HDR by its gain map, of up to 3 stops");
}

TEST(GainMap, EveryNumberCounts) {
  // Each channel has its own numbers. Stored 128 of 255.
  const auto sequence = [](const std::string& name, const std::string& a, const std::string& b,
                           const std::string& c) {
    return "<hdrgm:" + name + "><rdf:Seq><rdf:li>" + a + "</rdf:li><rdf:li>" + b + "</rdf:li><rdf:li>" + c +
           "</rdf:li></rdf:Seq></hdrgm:" + name + ">";
  };
  const Bytes gains = with_marker(
      jpeg(of_colour(4, 2, {128 / 255.0f, 128 / 255.0f, 128 / 255.0f}), Colour::linear), '\xe1',
      with_description("hdrgm:OffsetSDR='0.25' hdrgm:OffsetHDR='0.125'",
                       sequence("GainMapMin", "-1", "0", "1") + sequence("GainMapMax", "2", "3", "4") +
                           sequence("Gamma", "1", "0.5", "2")));
  const Image image = decoded(joined(base_with(with_description(""), '\xe1'), gains));
  const double minimum[] = {-1, 0, 1}, maximum[] = {2, 3, 4}, gamma[] = {1, 0.5, 2};
  for (int c = 0; c < 3; ++c) {
    const double gain = minimum[c] + (maximum[c] - minimum[c]) * std::pow(128 / 255.0, 1 / gamma[c]);
    EXPECT_NEAR(image.at(3, 3)[c], (kLinear + 0.25) * std::exp2(gain) - 0.125, 2e-3);
  }
}

TEST(GainMap, IsosBytesMakeItHdr) {
  const std::string version("\0\0\0\0", 4);
  // Fractions: headrooms 0 and 3; then minimum 0, maximum 3, gamma 1, both offsets 0.
  const std::string fractions = words({0, 1, 3, 1, 0, 1, 6, 2, 1, 1, 0, 1, 0, 1});
  const std::string common = words({2, 0, 6, 0, 6, 2, 0, 0});
  for (const std::string& numbers : {std::string("\x40") + fractions, std::string("\x48") + common}) {
    const Bytes gains =
        with_marker(jpeg(of_colour(4, 2, {1}), Colour::linear), '\xe2', kIso + version + numbers);
    const Image image = decoded(joined(base_with(kIso + version, '\xe2'), gains));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(5, 5)[c], 8 * kLinear, 1e-4);
  }
}

TEST(GainMap, GainsAreInterpolatedBetweenCentres) {
  Image ramp(2, 1, 1);
  *ramp.at(1, 0) = 1;
  WriteOptions options;
  options.colour = Colour::linear;
  GainMapMetadata metadata;
  metadata.base_offset = metadata.alternate_offset = {0, 0, 0};
  const Bytes bytes = encoded("png", ramp, options);
  GainMap map(metadata, open(bytes, "gains"));
  Image base = of_colour(8, 1, {1});
  map.apply(base.view(), 0, 0, 0);
  const double weights[8] = {0, 0, 0.125, 0.375, 0.625, 0.875, 1, 1};
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(*base.at(x, 0), std::exp2(weights[x]), 1e-5) << x;
}

TEST(GainMap, ABaseThatIsHdrStays) {
  const Bytes gains = with_marker(jpeg(of_colour(4, 2, {1, 1, 1}), Colour::linear), '\xe1',
                                  with_description("hdrgm:GainMapMax='3' hdrgm:BaseRenditionIsHDR='True'"));
  const Bytes file = joined(base_with(with_description(""), '\xe1'), gains);
  EXPECT_NEAR(decoded(file).at(5, 5)[0], kLinear, 1e-4);
  EXPECT_TRUE(info_of(file).warnings.empty());
}

TEST(GainMap, WhatIsMissingOrMalformedIsTold) {
  const Bytes base = base_with(with_description(""), '\xe1');
  EXPECT_EQ(info_of(base).warnings.size(), 1u);
  for (const std::string words :
       {"hdrgm:GainMapMax='much'", "hdrgm:GainMapMax='1e9'", "hdrgm:GainMapMax='3' hdrgm:Gamma='0'"}) {
    const Bytes gains = with_marker(jpeg(of_colour(4, 2, {1, 1, 1})), '\xe1', with_description(words));
    const FileInfo info = info_of(joined(base, gains));
    ASSERT_EQ(info.warnings.size(), 1u) << words;
    EXPECT_NE(info.warnings[0].find("gain map is left out"), std::string::npos) << info.warnings[0];
  }
  for (std::size_t size = 5; size < 60; size += 3) {
    const std::string numbers =
        (std::string("\0\0\0\0\x40", 5) + words({0, 1, 3, 1, 0, 1, 6, 2, 1, 1, 0, 1, 0, 1})).substr(0, size);
    const Bytes gains = with_marker(jpeg(of_colour(4, 2, {1}), Colour::linear), '\xe2', kIso + numbers);
    EXPECT_EQ(info_of(joined(base, gains)).warnings.size(), 1u) << size;
  }
}

TEST(GainMap, FractionsOverZeroAreOutOfRange) {
  // Headrooms, minimum, maximum, gamma and both offsets; each denominator in turn is 0, also where that makes
  // 0/0.
  const auto metadata_of = [](const std::vector<int>& numbers) {
    std::string text("\0\0\0\0\x40", 5);
    for (const int number : numbers) text += words({number});
    return gain_map_metadata(bytes_of(text));
  };
  const std::vector<int> sound{0, 1, 3, 1, 0, 1, 6, 2, 1, 1, 0, 1, 0, 1};
  EXPECT_EQ(metadata_of(sound)->maximum[2], 3);
  for (std::size_t i = 1; i < sound.size(); i += 2) {
    std::vector<int> numbers = sound;
    numbers[i] = 0;
    EXPECT_NE(error_of([&] { metadata_of(numbers); }).find("out of range"), std::string::npos) << i;
  }
  const std::string common = std::string("\0\0\0\0\x48", 5) + words({0, 0, 6, 0, 6, 2, 0, 0});
  EXPECT_NE(error_of([&] { gain_map_metadata(bytes_of(common)); }).find("out of range"), std::string::npos);
}

TEST(GainMap, DamageIsSurvived) {
  const Bytes gains = with_marker(jpeg(of_colour(4, 2, {1, 1, 1}), Colour::linear), '\xe1',
                                  with_description("hdrgm:GainMapMax='3'"));
  expect_damage_is_survived(joined(base_with(with_description(""), '\xe1'), gains));
}

}  // namespace
}  // namespace welkin::io::test
