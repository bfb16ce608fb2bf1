#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "welkin/map/map.h"

/// Which texels of a level lie within a part of the sphere, on any parameterization: across edges, poles and
/// folds. Internal to lookup.
namespace welkin {

/// A part of the sphere: within `reach` radians of a direction, and within `across` radians of the great
/// circle through it whose pole is `pole`.
struct SphereStrip {
  Vec3<float> direction, pole;
  float reach, across;
};

/// Texels by blocks of 16×4, blocks by sixteens, and so on; each with a cap that its texels' centres lie in.
class TexelBlocks {
 public:
  static constexpr int kWidth = 16, kHeight = 4;

  TexelBlocks(const sphere::AnyParameterization& p, const Level& level);

  struct Block {
    int chart, x, y, width, height;
  };

  /// Of the texels of a row from `x` on, sr; 0 where nothing is shown.
  const float* solid_angles(int chart, int x, int y) const {
    return solid_angles_.data() + (static_cast<std::ptrdiff_t>(chart) * height_ + y) * width_ + x;
  }

  /// Calls visit(Block) for all blocks whose caps meet the strip, in an order that depends on nothing else.
  template <class Visit>
  void for_each(const SphereStrip& strip, const Visit& visit) const {
    const Edge edge(strip);
    const int top = static_cast<int>(tiers_.size()) - 1;
    const Tier& tier = tiers_.back();
    for (int chart = 0; chart < charts_; ++chart) {
      for (int y = 0; y < tier.rows; ++y) {
        for (int x = 0; x < tier.columns; ++x) descend(top, chart, x, y, edge, visit);
      }
    }
  }

 private:
  struct Cap {
    Vec3<float> centre;
    float radius;  ///< negative: there is nothing in it
    float cosine, sine;
  };
  struct Tier {
    int columns, rows;
    std::vector<Cap> caps;
  };
  /// A strip, made ready for comparing.
  struct Edge {
    SphereStrip strip;
    float reach_cosine, reach_sine, across_cosine, across_sine;

    explicit Edge(const SphereStrip& s)
        : strip(s),
          reach_cosine(std::cos(s.reach)),
          reach_sine(std::sin(s.reach)),
          across_cosine(std::cos(s.across)),
          across_sine(std::sin(s.across)) {}

    bool meets(const Cap& cap) const {
      constexpr float kPiF = 3.14159265f;
      if (cap.radius < 0) return false;
      if (strip.reach + cap.radius < kPiF &&
          dot(strip.direction, cap.centre) < reach_cosine * cap.cosine - reach_sine * cap.sine) {
        return false;
      }
      return strip.across + cap.radius >= 0.5f * kPiF ||
             std::fabs(dot(strip.pole, cap.centre)) <= across_sine * cap.cosine + across_cosine * cap.sine;
    }
  };

  static constexpr int kFan = 4;

  template <class Visit>
  void descend(int tier, int chart, int x, int y, const Edge& edge, const Visit& visit) const {
    const Tier& here = tiers_[static_cast<std::size_t>(tier)];
    const int index = (chart * here.rows + y) * here.columns + x;
    if (!edge.meets(here.caps[static_cast<std::size_t>(index)])) return;
    if (tier == 0) {
      visit(Block{chart, x * kWidth, y * kHeight, std::min(kWidth, width_ - x * kWidth),
                  std::min(kHeight, height_ - y * kHeight)});
      return;
    }
    const Tier& below = tiers_[static_cast<std::size_t>(tier - 1)];
    for (int j = y * kFan; j < std::min((y + 1) * kFan, below.rows); ++j) {
      for (int i = x * kFan; i < std::min((x + 1) * kFan, below.columns); ++i) {
        descend(tier - 1, chart, i, j, edge, visit);
      }
    }
  }

  static Cap cap_around(const std::vector<Cap>& parts);
  Cap cap_of_block(const sphere::AnyParameterization& p, const Block& block) const;

  int charts_, width_, height_;
  std::vector<float> solid_angles_;
  std::vector<Tier> tiers_;  ///< blocks first
};

}  // namespace welkin
