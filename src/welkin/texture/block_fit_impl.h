// What the searches for blocks of halves share: a block's texels in packs, the lines that its regions'
// colours lie along, and the endpoints that fit them best.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <xsimd/xsimd.hpp>

#include "welkin/texture/error_scale.h"

/// Included by the searches for each instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::texture {

template <class Arch>
class BlockFit {
 protected:
  using Pack = xsimd::batch<float, Arch>;
  static constexpr int kTexels = 16;
  static constexpr int kLanes = static_cast<int>(Pack::size);
  static constexpr int kPacks = kTexels / kLanes;

  BlockFit() : scale_(ErrorScale::get()) {}

  /// `wide`: what a half lies at on the scale that endpoints have, and how much that moves for a step of it.
  template <class Wide>
  void load(const std::uint16_t* halves, const Wide& wide) {
    for (int i = 0; i < kTexels; ++i) {
      for (int c = 0; c < 3; ++c) {
        const std::uint16_t half = halves[3 * i + c];
        half_[c][i] = half;
        log_[c][i] = scale_.log[half];
        const auto [position, step] = wide(half);
        wide_[c][i] = position;
        weight_[c][i] = scale_.slope[half] * step;
      }
    }
  }

  /// Whether all texels have one colour.
  bool flat() const {
    for (int c = 0; c < 3; ++c) {
      for (int i = 1; i < kTexels; ++i) {
        if (half_[c][i] != half_[c][0]) return false;
      }
    }
    return true;
  }

  void set_regions(unsigned second) {
    for (int i = 0; i < kTexels; ++i) {
      region_[1][i] = static_cast<float>(second >> i & 1);
      region_[0][i] = 1 - region_[1][i];
    }
  }

  // ------------------------------------------------------------------------------------------------
  // partitions

  /// Sums of a region's logarithms, and of their products, for a pack of partitions.
  struct Moments {
    Pack count, sum[3], product[6];
  };

  /// What is left beside the principal axis: the trace but the largest eigenvalue, and of that what indices
  /// of 3 bits leave. The axis by power iteration from the column of the largest diagonal element. `grey`, if
  /// given, becomes the same of the axis along which brightness alone changes.
  static Pack residual(const Moments& m, Pack axis[3], Pack* grey = nullptr) {
    const Pack one(1.0f);
    const Pack each = one / xsimd::max(m.count, one);
    const Pack xx = m.product[0] - m.sum[0] * m.sum[0] * each, xy = m.product[1] - m.sum[0] * m.sum[1] * each,
               xz = m.product[2] - m.sum[0] * m.sum[2] * each, yy = m.product[3] - m.sum[1] * m.sum[1] * each,
               yz = m.product[4] - m.sum[1] * m.sum[2] * each, zz = m.product[5] - m.sum[2] * m.sum[2] * each;
    const auto y_first = (yy > xx) & (yy >= zz);
    const auto z_first = (zz > xx) & (zz > yy);
    Pack a = xsimd::select(z_first, xz, xsimd::select(y_first, xy, xx));
    Pack b = xsimd::select(z_first, yz, xsimd::select(y_first, yy, xy));
    Pack c = xsimd::select(z_first, zz, xsimd::select(y_first, yz, xz));
    for (int step = 0; step < 4; ++step) {
      const Pack na = xx * a + xy * b + xz * c, nb = xy * a + yy * b + yz * c, nc = xz * a + yz * b + zz * c;
      const Pack largest = xsimd::max(xsimd::max(xsimd::abs(na), xsimd::abs(nb)), xsimd::abs(nc));
      const Pack inverse = one / xsimd::max(largest, Pack(1e-30f));
      a = na * inverse;
      b = nb * inverse;
      c = nc * inverse;
    }
    const Pack norm = a * a + b * b + c * c;
    const Pack inverse = one / xsimd::max(norm, Pack(1e-30f));
    const Pack value =
        (a * (xx * a + xy * b + xz * c) + b * (xy * a + yy * b + yz * c) + c * (xz * a + yz * b + zz * c)) *
        inverse;
    axis[0] = a;
    axis[1] = b;
    axis[2] = c;
    const Pack trace = xx + yy + zz, steps(1.0f / 49);
    if (grey != nullptr) {
      const Pack along = (trace + Pack(2.0f) * (xy + xz + yz)) * Pack(1.0f / 3);
      *grey = xsimd::max(trace - along, Pack(0.0f)) + along * steps;
    }
    return xsimd::max(trace - value, Pack(0.0f)) + value * steps;
  }

