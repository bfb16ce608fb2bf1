#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// Where in a texel a direction is drawn. Internal to ImportanceSampler.
namespace welkin::light {

/// A position in a texel, and how often it is drawn, over how often if the whole texel were drawn evenly over
/// (u, v).
struct PlaceInTexel {
  double x, y;  ///< 0…1
  double density;
};

/// Keeps positions off the edges of texels, where rounding decides which one they lie in.
inline double inset(double s) {
  constexpr double kInset = 1e-9;
  return kInset + (1 - 2 * kInset) * s;
}

/// The distribution within a texel whose solid angle isn't evenly spread over (u, v), or that a rim cuts: its
/// 8×8 cells in proportion to their solid angle, evenly within a cell; within one that a rim cuts, line by
/// line from rim to rim.
class TexelPattern {
 public:
  TexelPattern(const MapFrame& frame, int chart, int x, int y);

  /// Whether no part of the texel is valid.
  bool empty() const { return rows_.back() == 0; }

  /// By two numbers in [0, 1).
  PlaceInTexel place(const MapFrame& frame, int chart, int x, int y, double s, double t) const;
  /// The density at a place.
  double density(const MapFrame& frame, int chart, int x, int y, double across, double down) const;

 private:
  static constexpr std::size_t kSide = 8;
  using Sums = std::array<float, kSide>;  // cumulative: the last is 1, or 0 where there is nothing

  double evenness(std::size_t column, std::size_t row) const;
  bool is_cut(std::size_t column, std::size_t row) const { return (cut_ >> (row * kSide + column) & 1) != 0; }
  bool is_upright(std::size_t column, std::size_t row) const {
    return (upright_ >> (row * kSide + column) & 1) != 0;
  }

  Sums rows_{};
  std::array<Sums, kSide> columns_{};  ///< of each row
  std::uint64_t cut_ = 0;              ///< cells that a rim cuts
  std::uint64_t upright_ = 0;          ///< of these, those whose lines run along v
};

/// The patterns of the texels that need one.
class TexelPatterns {
 public:
  /// `solid_angles` are those of all texels; where nothing of one can be drawn, 0 is put there.
  TexelPatterns(const MapFrame& frame, std::vector<float>& solid_angles, const Monitor& monitor);

  /// That of a texel, or null: it is drawn evenly over (u, v).
  const TexelPattern* find(std::uint32_t row, std::uint32_t column) const {
    if (patterns_.empty()) return nullptr;
    const std::size_t bit = by_row_ ? row : static_cast<std::size_t>(row) * width_ + column;
    const Word& word = words_[bit / 64];
    const std::uint64_t mask = std::uint64_t{1} << bit % 64;
    if ((word.bits & mask) == 0) return nullptr;
    return &patterns_[word.before + static_cast<std::size_t>(std::popcount(word.bits & (mask - 1)))];
  }

 private:
  struct Word {
    std::uint64_t bits = 0;
    std::size_t before = 0;  ///< patterns of the words before it
  };

  std::uint32_t width_;
  bool by_row_;  ///< one pattern for all texels of a row
  std::vector<Word> words_;
  std::vector<TexelPattern> patterns_;
};

}  // namespace welkin::light
