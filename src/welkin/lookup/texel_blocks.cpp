#include "welkin/lookup/texel_blocks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "welkin/lookup/block_directions.h"

namespace welkin {
namespace {

/// What float directions may be off by, radians, added to every cap.
constexpr float kSlack = 1e-6f;

/// Between unit vectors, from their chord: precise where it is small, and never too small by rounding.
float angle_between(const Vec3<float>& a, const Vec3<float>& b) {
  const Vec3<float> chord = a - b;
  const float half = std::min(0.5f * std::sqrt(dot(chord, chord)), 1.0f);
  return 2 * std::asin(half);
}

}  // namespace

TexelBlocks::TexelBlocks(const sphere::AnyParameterization& p, const Level& level)
    : charts_(level.charts()), width_(level.width()), height_(level.height()) {
  solid_angles_.resize(static_cast<std::size_t>(charts_) * static_cast<std::size_t>(height_) *
                       static_cast<std::size_t>(width_));
  const auto parts = [](int size, int of) { return (size + of - 1) / of; };
  Tier blocks{parts(width_, kWidth), parts(height_, kHeight), {}};
  blocks.caps.resize(static_cast<std::size_t>(charts_) * static_cast<std::size_t>(blocks.rows) *
                     static_cast<std::size_t>(blocks.columns));
  tbb::parallel_for(tbb::blocked_range<int>(0, charts_ * blocks.rows, 4), [&](const auto& range) {
    for (int row = range.begin(); row != range.end(); ++row) {
      const int chart = row / blocks.rows, y = row % blocks.rows * kHeight;
      for (int j = y; j < std::min(y + kHeight, height_); ++j) {
        texel_solid_angles(p, width_, height_, chart, j,
                           solid_angles_.data() + (solid_angles(chart, 0, j) - solid_angles_.data()));
      }
      for (int i = 0; i < blocks.columns; ++i) {
        const int x = i * kWidth;
        blocks.caps[static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks.columns) +
                    static_cast<std::size_t>(i)] =
            cap_of_block(p, {chart, x, y, std::min(kWidth, width_ - x), std::min(kHeight, height_ - y)});
      }
    }
  });
  tiers_.push_back(std::move(blocks));
  while (tiers_.back().columns > kFan || tiers_.back().rows > kFan) {
    const Tier& below = tiers_.back();
    Tier tier{parts(below.columns, kFan), parts(below.rows, kFan), {}};
    for (int chart = 0; chart < charts_; ++chart) {
      for (int y = 0; y < tier.rows; ++y) {
        for (int x = 0; x < tier.columns; ++x) {
          std::vector<Cap> within;
          for (int j = y * kFan; j < std::min((y + 1) * kFan, below.rows); ++j) {
            for (int i = x * kFan; i < std::min((x + 1) * kFan, below.columns); ++i) {
              within.push_back(
                  below.caps[static_cast<std::size_t>((chart * below.rows + j) * below.columns + i)]);
            }
          }
          tier.caps.push_back(cap_around(within));
        }
      }
    }
    tiers_.push_back(std::move(tier));
  }
}

TexelBlocks::Cap TexelBlocks::cap_around(const std::vector<Cap>& parts) {
  Vec3<float> sum{0, 0, 0};
  bool any = false;
  for (const Cap& part : parts) {
    if (part.radius < 0) continue;
    any = true;
    sum = sum + part.centre;
  }
  if (!any) return {{0, 0, 1}, -1, 1, 0};
  const float far = length(sum);
  const Vec3<float> centre = far > 1e-3f ? (1 / far) * sum : Vec3<float>{0, 0, 1};
  float radius = 0;
  for (const Cap& part : parts) {
    if (part.radius >= 0) radius = std::max(radius, angle_between(centre, part.centre) + part.radius);
  }
  radius = std::min(radius + kSlack, static_cast<float>(kPi));
  return {centre, radius, std::cos(radius), std::sin(radius)};
}

TexelBlocks::Cap TexelBlocks::cap_of_block(const sphere::AnyParameterization& p, const Block& block) const {
  BlockDirections at;
  at.find(p, {width_, height_}, block);
  // The texels' centres as caps of no size.
  std::vector<Cap> texels;
  texels.reserve(at.kSize);
  std::size_t k = 0;
  for (int row = 0; row < block.height; ++row) {
    const float* solid_angle = solid_angles(block.chart, block.x, block.y + row);
    for (int i = 0; i < block.width; ++i, ++k) {
      if (solid_angle[i] > 0) texels.push_back({{at.x[k], at.y[k], at.z[k]}, 0, 1, 0});
    }
  }
  return cap_around(texels);
}

}  // namespace welkin
