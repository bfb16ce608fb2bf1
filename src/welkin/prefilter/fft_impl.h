#pragma once

#include <utility>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/lanes.h"

/// Stockham's self-sorting transform by decimation in frequency (P. Swarztrauber, "FFT algorithms for vector
/// computers", 1984, section 5), for eight rows in the lanes.
namespace welkin::prefilter {

template <class Arch>
struct Fft {
  using V = Lanes<float, Arch>;

  struct Complex {
    V re, im;
    static Complex load(const float* from) { return {V::load(from), V::load(from + 8)}; }
    void store(float* to) const {
      re.store(to);
      im.store(to + 8);
    }
    friend Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
    friend Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
    friend Complex operator*(float s, const Complex& a) { return {V(s) * a.re, V(s) * a.im}; }
  };

  /// a times the unit complex number (cosine, sine), or its conjugate.
  template <bool kConjugate>
  static Complex times_twiddle(const Complex& a, const float* twiddle) {
    const V cosine(twiddle[0]), sine(kConjugate ? -twiddle[1] : twiddle[1]);
    return {V::fms(a.re, cosine, a.im * sine), V::fma(a.re, sine, a.im * cosine)};
  }

  /// a·(−i) when forward, a·i when inverse.
  template <bool kForward>
  static Complex quarter(const Complex& a) {
    const V zero(0.0f);
    if constexpr (kForward) return {a.im, zero - a.re};
    return {zero - a.im, a.re};
  }

  template <int kRadix, bool kForward>
  static void butterfly(const Complex* a, Complex* b) {
    if constexpr (kRadix == 2) {
      b[0] = a[0] + a[1];
      b[1] = a[0] - a[1];
    } else if constexpr (kRadix == 3) {
      const Complex sum = a[1] + a[2];
      const Complex side = quarter<kForward>(0.866025403784439f * (a[1] - a[2]));
      const Complex middle = a[0] + -0.5f * sum;
      b[0] = a[0] + sum;
      b[1] = middle + side;
      b[2] = middle - side;
    } else if constexpr (kRadix == 4) {
      const Complex s02 = a[0] + a[2], d02 = a[0] - a[2];
      const Complex s13 = a[1] + a[3], d13 = quarter<kForward>(a[1] - a[3]);
      b[0] = s02 + s13;
      b[1] = d02 + d13;
      b[2] = s02 - s13;
      b[3] = d02 - d13;
    } else {
      static_assert(kRadix == 5);
      constexpr float kC1 = 0.309016994374947f, kC2 = -0.809016994374947f;
      constexpr float kS1 = 0.951056516295154f, kS2 = 0.587785252292473f;
      const Complex s14 = a[1] + a[4], d14 = quarter<kForward>(a[1] - a[4]);
      const Complex s23 = a[2] + a[3], d23 = quarter<kForward>(a[2] - a[3]);
      const Complex m1 = a[0] + kC1 * s14 + kC2 * s23, m2 = a[0] + kC2 * s14 + kC1 * s23;
      const Complex i1 = kS1 * d14 + kS2 * d23, i2 = kS2 * d14 - kS1 * d23;
      b[0] = a[0] + s14 + s23;
      b[1] = m1 + i1;
      b[2] = m2 + i2;
      b[3] = m2 - i2;
      b[4] = m1 - i1;
    }
  }

  /// One stage: n is the length still to be transformed, stride·n the whole.
  template <int kRadix, bool kForward>
  static void stage(const float* twiddle, const float* from, float* to, int n, int stride) {
    const int part = n / kRadix;
    const std::ptrdiff_t apart = static_cast<std::ptrdiff_t>(stride) * part * 16;
    for (int p = 0; p < part; ++p, twiddle += 2 * (kRadix - 1)) {
      const float* in = from + static_cast<std::ptrdiff_t>(stride) * p * 16;
      float* out = to + static_cast<std::ptrdiff_t>(stride) * p * kRadix * 16;
      for (int q = 0; q < stride; ++q, in += 16, out += 16) {
        Complex a[kRadix], b[kRadix];
        for (int k = 0; k < kRadix; ++k) a[k] = Complex::load(in + k * apart);
        butterfly<kRadix, kForward>(a, b);
        b[0].store(out);
        for (int k = 1; k < kRadix; ++k) {
          times_twiddle<kForward>(b[k], twiddle + 2 * (k - 1))
              .store(out + static_cast<std::ptrdiff_t>(k) * stride * 16);
        }
      }
    }
  }

  template <bool kForward>
  static float* transform(const FftPlan& plan, float* data, float* work) {
    int n = plan.length, stride = 1;
    const float* twiddle = plan.twiddles.data();
    for (int radix : plan.radices) {
      if (radix == 2) stage<2, kForward>(twiddle, data, work, n, stride);
      if (radix == 3) stage<3, kForward>(twiddle, data, work, n, stride);
      if (radix == 4) stage<4, kForward>(twiddle, data, work, n, stride);
      if (radix == 5) stage<5, kForward>(twiddle, data, work, n, stride);
      twiddle += 2 * static_cast<std::ptrdiff_t>(radix - 1) * (n / radix);
      n /= radix;
      stride *= radix;
      std::swap(data, work);
    }
    return data;
  }

  static float* forward(const FftPlan& plan, float* data, float* work) {
    return transform<true>(plan, data, work);
  }
  static float* inverse(const FftPlan& plan, float* data, float* work) {
    return transform<false>(plan, data, work);
  }
};

}  // namespace welkin::prefilter
