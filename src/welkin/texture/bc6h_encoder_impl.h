// The search for a block's encoding. It is over 400 lines because its steps share the block's texels in
// packs, and are inlined into one loop for each instruction set.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <xsimd/xsimd.hpp>

#include "welkin/texture/bc6h_encoder.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::texture::bc6h {

template <class Arch>
class Encoder {
  using Pack = xsimd::batch<float, Arch>;
  static constexpr int kLanes = static_cast<int>(Pack::size);
  static constexpr int kPacks = kTexels / kLanes;

 public:
  static void encode(const std::uint16_t* halves, std::size_t blocks, const Search& search,
                     std::byte* bytes) {
    Encoder encoder(search);
    for (std::size_t i = 0; i < blocks; ++i, halves += 3 * kTexels, bytes += 16) {
      encoder.load(halves);
      pack(encoder.best(), bytes);
    }
  }

 private:
  explicit Encoder(const Search& search)
      : search_(search), scale_(ErrorScale::get()), masks_(PartitionMasks::get()) {}

  /// A block and its error.
  struct Candidate {
    Block block;
    float error = std::numeric_limits<float>::infinity();
  };

  /// A region's texels by index: how many, and the sums of their logarithms.
  struct Bins {
    float count[16];
    float sums[3][16];
    float squares[3];
  };

  void load(const std::uint16_t* halves) {
    for (int i = 0; i < kTexels; ++i) {
      for (int c = 0; c < 3; ++c) {
        const std::uint16_t half = halves[3 * i + c];
        half_[c][i] = half;
        log_[c][i] = scale_.log[half];
        weight_[c][i] = scale_.slope[half];
        // The decoder rounds down.
        wide_[c][i] = (static_cast<float>(half) + 0.5f) * (64.0f / 31);
      }
    }
  }

  Block best() {
    Candidate best;
    if (flat(best.block)) return best.block;
    one_region(best);
    rank();
    for (int k = 0; k < search_.partitions; ++k) two_regions(ranked_[k], best);
    polish(best);
    return best.block;
  }

  /// One colour, exactly.
  bool flat(Block& block) const {
    for (int c = 0; c < 3; ++c) {
      for (int i = 1; i < kTexels; ++i) {
        if (half_[c][i] != half_[c][0]) return false;
      }
    }
    block = {};
    block.mode = 13;
    for (int c = 0; c < 3; ++c) block.endpoints[0][c] = block.endpoints[1][c] = (64 * half_[c][0] + 30) / 31;
    return true;
  }

  // ------------------------------------------------------------------------------------------------
  // partitions

  /// Sums of a region's logarithms, and of their products, for a pack of partitions.
  struct Moments {
    Pack count, sum[3], product[6];
  };

