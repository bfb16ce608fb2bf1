#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "welkin/texture/bc6h_encoder.h"
#include "welkin/texture/block_fit_impl.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::texture::bc6h {

template <class Arch>
class Encoder : BlockFit<Arch> {
  using Fit = BlockFit<Arch>;
  using Fit::axes_, Fit::fit, Fit::half_, Fit::kLanes, Fit::kPacks, Fit::log_, Fit::project, Fit::region_,
      Fit::residuals_, Fit::scale_, Fit::set_regions;
  using typename Fit::Pack;

 public:
  static void encode(const std::uint16_t* halves, std::size_t blocks, const Search& search,
                     std::byte* bytes) {
    Encoder encoder(search);
    for (std::size_t i = 0; i < blocks; ++i, halves += 3 * kTexels, bytes += 16) {
      // The decoder rounds down.
      encoder.load(halves, [](int half) {
        return std::pair{(static_cast<float>(half) + 0.5f) * (64.0f / 31), 1.0f};
      });
      pack(encoder.best(), bytes);
    }
  }

 private:
  explicit Encoder(const Search& search) : search_(search), masks_(partition_masks()) {}

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

  Block best() {
    Candidate best;
    if (Fit::flat()) return one_colour();
    one_region(best);
    Fit::rank(masks_);
    for (int k = 0; k < search_.partitions; ++k) two_regions(Fit::take_best(residuals_), best);
    polish(best);
    return best.block;
  }

  /// Exactly, by the mode of the highest precision.
  Block one_colour() const {
    Block block;
    block.mode = 13;
    for (int c = 0; c < 3; ++c) block.endpoints[0][c] = block.endpoints[1][c] = (64 * half_[c][0] + 30) / 31;
    return block;
  }

  // ------------------------------------------------------------------------------------------------
  // endpoints

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

  void one_region(Candidate& best) {
    Fit::centre();
    set_regions(0);
    Pack axis[3];
    Fit::residual(Fit::whole(), axis);
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
  const PartitionMasks& masks_;
};

}  // namespace welkin::texture::bc6h
