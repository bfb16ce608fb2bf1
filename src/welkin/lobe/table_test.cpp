#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <span>

#include "welkin/base/error.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lobe/panels.h"
#include "welkin/lobe/table_file.h"
#include "welkin/lobe/zonal.h"

namespace welkin::lobe {
namespace {

/// A file in a folder of its own, which goes with it. The name has a comma, as paths may.
class TableFile {
 public:
  explicit TableFile(const std::string& text)
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ("lobe-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(folder_);
    std::ofstream(path(), std::ios::binary) << text;
  }
  ~TableFile() { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "a,b.txt").string(); }

 private:
  std::filesystem::path folder_;
};

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Table, ReadsAFileOfPairs) {
  const TableFile file("\xEF\xBB\xBF# a hat\r\n0 2\r\n  30\t4 # largest\n\n60,1\n90 , 0");
  const AnyLobe lobe = AnyLobe::make("table,file=" + file.path());
  EXPECT_EQ(lobe.name(), "table");
  EXPECT_EQ(lobe.spec(), "table,file=" + file.path());
  EXPECT_FALSE(lobe.has_roughness());
  // Linear in the angle, over the largest value: error 1e-12.
  const auto at = [&](double degrees) { return lobe.weight(s_of_angle(degrees / 180 * kPi)); };
  EXPECT_NEAR(at(0), 0.5, 1e-12);
  EXPECT_NEAR(at(15), 0.75, 1e-12);
  EXPECT_NEAR(at(45), 0.625, 1e-12);
  EXPECT_NEAR(at(75), 0.125, 1e-12);
  EXPECT_EQ(at(90.001), 0);
  EXPECT_EQ(at(180), 0);
}

/// Memory and file give one lobe.
TEST(Table, IsTheSameFromMemory) {
  const TableFile file("0 1\n10 0.5\n20 0\n");
  const double degrees[] = {0, 10, 20}, values[] = {1, 0.5, 0};
  const AnyLobe a = AnyLobe::make("table,file=" + file.path());
  const AnyLobe b = AnyLobe::from_table("cone", degrees, values);
  EXPECT_EQ(b.spec(), "table,cone");
  for (double s = 0; s < 0.1; s += 1e-4) EXPECT_EQ(a.weight(s), b.weight(s));
}

TEST(Table, RefusesWhatIsNoLobeAndSaysWhere) {
  const auto expect = [](const std::string& text, const std::string& message) {
    const TableFile file(text);
    const std::string found = error_of([&] { AnyLobe::make("table,file=" + file.path()); });
    EXPECT_EQ(found.find(file.path()), 0u) << found;
    EXPECT_NE(found.find(message), std::string::npos) << found << " for " << text;
  };
  expect("", "fewer than two points");
  expect("# nothing\n\n", "fewer than two points");
  expect("0 1\n", "fewer than two points");
  expect("0 1\n20 1\n10 1\n", "line 3: the angle 10° is not above the one before, 20°");
  expect("0 1\n20 1\n20 1\n", "line 3");
  expect("1 1\n20 1\n", "line 1: the first angle is 1°, not 0");
  expect("-1 1\n20 1\n", "line 1: the angle -1° is not in 0…180°");
  expect("0 1\n181 1\n", "line 2: the angle 181° is not in 0…180°");
  expect("0 1\n\n# x\n20 -1\n", "line 4: the value -1");
  expect("0 0\n20 0\n", "all values are 0");
  expect("0 1\n1e-320 0\n", "narrower than 1e-7 radians");
  expect("0 1\n1e-6 1\n2e-6 0\n90 0\n", "narrower than 1e-7 radians");
  for (const char* line : {"20", "20 x", "x 20", "20 1 3", "20,,1", "nan 1", "20 nan", "20 inf", "1e999 1"}) {
    expect("0 1\n" + std::string(line) + "\n", "line 2: is not an angle and a value");
  }
  expect("0 1\n" + std::string(2 << 20, ' '), "over 1 MiB");
  std::string many;
  for (int i = 0; i < 10001; ++i) many += std::to_string(i * 0.01) + " 1\n";
  expect(many, "line 10001: has more than 10000 points");
}

TEST(Table, RefusesBadSpecsAndArrays) {
  EXPECT_NE(error_of([] { AnyLobe::make("table"); }).find("write table,file=PATH"), std::string::npos);
  EXPECT_NE(error_of([] { AnyLobe::make("table,cone"); }).find("write table,file=PATH"), std::string::npos);
  EXPECT_NE(error_of([] { AnyLobe::make("table,file=/nowhere/x"); }).find("/nowhere/x: cannot be opened"),
            std::string::npos);
  EXPECT_NE(error_of([] { AnyLobe::make("table,file=/"); }).find("cannot be read"), std::string::npos);
  const double angles[] = {0, 10, 20}, values[] = {1, 0.5};
  EXPECT_NE(
      error_of([&] { AnyLobe::from_table("cone", angles, values); }).find("cone: has 3 angles for 2 values"),
      std::string::npos);
}

/// Values of any size that doubles have: only their ratio counts.
TEST(Table, ScalesItsValues) {
  const double degrees[] = {0, 40}, huge[] = {1e308, 1e307}, tiny[] = {1e-300, 1e-301};
  const AnyLobe a = AnyLobe::from_table("huge", degrees, huge),
                b = AnyLobe::from_table("tiny", degrees, tiny);
  EXPECT_NEAR(a.integral() / b.integral(), 1, 1e-12);
  EXPECT_EQ(a.weight(0), 1);
}

/// The closed form against quadrature, of parts from 1e-7 to 2 radians wide; a cone's is its solid angle.
TEST(Table, HasTheIntegralOfItsWeights) {
  const double degrees[] = {0, 1e-5, 3e-5, 1e-3, 0.3, 5.7, 5.8, 12, 60, 65.7, 71.5, 180};
  const double values[] = {0.2, 1, 3, 2, 2.5, 2, 0, 0.5, 0.1, 0.3, 0, 0.2};
  for (std::size_t count = 2; count <= std::size(degrees); ++count) {
    const AnyLobe lobe = AnyLobe::from_table("any", std::span(degrees, count), std::span(values, count));
    const LobeNodes nodes = lobe_nodes(lobe, 0);
    const double sum = std::accumulate(nodes.weights.begin(), nodes.weights.end(), 0.0);
    EXPECT_NEAR(lobe.integral() / sum, 1, 1e-11) << count;
  }
  const double edge[] = {0, 30, 30.000001}, one[] = {1, 1, 0};
  EXPECT_NEAR(AnyLobe::from_table("cone", edge, one).integral(), 2 * kPi * (1 - 0.5 * std::sqrt(3.0)), 1e-7);
}

/// A uniform cone of half-angle θ: λ_1 = (1 + cos θ)/2, all but the step of 1e-6 degrees that ends it.
TEST(Table, HasTheZonalCoefficientsOfACone) {
  const double degrees[] = {0, 30, 30.000001}, values[] = {1, 1, 0};
  const AnyLobe cone = AnyLobe::from_table("cone", degrees, values);
  EXPECT_NEAR(zonal_coefficients(cone, 1)[1], 0.5 + 0.25 * std::sqrt(3.0), 1e-7);
  EXPECT_NEAR(cone.width(), kPi / 6, 1e-7);
}

}  // namespace
}  // namespace welkin::lobe
