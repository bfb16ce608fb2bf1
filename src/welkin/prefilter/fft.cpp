#include "welkin/prefilter/fft.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace welkin::prefilter {

bool fft_takes(int length) {
  if (length < 1) return false;
  for (int factor : {2, 3, 5}) {
    while (length % factor == 0) length /= factor;
  }
  return length == 1;
}

int fft_length(int minimum) {
  int length = (minimum + 3) / 4 * 4;
  while (!fft_takes(length)) length += 4;
  return length;
}

FftPlan::FftPlan(int full_length) : length(full_length) {
  assert(fft_takes(length));
  int rest = length;
  for (int radix : {4, 2, 3, 5}) {
    while (rest % radix == 0) {
      radices.push_back(radix);
      rest /= radix;
    }
  }
  int n = length;
  for (int radix : radices) {
    for (int p = 0; p < n / radix; ++p) {
      for (int k = 1; k < radix; ++k) {
        const double angle = 2 * std::numbers::pi * (static_cast<double>(p) * k / n);
        twiddles.push_back(static_cast<float>(std::cos(angle)));
        twiddles.push_back(static_cast<float>(std::sin(angle)));
      }
    }
    n /= radix;
  }
}

}  // namespace welkin::prefilter
