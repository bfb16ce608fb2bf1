#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Which roughness each level of a chain has.
namespace welkin::lobe {

/// Which roughness each level of a chain is filtered for: an engine's own curve by its name, or a list. The
/// engine reads a surface of roughness r at level_of(r), so a level is filtered for the roughness that is
/// read there.
class WELKIN_API RoughnessCurve {
 public:
  /// One of roughness_curve_names, or a list: `0,0.1,0.5,1,1`. Throws Error: unknown names (the nearest is
  /// suggested), a list with what isn't a number of 0 … 1, or that falls somewhere.
  static RoughnessCurve from_name(std::string_view text);

  /// What from_name takes to get this one again.
  std::string text() const { return text_; }
  std::string description() const;  ///< the formula, x = level / last level
  std::string source() const;       ///< of an engine: the function it is in

  /// How many levels a list is for; 0 for a named curve, which takes any number.
  int listed_levels() const { return static_cast<int>(list_.size()); }

  /// Roughness at a level, a real number and not NaN, clamped to 0 … levels − 1; between two levels of a list
  /// it is linear. Never falls as the level grows. Throws Error when there is a list, and it is for another
  /// number of levels; `levels` is at least 1. A chain of one level is at roughness 0, or what the list has;
  /// of unreal, three.js-r186 and babylon at 1. `playcanvas` ends below 1 when there are fewer than six
  /// levels.
  double roughness(double level, int levels) const;
  /// The inverse, clamped to 0 … levels − 1. Where several levels have the roughness, the first. Throws Error
  /// like `roughness`, and for a roughness outside 0 … 1.
  double level_of(double roughness, int levels) const;

  /// roughness(k, levels) for k = 0 … levels − 1. Throws Error like `roughness`.
  std::vector<double> roughness_of_levels(int levels) const;

 private:
  explicit RoughnessCurve(std::string text) : text_(std::move(text)) {}
  void check_levels(int levels) const;

  std::string text_;
  std::vector<double> list_;
};

/// Names of the curves that aren't lists, `linear` first.
WELKIN_API const std::vector<std::string>& roughness_curve_names();

}  // namespace welkin::lobe
