#pragma once

#include <vector>

/// The discrete Fourier transform of eight rows at once.
namespace welkin::prefilter {

/// Twiddle factors and factors of one length. Never changes; safe from many threads.
struct FftPlan {
  /// `length` has no prime factors but 2, 3 and 5.
  explicit FftPlan(int length);

  int length;
  std::vector<int> radices;  ///< their product is `length`; 4 as often as possible
  std::vector<float>
      twiddles;  ///< stage by stage, for p = 0 … n/R − 1 and k = 1 … R − 1: cos, sin of 2π p k / n
};

/// Whether FftPlan takes this length.
bool fft_takes(int length);

/// The smallest length of at least `minimum` that FftPlan takes and that is a multiple of four.
int fft_length(int minimum);

}  // namespace welkin::prefilter
