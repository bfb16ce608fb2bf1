#include "welkin/prefilter/source_faults.h"

#include <gtest/gtest.h>

#include <limits>

namespace welkin {
namespace {

using sphere::AnyParameterization;

TEST(SourceFaults, AreCountedByTexelAndOnlyWhereTheMapIs) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  Map map(AnyParameterization::make("angular"), 40, 40, 3);
  const ImageView<float> chart = map.level.chart(0);
  chart.at(0, 0)[0] = kNan;  // a corner of the disc's square
  chart.at(20, 20)[0] = chart.at(20, 20)[1] = kNan;
  chart.at(21, 20)[2] = -kInfinity;
  chart.at(22, 20)[2] = -2e30f;
  chart.at(23, 20)[1] = 1e30f;
  chart.at(24, 20)[1] = -1e-30f;
  chart.at(25, 21)[0] = -0.0f;
  const SourceFaults faults = faults_of(map);
  EXPECT_EQ(faults.not_finite, 2u);
  EXPECT_EQ(faults.excessive, 1u);
  EXPECT_EQ(faults.negative, 1u);
}

}  // namespace
}  // namespace welkin
