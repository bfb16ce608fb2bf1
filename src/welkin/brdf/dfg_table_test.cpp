#include "welkin/brdf/dfg_table.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

/// Texels near every edge, where the integrals bend, and some between.
std::vector<int> places(int count) {
  std::vector<int> list;
  for (int i = 0; i < count; i += i < 12 ? 1 : count / 7) list.push_back(i);
  list.push_back(count - 1);
  return list;
}

void expect_reference(const DfgTable& table, const std::vector<double>& tolerances) {
  const Image image = make_dfg_table(table);
  ASSERT_EQ(image.width(), table.width);
  ASSERT_EQ(image.height(), table.height);
  ASSERT_EQ(image.channels(), static_cast<int>(table.channels.size()));
  for (const int y : places(table.height)) {
    for (const int x : places(table.width)) {
      for (std::size_t c = 0; c < table.channels.size(); ++c) {
        const double wanted =
            dfg_value(table.channels[c], table.cosine_at(x, y), table.roughness_at(x, y), table.masking);
        EXPECT_NEAR(image.at(x, y)[c], wanted, tolerances[c] * std::max(1.0, std::fabs(wanted)))
            << name_of(table.channels[c]) << " at " << x << " " << y;
      }
    }
  }
}

TEST(DfgTable, IsTheReferenceAtEveryTexel) {
  using enum DfgChannel;
  for (const GgxMasking masking :
       {GgxMasking::correlated, GgxMasking::separable, GgxMasking::schlick, GgxMasking::approximate}) {
    for (const TexelPlacement placement : {TexelPlacement::centres, TexelPlacement::ends}) {
      for (const CosineScale cosine : {CosineScale::linear, CosineScale::root}) {
        const DfgTable table{.width = 96,
                             .height = 24,
                             .cosine = cosine,
                             .placement = placement,
                             .masking = masking,
                             .channels = {scale, bias, one, missing}};
        expect_reference(table, {1e-6, 1e-6, 1e-6, 1e-6});
      }
    }
  }
}

TEST(DfgTable, IsTheReferenceForClothAndDiffuseToo) {
  using enum DfgChannel;
  expect_reference({.width = 96, .height = 16, .channels = {cloth, sheen, disney_diffuse, zero}},
                   {1e-5, 1e-5, 1e-6, 0});
}

/// Where rows are long, most of a row is interpolated.
TEST(DfgTable, IsTheReferenceInLongRows) {
  using enum DfgChannel;
  expect_reference({.width = 1500, .height = 3, .channels = {bias, one}}, {1e-6, 1e-6});
  expect_reference({.width = 1500, .height = 3, .placement = TexelPlacement::ends, .channels = {bias, cloth}},
                   {1e-6, 1e-5});
}

/// Rounding takes no value out of what integers hold.
TEST(DfgTable, StaysWithinItsLimits) {
  using enum DfgChannel;
  for (const GgxMasking masking : {GgxMasking::correlated, GgxMasking::separable}) {
    const DfgTable table{.masking = masking, .channels = {scale, bias, one, missing}};
    const Image image = make_dfg_table(table);
    for (int y = 0; y < table.height; ++y) {
      for (int i = 0; i < 4 * table.width; ++i) {
        EXPECT_GE(image.at(0, y)[i], 0) << y;
        EXPECT_LE(image.at(0, y)[i], 1) << y;
      }
    }
  }
}

TEST(DfgTable, TurnsAndScalesItsAxes) {
  const DfgTable across{.width = 40, .height = 8};
  DfgTable down{.width = 8, .height = 40, .cosine_down = true};
  const Image a = make_dfg_table(across), b = make_dfg_table(down);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 2; ++c) EXPECT_EQ(a.at(x, y)[c], b.at(y, x)[c]);
    }
  }
  EXPECT_EQ(across.cosine_at(0, 3), 0.5 / 40);
  EXPECT_EQ(across.roughness_at(0, 3), 3.5 / 8);
  down.cosine = CosineScale::root;
  down.roughness = RoughnessScale::alpha;
  down.placement = TexelPlacement::ends;
  EXPECT_NEAR(down.cosine_at(2, 13), 1.0 / 9, 1e-15);
  EXPECT_NEAR(down.roughness_at(2, 13), std::sqrt(2.0 / 7), 1e-15);
  EXPECT_EQ(down.cosine_at(0, 39), 1);
}

TEST(DfgTable, IsTheSameOnOneThread) {
  const DfgTable table{.width = 64, .height = 16};
  const Image many = make_dfg_table(table);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Image single = make_dfg_table(table);
  for (int y = 0; y < 16; ++y)
    EXPECT_EQ(std::memcmp(many.at(0, y), single.at(0, y), 64 * 2 * sizeof(float)), 0);
}

TEST(DfgTable, NamesItsChannelsAndMaskings) {
  for (const std::string& name : dfg_channel_names()) EXPECT_EQ(name_of(dfg_channel_from_name(name)), name);
  for (const char* name : {"correlated", "separable", "schlick", "approximate"})
    EXPECT_EQ(name_of(ggx_masking_from_name(name)), name);
  EXPECT_THROW(dfg_channel_from_name("sacle"), Error);
  EXPECT_THROW(ggx_masking_from_name(""), Error);
}

TEST(DfgTable, RefusesWhatIsNoTable) {
  EXPECT_THROW(make_dfg_table({.width = 0}), Error);
  EXPECT_THROW(make_dfg_table({.height = -5}), Error);
  EXPECT_THROW(make_dfg_table({.width = 4097}), Error);
  EXPECT_THROW(make_dfg_table({.channels = {}}), Error);
  EXPECT_THROW(make_dfg_table({.channels = std::vector<DfgChannel>(5, DfgChannel::one)}), Error);
  EXPECT_EQ(make_dfg_table({.width = 1, .height = 1}).width(), 1);
}

TEST(DfgTable, CanBeCancelled) {
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  EXPECT_THROW(make_dfg_table({}, monitor), Cancelled);
}

}  // namespace
}  // namespace welkin::brdf
