#pragma once

#include <span>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/lobe/lobe.h"

/// @file
/// Pictures of lobes.
namespace welkin {

/// The vertical axis of draw_lobes: from 0 to 1, or six decades up to 1.
enum class WeightAxis {
  linear,       ///< 0 … 1
  logarithmic,  ///< 10⁻⁶ … 1
};

/// How lobes are drawn.
struct LobePlot {
  int width = 720;                       ///< of the picture, pixels, at least 200
  int degrees = 90;                      ///< at the right edge, 1 … 180
  WeightAxis axis = WeightAxis::linear;  ///< of weights
};

/// Curves of the lobes' weights over their largest, against the angle from the axis, on white, linear sRGB.
/// They are numbered from 1 in the order given, from dark violet to green, in the list at the right. A mirror
/// has no curve.
WELKIN_API Image draw_lobes(std::span<const lobe::AnyLobe> lobes, const LobePlot& plot);

}  // namespace welkin
