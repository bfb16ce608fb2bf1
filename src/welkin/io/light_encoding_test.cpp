#include "welkin/io/light_encoding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

namespace welkin::io {
namespace {

std::vector<LightEncoding> all_encodings() {
  std::vector<LightEncoding> list;
  for (const std::string& name : light_encoding_names()) list.push_back(LightEncoding::from_name(name));
  list.push_back(LightEncoding::from_name("rgbm,range=64"));
  return list;
}

/// The engines' own decoders, written from their formulas.
double decoded(const LightEncoding& encoding, const std::uint8_t* p, int c) {
  const double x = p[c] / 255.0, a = p[3] / 255.0;
  switch (encoding.kind) {
    case LightEncoding::Kind::rgbm:
      return encoding.range * a * x;
    case LightEncoding::Kind::rgbd:
      return std::pow(x, 2.2) / a;
    case LightEncoding::Kind::rgbp:
      return std::pow(x * (-a * 7 + 8), 2);
    case LightEncoding::Kind::rgbe:
      return p[3] == 0 ? 0 : p[c] * std::exp2(p[3] - 136);
  }
  return 0;
}

/// Values from 1e-4 of the largest that counts to all of it.
std::vector<float> values(const LightEncoding& encoding) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decades(-4, 0);
  std::vector<float> list;
  for (int i = 0; i < 3000; ++i)
    list.push_back(static_cast<float>(std::min(encoding.largest(), 1e6) * std::pow(10, decades(random))));
  return list;
}

/// A value is no further from what is stored than the neighbouring code of its channel.
TEST(LightEncoding, RoundTripsToItsStep) {
  for (const LightEncoding& encoding : all_encodings()) {
    const std::vector<float> rgb = values(encoding);
    const std::size_t count = rgb.size() / 3;
    std::vector<std::uint8_t> stored(4 * count);
    std::vector<float> back(3 * count);
    WriteReport report;
    encoding.encode(rgb.data(), 3, count, stored.data(), report);
    encoding.decode(stored.data(), count, back.data());
    EXPECT_EQ(report.above + report.below + report.not_finite, 0u);
    for (std::size_t i = 0; i < count; ++i) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = 3 * i + static_cast<std::size_t>(c);
        std::uint8_t* p = &stored[4 * i];
        const double value = static_cast<double>(rgb[at]), exact = decoded(encoding, p, c);
        EXPECT_NEAR(static_cast<double>(back[at]), exact, 1e-6 * exact) << encoding.text();
        const std::uint8_t code = p[c];
        p[c] = static_cast<std::uint8_t>(code < 255 ? code + 1 : 254);
        const double step = std::fabs(decoded(encoding, p, c) - exact);
        p[c] = code;
        EXPECT_LE(std::fabs(exact - value), 0.75 * step + 1e-6 * value) << encoding.text() << ' ' << value;
      }
    }
  }
}

/// The error that is told is the one that there is.
TEST(LightEncoding, TellsItsError) {
  for (const LightEncoding& encoding : all_encodings()) {
    const std::vector<float> rgb = values(encoding);
    std::vector<std::uint8_t> stored(rgb.size() / 3 * 4);
    std::vector<float> back(rgb.size());
    WriteReport report;
    encoding.encode(rgb.data(), 3, rgb.size() / 3, stored.data(), report);
    encoding.decode(stored.data(), rgb.size() / 3, back.data());
    double error = 0, all = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      error += std::pow(static_cast<double>(back[i]) - static_cast<double>(rgb[i]), 2);
      all += std::pow(static_cast<double>(rgb[i]), 2);
    }
    EXPECT_NEAR(report.relative_rmse(), std::sqrt(error / all), 1e-9) << encoding.text();
    EXPECT_LT(report.relative_rmse(), 0.01) << encoding.text();
    EXPECT_GT(report.relative_rmse(), 1e-4) << encoding.text();
  }
}

TEST(LightEncoding, CountsWhatItClips) {
  for (const LightEncoding& encoding : all_encodings()) {
    const auto most = static_cast<float>(encoding.largest());
    const bool more = most < 1e30f;
    const float rgb[] = {more ? 2 * most : most, -1, 0,
                         std::nanf(""),          0,  std::numeric_limits<float>::infinity()};
    std::uint8_t stored[8];
    WriteReport report;
    encoding.encode(rgb, 3, 2, stored, report);
    EXPECT_EQ(report.above, more ? 1u : 0u);
    EXPECT_EQ(report.below, 1u);
    EXPECT_EQ(report.not_finite, 2u);
    float back[6];
    encoding.decode(stored, 2, back);
    EXPECT_NEAR(static_cast<double>(back[0]) / encoding.largest(), 1, 1e-6) << encoding.text();
    for (int c = 1; c < 5; ++c) EXPECT_EQ(back[c], 0) << encoding.text();
    EXPECT_NEAR(static_cast<double>(back[5]) / encoding.largest(), 1, 1e-6) << encoding.text();
  }
}

TEST(LightEncoding, IsNamed) {
  for (const LightEncoding& encoding : all_encodings())
    EXPECT_EQ(LightEncoding::from_name(encoding.text()).text(), encoding.text());
  EXPECT_EQ(LightEncoding::from_name("rgbm").range, 6);
  for (const char* text :
       {"", "rgbx", "rgbd,range=3", "rgbm,range=0", "rgbm,range=nan", "rgbm,scale=3", "rgbm,"})
    EXPECT_THROW(LightEncoding::from_name(text), Error) << text;
}

/// Any bytes decode to finite values that are not negative.
TEST(LightEncoding, AllBytesAreLight) {
  for (const LightEncoding& encoding : all_encodings()) {
    for (int a = 0; a < 256; ++a) {
      for (const int x : {0, 1, 128, 255}) {
        const std::uint8_t p[4] = {static_cast<std::uint8_t>(x), 0, 255, static_cast<std::uint8_t>(a)};
        float rgb[3];
        encoding.decode(p, 1, rgb);
        for (const float value : rgb) EXPECT_TRUE(std::isfinite(value) && value >= 0) << encoding.text();
      }
    }
  }
}

}  // namespace
}  // namespace welkin::io
