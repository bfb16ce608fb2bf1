#include "welkin/filter/reconstruction.h"

#include "welkin/base/cpu.h"

namespace welkin {
namespace {

/// Gauss–Legendre's rules on 0…1.
constexpr float kGauss2[2] = {0.21132487f, 0.78867513f}, kHalves[2] = {0.5f, 0.5f};
constexpr float kGauss3[3] = {0.11270167f, 0.5f, 0.88729833f},
                kWeights3[3] = {5 / 18.0f, 8 / 18.0f, 5 / 18.0f};
constexpr float kGauss4[4] = {0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f},
                kWeights4[4] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};

/// Gauss's two points in each of equal parts: nearly evenly spaced, so that jumps are found, and exact for
/// quadratics all the same.
template <int kParts>
struct Pairs {
  float offset[2 * kParts], weight[2 * kParts];
  constexpr Pairs() : offset(), weight() {
    for (int i = 0; i < 2 * kParts; ++i) {
      offset[i] = (static_cast<float>(i / 2) + kGauss2[i % 2]) / kParts;
      weight[i] = 0.5f / kParts;
    }
  }
};
constexpr Pairs<3> kSix;
constexpr Pairs<4> kEight;

}  // namespace

int rule_for(float texels) {
  constexpr float kLongest[kQuadratureRules] = {1.4f, 2, 2.5f, 3.2f, 5};
  for (int i = 0; i < kQuadratureRules; ++i) {
    if (texels < kLongest[i]) return i;
  }
  return -1;
}

QuadraturePoints quadrature_rule(int number) {
  const QuadraturePoints rules[kQuadratureRules] = {{2, kGauss2, kHalves},
                                                    {3, kGauss3, kWeights3},
                                                    {4, kGauss4, kWeights4},
                                                    {6, kSix.offset, kSix.weight},
                                                    {8, kEight.offset, kEight.weight}};
  return rules[number];
}

void ReconstructedTexels::reset(int new_chart, int new_x, int new_y, int new_width, int new_height,
                                int new_channels) {
  chart = new_chart;
  x = new_x;
  y = new_y;
  width = new_width;
  height = new_height;
  channels = new_channels;
  // Kernels work in packs of up to 16 values.
  constexpr std::size_t kPack = 16;
  const std::size_t row = static_cast<std::size_t>(width * channels) + kPack;
  const std::size_t rows = static_cast<std::size_t>(height + 2 * kReconstructionReach + 2);
  coefficients.resize(static_cast<std::size_t>(kCoefficients * plane()) + kPack);
  hard.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  scratch.resize(row * rows);
}

void ReconstructedTexels::count_hard() {
  const std::size_t columns = static_cast<std::size_t>(width) + 1;
  counts.assign(columns * (static_cast<std::size_t>(height) + 1), 0);
  const std::uint8_t* texel = hard.data();
  for (std::size_t row = 1; row <= static_cast<std::size_t>(height); ++row) {
    std::int32_t sum = 0;
    for (std::size_t column = 1; column < columns; ++column, ++texel) {
      sum += *texel == kIsLight ? kLights : *texel;
      counts[row * columns + column] = counts[(row - 1) * columns + column] + sum;
    }
  }
}

ReconstructionKernels reconstruction_kernels(int channels) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return reconstruction_kernels_avx2(channels);
#endif
  return reconstruction_kernels_baseline(channels);
}

}  // namespace welkin