  Moments whole() const {
    Moments m{Pack(16.0f), {Pack(0.0f), Pack(0.0f), Pack(0.0f)}, {}};
    for (Pack& each : m.product) each = Pack(0.0f);
    for (int i = 0; i < kTexels; ++i) add(m, Pack(1.0f), i);
    return m;
  }
  void add(Moments& m, const Pack& mask, int i) const {
    const float x = centred_[0][i], y = centred_[1][i], z = centred_[2][i];
    m.sum[0] = xsimd::fma(mask, Pack(x), m.sum[0]);
    m.sum[1] = xsimd::fma(mask, Pack(y), m.sum[1]);
    m.sum[2] = xsimd::fma(mask, Pack(z), m.sum[2]);
    m.product[0] = xsimd::fma(mask, Pack(x * x), m.product[0]);
    m.product[1] = xsimd::fma(mask, Pack(x * y), m.product[1]);
    m.product[2] = xsimd::fma(mask, Pack(x * z), m.product[2]);
    m.product[3] = xsimd::fma(mask, Pack(y * y), m.product[3]);
    m.product[4] = xsimd::fma(mask, Pack(y * z), m.product[4]);
    m.product[5] = xsimd::fma(mask, Pack(z * z), m.product[5]);
  }
  void centre() {
    for (int c = 0; c < 3; ++c) {
      float sum = 0;
      for (int i = 0; i < kTexels; ++i) sum += log_[c][i];
      for (int i = 0; i < kTexels; ++i) centred_[c][i] = log_[c][i] - sum / kTexels;
    }
  }

