#include "welkin/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <locale>
#include <random>

namespace welkin {
namespace {

TEST(NumberText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-200, 200);
  for (int i = 0; i < 2000; ++i) {
    const double value = std::pow(10, exponent(random)) * (i % 2 == 0 ? 1 : -1);
    EXPECT_EQ(parse_number(number_text(value)), value);
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(200), "200");
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* text : {"", " 1", "1 ", "1x", "nan", "inf", "1,5", "--1", "0x10"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
}

/// A host program may have set a locale that writes a decimal comma.
TEST(NumberText, KeepsItsPointInAnyLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(parse_number("0.5"), 0.5);
  std::locale::global(before);
}

}  // namespace
}  // namespace welkin