  /// What is left beside the principal axis: the trace but the largest eigenvalue, and of that what indices
  /// of 3 bits leave. The axis by power iteration from the column of the largest diagonal element.
  static Pack residual(const Moments& m, Pack axis[3]) {
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
    return xsimd::max(xx + yy + zz - value, Pack(0.0f)) + value * Pack(1.0f / 49);
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

  /// The partitions with the least residuals, and their regions' axes.
  void rank() {
    const Moments all = whole();
    alignas(64) float residuals[kPartitions];
    for (int from = 0; from < kPartitions; from += kLanes) {
      Moments second{Pack(0.0f), {Pack(0.0f), Pack(0.0f), Pack(0.0f)}, {}}, first;
      for (Pack& each : second.product) each = Pack(0.0f);
      for (int i = 0; i < kTexels; ++i) {
        const Pack mask =
            Pack::load_unaligned(&masks_.second[static_cast<std::size_t>(i)][static_cast<std::size_t>(from)]);
        second.count = second.count + mask;
        add(second, mask, i);
      }
      first.count = all.count - second.count;
      for (int k = 0; k < 3; ++k) first.sum[k] = all.sum[k] - second.sum[k];
      for (int k = 0; k < 6; ++k) first.product[k] = all.product[k] - second.product[k];
      Pack axes[2][3];
      const Pack sum = residual(first, axes[0]) + residual(second, axes[1]);
      sum.store_unaligned(residuals + from);
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 3; ++c) axes[r][c].store_unaligned(&axes_[r][c][from]);
      }
    }
    for (int k = 0; k < search_.partitions; ++k) {
      int least = 0;
      for (int p = 1; p < kPartitions; ++p) least = residuals[p] < residuals[least] ? p : least;
      ranked_[k] = least;
      residuals[least] = std::numeric_limits<float>::infinity();
    }
  }

  // ------------------------------------------------------------------------------------------------
  // endpoints

  /// Positions of the texels along an axis, of each region from 0 to 1; the anchor's in the lower half.
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
      if ((along[anchors[r]] - low[r]) * scale[r] > 0.5f) {
        scale[r] = -scale[r];
        offset[r] = high[r];
      }
    }
    for (int i = 0; i < kTexels; ++i) {
      const int r = static_cast<int>(second >> i & 1);
      position[i] = (along[i] - offset[r]) * scale[r];
    }
  }

  /// Endpoints of each region by least squares for texels' weights 0 … 1, of 16 bits, not rounded.
  void fit(int regions, const float* share, float (*ends)[3]) const {
    for (int r = 0; r < regions; ++r) {
      for (int c = 0; c < 3; ++c) {
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
        const float saa = xsimd::hadd(aa), sab = xsimd::hadd(ab), sbb = xsimd::hadd(bb),
                    sax = xsimd::hadd(ax), sbx = xsimd::hadd(bx);
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

  /// The endpoint of a precision that lies nearest.
  static int quantized(float wide, int precision) {
    const int last = (1 << precision) - 1;
    if (precision == 16) return std::clamp(static_cast<int>(wide + 0.5f), 0, last);
    const float step = static_cast<float>(1 << (16 - precision));
    // Values are at (q + ½) steps, but for the first, at 0, and the last, at 65535.
    const float q = wide / step;
    if (q < 0.75f) return 0;
    if (q > static_cast<float>(last) + 0.25f) return last;
    return std::clamp(static_cast<int>(q), 1, last - 1);
  }

  /// Rounds to what the mode stores; whether nothing had to be moved for a difference to fit.
  static bool quantize(const float (*ends)[3], Block& block) {
    const Mode& mode = kModeTable[static_cast<std::size_t>(block.mode)];
    bool fitted = true;
    for (int c = 0; c < 3; ++c) {
      const int base = block.endpoints[0][c] = quantized(ends[0][c], mode.precision);
      for (int e = 1; e < 2 * mode.regions; ++e) {
        int q = quantized(ends[e][c], mode.precision);
        if (mode.differences) {
          const int half = 1 << (mode.other_bits[c] - 1);
          const int kept = std::clamp(q, base - half, base + half - 1);
          fitted = fitted && kept == q;
          q = kept;
        }
        block.endpoints[e][c] = q;
      }
    }
    return fitted;
  }

  // ------------------------------------------------------------------------------------------------ indices

  /// Logarithms of what a channel's endpoints are interpolated to.
  template <int kCount>
  void palette(int a, int b, int precision, float* logs) const {
    constexpr const int* kWeights = kCount == 8 ? kWeights3 : kWeights4;
    const int wide_a = unquantized(a, precision), wide_b = unquantized(b, precision);
    for (int k = 0; k < kCount; ++k)
      logs[k] = scale_.log[static_cast<std::size_t>(interpolated(wide_a, wide_b, kWeights[k]))];
  }

  /// Chooses the indices; sets the error.
  template <int kRegions>
  void choose_indices(Candidate& candidate) const {
    constexpr int kCount = kRegions == 1 ? 16 : 8;
    Block& block = candidate.block;
    const int precision = kModeTable[static_cast<std::size_t>(block.mode)].precision;
    alignas(64) float logs[kRegions][3][kCount];
    for (int r = 0; r < kRegions; ++r) {
      for (int c = 0; c < 3; ++c)
        palette<kCount>(block.endpoints[2 * r][c], block.endpoints[2 * r + 1][c], precision, logs[r][c]);
    }
    alignas(64) float errors[kTexels], indices[kTexels];
    const auto entry = [&](const auto& in_second, int c, int k) {
      if constexpr (kRegions == 1) {
        return Pack(logs[0][c][k]);
      } else {
        return xsimd::select(in_second, Pack(logs[1][c][k]), Pack(logs[0][c][k]));
      }
    };
    for (int p = 0; p < kPacks; ++p) {
      const auto in_second = Pack::load_unaligned(&region_[1][p * kLanes]) > Pack(0.5f);
      const Pack x = Pack::load_unaligned(&log_[0][p * kLanes]),
                 y = Pack::load_unaligned(&log_[1][p * kLanes]),
                 z = Pack::load_unaligned(&log_[2][p * kLanes]);
      Pack least(std::numeric_limits<float>::max()), which(0.0f);
      for (int k = 0; k < kCount; ++k) {
        const Pack dx = entry(in_second, 0, k) - x, dy = entry(in_second, 1, k) - y,
                   dz = entry(in_second, 2, k) - z;
        const Pack error = xsimd::fma(dx, dx, xsimd::fma(dy, dy, dz * dz));
        const auto less = error < least;
        least = xsimd::select(less, error, least);
        which = xsimd::select(less, Pack(static_cast<float>(k)), which);
      }
      least.store_unaligned(errors + p * kLanes);
      which.store_unaligned(indices + p * kLanes);
    }
    for (int i = 0; i < kTexels; ++i) block.indices[i] = static_cast<std::uint8_t>(indices[i]);
    for (int r = 0; r < kRegions; ++r) {
      const int anchor = r == 0 ? 0 : kPartitionTable[static_cast<std::size_t>(block.partition)].anchor;
      if (block.indices[anchor] < kCount / 2) continue;
      float least = std::numeric_limits<float>::infinity();
      for (int k = 0; k < kCount / 2; ++k) {
        float error = 0;
        for (int c = 0; c < 3; ++c)
          error += (logs[r][c][k] - log_[c][anchor]) * (logs[r][c][k] - log_[c][anchor]);
        if (error < least) {
          least = error;
          block.indices[anchor] = static_cast<std::uint8_t>(k);
        }
      }
      errors[anchor] = least;
    }
    float sum = 0;
    for (int i = 0; i < kTexels; ++i) sum += errors[i];
    candidate.error = sum;
  }

  /// The indices of the texels as weights 0 … 1.
  template <int kRegions>
  static void shares(const Block& block, float* share) {
    for (int i = 0; i < kTexels; ++i)
      share[i] = static_cast<float>((kRegions == 1 ? kWeights4 : kWeights3)[block.indices[i]]) * (1.0f / 64);
  }

  // ------------------------------------------------------------------------------------------------ one
  // candidate

  template <int kRegions>
  void sort_into_bins(const Block& block, Bins* bins) const {
    const unsigned second =
        kRegions == 1 ? 0u : kPartitionTable[static_cast<std::size_t>(block.partition)].second;
    for (int r = 0; r < kRegions; ++r) bins[r] = {};
    for (int i = 0; i < kTexels; ++i) {
      Bins& bin = bins[kRegions == 1 ? 0 : second >> i & 1];
      const std::size_t k = block.indices[i];
      bin.count[k] += 1;
      for (int c = 0; c < 3; ++c) {
        bin.sums[c][k] += log_[c][i];
        bin.squares[c] += log_[c][i] * log_[c][i];
      }
    }
  }

  /// The error of a channel of a region as it is indexed.
  template <int kRegions>
  float binned_error(const Bins& bins, int c, int a, int b, int precision) const {
    constexpr int kCount = kRegions == 1 ? 16 : 8;
    alignas(64) float logs[kCount];
    palette<kCount>(a, b, precision, logs);
    float error = bins.squares[c];
    for (int k = 0; k < kCount; ++k) error += logs[k] * (bins.count[k] * logs[k] - 2 * bins.sums[c][k]);
    return error;
  }

  /// Moves endpoints by single steps while that lessens the error, as texels are indexed.
  template <int kRegions>
  void descend(Block& block) const {
    const Mode& mode = kModeTable[static_cast<std::size_t>(block.mode)];
    const int last = (1 << mode.precision) - 1;
    Bins bins[kRegions];
    sort_into_bins<kRegions>(block, bins);
    for (int r = 0; r < kRegions; ++r) {
      for (int c = 0; c < 3; ++c) {
        int& a = block.endpoints[2 * r][c];
        int& b = block.endpoints[2 * r + 1][c];
        float least = binned_error<kRegions>(bins[r], c, a, b, mode.precision);
        for (int round = 0; round < 6; ++round) {
          constexpr int kMoves[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
          int best = -1;
          for (int m = 0; m < 8; ++m) {
            const int old_a = a, old_b = b;
            const int new_a = a + kMoves[m][0], new_b = b + kMoves[m][1];
            if (new_a < 0 || new_a > last || new_b < 0 || new_b > last) continue;
            a = new_a;
            b = new_b;
            const bool possible = fits(block, c);
            const float error = possible ? binned_error<kRegions>(bins[r], c, a, b, mode.precision)
                                         : std::numeric_limits<float>::max();
            a = old_a;
            b = old_b;
            if (error < least) {
              least = error;
              best = m;
            }
          }
          if (best < 0) break;
          a += kMoves[best][0];
          b += kMoves[best][1];
        }
      }
    }
  }

  /// From endpoints to the best that this mode makes of them.
  template <int kRegions>
  void refine(const float (*ends)[3], int mode, int partition, Candidate& best) const {
    Candidate candidate;
    candidate.block.mode = mode;
    candidate.block.partition = partition;
    quantize(ends, candidate.block);
    choose_indices<kRegions>(candidate);
    for (int round = 0; round < search_.refits; ++round) {
      Candidate next = candidate;
      alignas(64) float share[kTexels];
      shares<kRegions>(next.block, share);
      float fitted[4][3];
      fit(kRegions, share, fitted);
      quantize(fitted, next.block);
      if (search_.descend) descend<kRegions>(next.block);
      choose_indices<kRegions>(next);
      if (!(next.error < candidate.error)) break;
      candidate = next;
    }
    if (candidate.error < best.error) best = candidate;
  }

  void set_regions(unsigned second) {
    for (int i = 0; i < kTexels; ++i) {
      region_[1][i] = static_cast<float>(second >> i & 1);
      region_[0][i] = 1 - region_[1][i];
    }
  }

  void one_region(Candidate& best) {
    centre();
    set_regions(0);
    Pack axis[3];
    residual(whole(), axis);
    float axes[2][3];
    for (int c = 0; c < 3; ++c) axes[0][c] = axes[1][c] = axis[c].get(0);
    const int anchors[2] = {0, 0};
    alignas(64) float share[kTexels];
    project(0, axes, anchors, share);
    float ends[4][3];
    fit(1, share, ends);
    // The most precise whose differences suffice, and the one above it.
    Block block;
    int mode = 13;
    for (; mode > 10; --mode) {
      block.mode = mode;
      if (quantize(ends, block)) break;
    }
    refine<1>(ends, mode, 0, best);
    if (search_.modes > 1 && mode < 13) refine<1>(ends, mode + 1, 0, best);
  }

  void two_regions(int partition, Candidate& best) {
    const auto& [second, anchor] = kPartitionTable[static_cast<std::size_t>(partition)];
    set_regions(second);
    float axes[2][3];
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 3; ++c) axes[r][c] = axes_[r][c][partition];
    }
    const int anchors[2] = {0, anchor};
    alignas(64) float share[kTexels];
    project(second, axes, anchors, share);
    for (float& each : share) each = std::floor(each * 7 + 0.5f) * (1.0f / 7);
    float ends[4][3];
    fit(2, share, ends);
    // From the most precise mode down. One whose differences are too small for the endpoints may still be
    // best: they are compared as texels would be indexed.
    Candidate sorted[10];
    int count = 0;
    Block guess;
    for (int i = 0; i < kTexels; ++i) guess.indices[i] = static_cast<std::uint8_t>(share[i] * 7 + 0.5f);
    guess.partition = partition;
    Bins bins[2];
    sort_into_bins<2>(guess, bins);
    for (const int mode : {2, 3, 4, 0, 5, 6, 7, 8, 1, 9}) {
      Candidate& candidate = sorted[count];
      candidate.block.mode = mode;
      const bool fitted = quantize(ends, candidate.block);
      if (!fitted && search_.modes < 2) continue;
      candidate.error = 0;
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 3; ++c) {
          candidate.error += binned_error<2>(bins[r], c, candidate.block.endpoints[2 * r][c],
                                             candidate.block.endpoints[2 * r + 1][c],
                                             kModeTable[static_cast<std::size_t>(mode)].precision);
        }
      }
      ++count;
      if (fitted) break;
    }
    for (int k = 0; k < std::min(search_.modes, count); ++k) {
      const auto least = std::min_element(
          sorted, sorted + count, [](const Candidate& a, const Candidate& b) { return a.error < b.error; });
      refine<2>(ends, least->block.mode, partition, best);
      least->error = std::numeric_limits<float>::infinity();
    }
  }

  /// Moves endpoints of the best, if that hasn't been done, and with its indices chosen again.
  void polish(Candidate& best) {
    const bool one = kModeTable[static_cast<std::size_t>(best.block.mode)].regions == 1;
    set_regions(one ? 0u : kPartitionTable[static_cast<std::size_t>(best.block.partition)].second);
    one ? polish_in<1>(best) : polish_in<2>(best);
  }
  template <int kRegions>
  void polish_in(Candidate& best) const {
    if (!search_.descend) {
      Candidate next = best;
      descend<kRegions>(next.block);
      choose_indices<kRegions>(next);
      if (next.error < best.error) best = next;
    }
    if (search_.perturb) perturb<kRegions>(best);
  }
  template <int kRegions>
  void perturb(Candidate& best) const {
    const Mode& mode = kModeTable[static_cast<std::size_t>(best.block.mode)];
    const int last = (1 << mode.precision) - 1;
    for (int round = 0; round < 3; ++round) {
      const float before = best.error;
      for (int e = 0; e < 2 * kRegions; ++e) {
        for (int c = 0; c < 3; ++c) {
          for (const int step : {1, -1}) {
            Candidate next = best;
            int& value = next.block.endpoints[e][c];
            value += step;
            if (value < 0 || value > last || !fits(next.block, c)) continue;
            choose_indices<kRegions>(next);
            if (next.error < best.error) {
              best = next;
              break;
            }
          }
        }
      }
      if (!(best.error < before)) break;
    }
  }

  const Search search_;
  const ErrorScale& scale_;
  const PartitionMasks& masks_;
  std::uint16_t half_[3][kTexels];
  alignas(64) float log_[3][kTexels];
  alignas(64) float centred_[3][kTexels];
  alignas(64) float weight_[3][kTexels];
  alignas(64) float wide_[3][kTexels];
  alignas(64) float region_[2][kTexels];  ///< 1 for its texels
  alignas(64) float axes_[2][3][kPartitions];
  int ranked_[kPartitions];
};

}  // namespace welkin::texture::bc6h
