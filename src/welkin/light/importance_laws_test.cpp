#include <gtest/gtest.h>

#include "welkin/light/importance_cases.h"

namespace welkin {
namespace {

using namespace importance_cases;
using cases::make_map;

/// Stratified numbers stay so: of n×n numbers, one in each cell of a grid, the number that fall into the rows
/// up to any row differs from what is expected by at most one row of cells, and so for the columns of a row.
TEST(ImportanceLaws, CdfKeepsStratification) {
  const Map map = random_map("latlong", 16);
  const ImportanceSampler sampler(map);
  constexpr int kSide = 64;
  std::vector<double> of_rows(static_cast<std::size_t>(map.height()));
  for (const auto& [u1, u2] : stratified(kSide, 5))
    of_rows[static_cast<std::size_t>(sampler.draw(u1, u2).y)] += 1;
  const std::vector<double> marginal = sampler.marginal_cdf();
  double seen = 0;
  for (std::size_t y = 0; y < of_rows.size(); ++y) {
    seen += of_rows[y];
    EXPECT_NEAR(seen, marginal[y] * kSide * kSide, kSide + 1e-6);
  }
}

TEST(ImportanceLaws, ManyDrawsAreThoseOfOneByOne) {
  const Map map = random_map("cube", 9);
  std::vector<double> u1, u2;
  for (const auto& [a, b] : stratified(13, 2)) {
    u1.push_back(a);
    u2.push_back(b);
  }
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    std::vector<ImportanceDraw> many(u1.size());
    sampler.draw(u1, u2, many);
    for (std::size_t i = 0; i < many.size(); ++i) {
      const ImportanceDraw one = sampler.draw(u1[i], u2[i]);
      EXPECT_EQ(many[i].direction.x, one.direction.x);
      EXPECT_EQ(many[i].pdf, one.pdf);
      EXPECT_EQ(many[i].chart, one.chart);
      EXPECT_EQ(many[i].y, one.y);
    }
    EXPECT_NE(cases::refusal([&] { sampler.draw(u1, u2, std::span(many).subspan(1)); }), "done");
  }
}

/// Buckets of the guide that hold the ends of many values: a row of one light among texels 10⁹ times darker.
TEST(ImportanceLaws, AnySkewIsDrawnAsItIs) {
  Map map = cases::make_map("equal-area", 64);
  cases::render(map, [](const Vec3d&) { return 1; });
  const int x = 70, y = 20;
  *map.level.chart(0).at(x, y) = 1e9f;
  const ImportanceSampler sampler(map);
  const double before = sampler.marginal_cdf()[y - 1], after = sampler.marginal_cdf()[y];
  const std::vector<double> row = sampler.conditional_cdf(y);
  // Aimed at the middle of each texel's part of the row.
  for (int i = 0; i < map.width(); ++i) {
    const double from = i == 0 ? 0 : row[static_cast<std::size_t>(i - 1)];
    const ImportanceDraw draw =
        sampler.draw((from + row[static_cast<std::size_t>(i)]) / 2, (before + after) / 2);
    EXPECT_EQ(draw.x, i);
    EXPECT_EQ(draw.y, y);
  }
}

TEST(ImportanceLaws, TablesAreOfTheTexelsProbabilities) {
  const Map map = random_map("cube", 8);
  const int rows = map.charts() * map.height();
  const ImportanceSampler cdf(map), alias(map, {.method = ImportanceMethod::alias});
  const std::vector<double> marginal = cdf.marginal_cdf();
  ASSERT_EQ(marginal.size(), static_cast<std::size_t>(rows));
  EXPECT_EQ(marginal.back(), 1);
  std::vector<double> own(static_cast<std::size_t>(rows * map.width()));
  for (int row = 0; row < rows; ++row) {
    const std::vector<double> conditional = cdf.conditional_cdf(row);
    const auto entries = alias.alias_row(row);
    const double share = marginal[static_cast<std::size_t>(row)] -
                         (row == 0 ? 0 : marginal[static_cast<std::size_t>(row - 1)]);
    for (int x = 0; x < map.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(x);
      const double part = conditional[i] - (x == 0 ? 0 : conditional[i - 1]);
      EXPECT_NEAR(share * part, cdf.probability(row / map.height(), x, row % map.height()), 1e-15);
      own[static_cast<std::size_t>(row * map.width() + x)] += static_cast<double>(entries[i].threshold);
      own[entries[i].alias] += 1 - static_cast<double>(entries[i].threshold);
    }
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    const int row = static_cast<int>(i) / map.width(), x = static_cast<int>(i) % map.width();
    EXPECT_NEAR(own[i] / static_cast<double>(own.size()),
                alias.probability(row / map.height(), x, row % map.height()), 1e-7);
  }
}

TEST(ImportanceLaws, DirectionsOfAnyLengthAndNone) {
  const ImportanceSampler sampler(random_map("latlong", 8));
  const Vec3d d = sampler.draw(0.3, 0.6).direction;
  const double pdf = sampler.pdf(d);
  for (const double scale : {1e-300, 1e-20, 3.0, 1e300}) EXPECT_NEAR(sampler.pdf(scale * d) / pdf, 1, 1e-6);
  const double nan = std::nan(""), infinity = HUGE_VAL;
  for (const Vec3d& none :
       {Vec3d{0, 0, 0}, Vec3d{nan, 0, 1}, Vec3d{0, infinity, 0}, Vec3d{-infinity, infinity, 0}})
    EXPECT_EQ(sampler.pdf(none), 0);
  EXPECT_GT(sampler.draw(nan, nan).pdf, 0);
  const ImportanceSampler half(random_map("half-cube", 8));
  double behind = 0;
  for (const double sign : {-1.0, 1.0}) {
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
      behind += half.pdf(sign * axis) == 0 ? 1 : 0;
  }
  EXPECT_GE(behind, 1);
}

TEST(ImportanceLaws, ValuesThatAreNoLight) {
  Map map = random_map("latlong", 8);
  map.level.chart(0).at(3, 2)[0] = -1000;
  EXPECT_EQ(ImportanceSampler(map).negative_texels(), 1u);
  EXPECT_EQ(ImportanceSampler(map).probability(0, 3, 2), 0);
  map.level.chart(0).at(2, 2)[1] = std::nanf("");
  map.level.chart(0).at(1, 1)[2] = HUGE_VALF;
  EXPECT_NE(cases::refusal([&] { ImportanceSampler{map}; }).find("2 texels"), std::string::npos);
  EXPECT_NE(cases::refusal([&] {
              ImportanceSampler(map, {.look_up = Filter::lanczos});
            }).find("nearest or bilinear"),
            std::string::npos);
  const ImportanceSampler good(random_map("latlong", 8));
  EXPECT_NE(cases::refusal([&] { good.alias_row(0); }), "done");
  EXPECT_NE(cases::refusal([&] { good.conditional_cdf(99); }), "done");
  EXPECT_NE(cases::refusal([&] { good.probability(0, -1, 0); }), "done");
  EXPECT_NE(cases::refusal([] { importance_method_from_name("alais"); }).find("did you mean 'alias'"),
            std::string::npos);
}

/// Lights of any range: the largest and the smallest floats.
TEST(ImportanceLaws, AnyRange) {
  Map map = make_map("latlong", 8);
  cases::render(map, [](const Vec3d&) { return 1e-38; });
  *map.level.chart(0).at(4, 3) = 3e38f;
  fill_borders(map);
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    for (const auto& [u1, u2] : stratified(8, 1)) {
      const ImportanceDraw draw = sampler.draw(u1, u2);
      EXPECT_EQ(draw.x, 4);
      EXPECT_EQ(draw.y, 3);
      EXPECT_NEAR(sampler.pdf(draw.direction) / draw.pdf, 1, 1e-6);
    }
  }
}

}  // namespace
}  // namespace welkin
