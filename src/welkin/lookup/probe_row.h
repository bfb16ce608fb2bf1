#pragma once

#include <array>

namespace welkin {

inline constexpr int kMostProbes = 64;

/// A row of Gaussian probes along a cone's wide axis: their angles from its middle, and shares, whose sum is
/// 1. Their variance, with that of each, is the cone's.
struct ProbeRow {
  int count = 0;
  float sigma = 0;  ///< of each, radians
  std::array<float, kMostProbes> angle, share;
};

/// For a cone's σ, at most `most` ≤ kMostProbes of them.
ProbeRow probe_row(float wide, float narrow, int most);

}  // namespace welkin