  /// Residuals of all partitions and their regions' axes; with kGrey those along brightness too.
  template <bool kGrey = false>
  void rank(const PartitionMasks& masks) {
    const Moments all = whole();
    for (int from = 0; from < kRankedPartitions; from += kLanes) {
      Moments second{Pack(0.0f), {Pack(0.0f), Pack(0.0f), Pack(0.0f)}, {}}, first;
      for (Pack& each : second.product) each = Pack(0.0f);
      for (int i = 0; i < kTexels; ++i) {
        const Pack mask =
            Pack::load_unaligned(&masks.second[static_cast<std::size_t>(i)][static_cast<std::size_t>(from)]);
        second.count = second.count + mask;
        add(second, mask, i);
      }
      first.count = all.count - second.count;
      for (int k = 0; k < 3; ++k) first.sum[k] = all.sum[k] - second.sum[k];
      for (int k = 0; k < 6; ++k) first.product[k] = all.product[k] - second.product[k];
      Pack axes[2][3], grey[2];
      const Pack sum = residual(first, axes[0], kGrey ? &grey[0] : nullptr) +
                       residual(second, axes[1], kGrey ? &grey[1] : nullptr);
      sum.store_unaligned(residuals_ + from);
      if (kGrey) (grey[0] + grey[1]).store_unaligned(grey_residuals_ + from);
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 3; ++c) axes[r][c].store_unaligned(&axes_[r][c][from]);
      }
    }
  }

  /// The partition of the least residual, which becomes infinite.
  static int take_best(float* residuals) {
    int least = 0;
    for (int p = 1; p < kRankedPartitions; ++p) least = residuals[p] < residuals[least] ? p : least;
    residuals[least] = std::numeric_limits<float>::infinity();
    return least;
  }

  // ------------------------------------------------------------------------------------------------
  // endpoints

  /// Positions of the texels along an axis, of each region from 0 to 1; the anchors', if there are any, in
  /// the lower half.
  void project(unsigned second, const float axes[2][3], const int anchors[2], float* position) const {
    alignas(64) float along[kTexels];
    for (int i = 0; i < kTexels; ++i) {
      const int r = static_cast<int>(second >> i & 1);
      along[i] = axes[r][0] * log_[0][i] + axes[r][1] * log_[1][i] + axes[r][2] * log_[2][i];
    }
    float low[2] = {1e30f, 1e30f}, high[2] = {-1e30f, -1e30f};
    for (int i = 0; i < kTexels; ++i) {
      const int r = static_cast<int>(second >> i & 1);
      low[r] = std::min(low[r], along[i]);
      high[r] = std::max(high[r], along[i]);
    }
    float scale[2], offset[2];
    for (int r = 0; r < 2; ++r) {
      const float width = high[r] - low[r];
      scale[r] = width > 0 ? 1 / width : 0.0f;
      offset[r] = low[r];
      if (anchors != nullptr && (along[anchors[r]] - low[r]) * scale[r] > 0.5f) {
        scale[r] = -scale[r];
        offset[r] = high[r];
      }
    }
    for (int i = 0; i < kTexels; ++i) {
      const int r = static_cast<int>(second >> i & 1);
      position[i] = (along[i] - offset[r]) * scale[r];
    }
  }

  /// A channel's sums over a region's texels, weighted: of squares of their shares of both endpoints, of the
  /// products, and of these shares times what the texels lie at.
  struct Sums {
    float aa, ab, bb, ax, bx;
  };
  Sums sums(int r, int c, const float* share) const {
    Pack aa(0.0f), ab(0.0f), bb(0.0f), ax(0.0f), bx(0.0f);
    for (int k = 0; k < kPacks; ++k) {
      const Pack mask = Pack::load_unaligned(&region_[r][k * kLanes]);
      const Pack b = Pack::load_unaligned(share + k * kLanes), a = Pack(1.0f) - b;
      const Pack w = mask * Pack::load_unaligned(&weight_[c][k * kLanes]);
      const Pack x = Pack::load_unaligned(&wide_[c][k * kLanes]);
      const Pack wa = w * a, wb = w * b;
      aa = xsimd::fma(wa, a, aa);
      ab = xsimd::fma(wa, b, ab);
      bb = xsimd::fma(wb, b, bb);
      ax = xsimd::fma(wa, x, ax);
      bx = xsimd::fma(wb, x, bx);
    }
    return {xsimd::hadd(aa), xsimd::hadd(ab), xsimd::hadd(bb), xsimd::hadd(ax), xsimd::hadd(bx)};
  }

  /// Endpoints of each region by least squares for texels' shares 0 … 1 of the second, not rounded, of at
  /// most 65535.
  void fit(int regions, const float* share, float (*ends)[3]) const {
    for (int r = 0; r < regions; ++r) {
      for (int c = 0; c < 3; ++c) {
        const auto [saa, sab, sbb, sax, sbx] = sums(r, c, share);
        const float determinant = saa * sbb - sab * sab;
        float a, b;
        if (determinant > 1e-5f * (saa + sbb) * (saa + sbb)) {
          a = (sax * sbb - sbx * sab) / determinant;
          b = (sbx * saa - sax * sab) / determinant;
        } else {
          a = b = (sax + sbx) / std::max(saa + 2 * sab + sbb, 1e-30f);
        }
        ends[2 * r][c] = std::clamp(a, 0.0f, 65535.0f);
        ends[2 * r + 1][c] = std::clamp(b, 0.0f, 65535.0f);
      }
    }
  }

  const ErrorScale& scale_;
  std::uint16_t half_[3][kTexels];
  alignas(64) float log_[3][kTexels];
  alignas(64) float centred_[3][kTexels];
  alignas(64) float weight_[3][kTexels];
  alignas(64) float wide_[3][kTexels];
  alignas(64) float region_[2][kTexels];  ///< 1 for its texels
  alignas(64) float axes_[2][3][kRankedPartitions];
  alignas(64) float residuals_[kRankedPartitions];
  alignas(64) float grey_residuals_[kRankedPartitions];
};

}  // namespace welkin::texture
