#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "welkin/texture/astc_endpoints.h"
#include "welkin/texture/block_fit_impl.h"
#include "welkin/texture/uastc_encoder.h"
#include "welkin/texture/uastc_to_bc6h.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::texture::uastc {

template <class Arch>
class Encoder : BlockFit<Arch> {
  using Fit = BlockFit<Arch>;
  using Fit::axes_, Fit::grey_residuals_, Fit::half_, Fit::kLanes, Fit::kPacks, Fit::kTexels, Fit::log_,
      Fit::region_, Fit::residuals_, Fit::scale_, Fit::set_regions;
  using typename Fit::Pack;
  using typename Fit::Sums;

 public:
  static void encode(const std::uint16_t* halves, std::size_t blocks, const Search& search,
                     std::byte* bytes) {
    Encoder encoder(search);
    for (std::size_t i = 0; i < blocks; ++i, halves += 3 * kTexels, bytes += astc::kBlockBytes) {
      encoder.load(halves, &logarithm_of);
      astc::pack(encoder.best(), bytes);
    }
  }

 private:
  explicit Encoder(const Search& search) : search_(search), tables_(Tables::get()) {}

  /// What a block may be, and its error.
  struct Candidate {
    int shape = 0, partition = 0;
    StoredEnds ends[2];
    std::uint8_t indices[kTexels] = {};
    float error = std::numeric_limits<float>::infinity();
  };

  /// The inverse of astc::half_of_logarithm, which rounds down, and the square of its slope.
  static std::pair<float, float> logarithm_of(int half) {
    const float mantissa = 8 * (static_cast<float>(half & 1023) + 0.5f);
    const auto exponent = static_cast<float>(half >> 10 << 11);
    if (mantissa < 1536) return {exponent + mantissa * (1.0f / 3), 9.0f / 64};
    if (mantissa < 5632) return {exponent + (mantissa + 512) * 0.25f, 16.0f / 64};
    return {exponent + (mantissa + 2048) * 0.2f, 25.0f / 64};
  }

  astc::Block best() {
    if (Fit::flat()) return one_colour();
    count_ = 0;
    one_region();
    Fit::template rank<true>(tables_.masks);
    for (int p = kPartitions; p < kRankedPartitions; ++p)
      grey_residuals_[p] = residuals_[p] = std::numeric_limits<float>::infinity();
    for (int k = 0; k < search_.partitions; ++k) {
      two_regions(Fit::take_best(grey_residuals_), true);
      two_regions(Fit::take_best(residuals_), false);
    }
    Candidate best;
    for (int k = 0; k < std::min(search_.refined, count_); ++k) {
      Candidate& least =
          *std::min_element(candidates_, candidates_ + count_,
                            [](const Candidate& a, const Candidate& b) { return a.error < b.error; });
      refine(least, best);
      least.error = std::numeric_limits<float>::infinity();
    }
    set_regions_of(best);
    for (int round = 0; round < search_.rounds; ++round) {
      if (!move(best)) break;
    }
    return packed(best);
  }

  void set_regions_of(const Candidate& candidate) {
    const bool one = kShapeTable[static_cast<std::size_t>(candidate.shape)].partitions == 1;
    set_regions(one ? 0u : tables_.partitions[static_cast<std::size_t>(candidate.partition)].second);
  }

  astc::Block one_colour() const {
    astc::Block block;
    block.one_colour = true;
    for (int c = 0; c < 3; ++c) block.colour[c] = half_[c][0];
    block.colour[3] = 0x3c00;
    return block;
  }

  astc::Block packed(const Candidate& candidate) const {
    const Shape& shape = kShapeTable[static_cast<std::size_t>(candidate.shape)];
    astc::Block block;
    block.weight_range = shape.weight_range;
    block.endpoint_range = shape.endpoint_range;
    block.partitions = shape.partitions;
    if (shape.partitions == 2)
      block.seed = tables_.partitions[static_cast<std::size_t>(candidate.partition)].seed;
    const StoredValues& range = StoredValues::of(shape.endpoint_range);
    std::uint8_t* to = block.endpoints;
    for (int r = 0; r < shape.partitions; ++r) {
      block.modes[r] = shape.mode;
      for (int i = 0; i < shape.values(); ++i) *to++ = range.code[candidate.ends[r].values[i]];
    }
    const Weights& weights = weights_of(candidate.shape);
    for (int i = 0; i < kTexels; ++i) block.weights[i] = weights.code[candidate.indices[i]];
    return block;
  }

  const Weights& weights_of(int shape) const {
    return tables_
        .weights[static_cast<std::size_t>(kShapeTable[static_cast<std::size_t>(shape)].weight_range)];
  }

  // ------------------------------------------------------------------------------------------------
  // endpoints

  /// How much the error grows when a channel's endpoints are `a` and `b` away from the best ones.
  static float growth(const Sums& sums, float a, float b) {
    return sums.aa * a * a + 2 * sums.ab * a * b + sums.bb * b * b;
  }

  /// The layout whose rounded endpoints raise the error least; `store(layout)` rounds. False when none can
  /// be.
  template <class Store>
  static bool least_layout(const Layouts& layouts, const float (*ends)[3], const Sums* sums,
                           const Store& store, StoredEnds& best) {
    float least = std::numeric_limits<float>::infinity();
    for (int k = 0; k < layouts.count; ++k) {
      const StoredEnds stored = store(layouts.layout[k]);
      if (!stored.legal()) continue;
      float error = 0;
      for (int c = 0; c < 3; ++c) {
        error += growth(sums[c], 16 * (static_cast<float>(stored.ends[0][c]) - ends[0][c]),
                        16 * (static_cast<float>(stored.ends[1][c]) - ends[1][c]));
      }
      if (error < least) {
        least = error;
        best = stored;
      }
    }
    return least < std::numeric_limits<float>::infinity();
  }

  static float within_limit(float end) { return std::clamp(end, 0.0f, static_cast<float>(kLargestEnd)); }

  /// `fits()`, again with lower ends as long as what they are rounded to is above the limit.
  template <class Fits>
  static bool below_limit(float (*ends)[3], const Fits& fits) {
    for (const int limit : {kLargestEnd, kLargestEnd - 32, kLargestEnd - 128}) {
      for (int e = 0; e < 2; ++e) {
        for (int c = 0; c < 3; ++c) ends[e][c] = std::min(ends[e][c], static_cast<float>(limit));
      }
      if (fits()) return true;
    }
    return false;
  }

  bool fit_direct(int r, const float* share, const StoredValues& range, StoredEnds& best) const {
    Sums sums[3];
    float ends[2][3];
    for (int c = 0; c < 3; ++c) {
      const auto [aa, ab, bb, ax, bx] = sums[c] = Fit::sums(r, c, share);
      const float determinant = aa * bb - ab * ab;
      if (determinant > 1e-5f * (aa + bb) * (aa + bb)) {
        ends[0][c] = (ax * bb - bx * ab) / determinant;
        ends[1][c] = (bx * aa - ax * ab) / determinant;
      } else {
        ends[0][c] = ends[1][c] = (ax + bx) / std::max(aa + 2 * ab + bb, 1e-30f);
      }
      for (auto& end : ends) end[c] = within_limit(end[c] * (1.0f / 16));
    }
    const auto largest = [&](int e) { return std::max({ends[e][0], ends[e][1], ends[e][2]}); };
    if (largest(0) > largest(1)) {
      std::swap(ends[0], ends[1]);
      for (Sums& each : sums) std::swap(each.aa, each.bb);
    }
    return below_limit(ends, [&] {
      return least_layout(
          direct_layouts(ends, search_.finer), ends, sums,
          [&](int layout) { return store_direct(ends, layout, range); }, best);
    });
  }

  bool fit_scale(int r, const float* share, const StoredValues& range, StoredEnds& best) const {
    // Texels lie at end − scale·u, u being their share of the first endpoint.
    Sums sums[3];
    float mean[3], mean_u[3], covariance = 0, variance = 0;
    for (int c = 0; c < 3; ++c) {
      const auto [aa, ab, bb, ax, bx] = sums[c] = Fit::sums(r, c, share);
      const float weight = std::max(aa + 2 * ab + bb, 1e-30f);
      mean[c] = (ax + bx) / weight;
      mean_u[c] = (aa + ab) / weight;
      covariance += ax - mean_u[c] * (ax + bx);
      variance += aa - mean_u[c] * (aa + ab);
    }
    const float scale = variance > 0 ? std::max(-covariance / variance, 0.0f) : 0.0f;
    float ends[2][3];
    for (int c = 0; c < 3; ++c) {
      ends[1][c] = within_limit((mean[c] + scale * mean_u[c]) * (1.0f / 16));
      ends[0][c] = std::max(ends[1][c] - scale * (1.0f / 16), 0.0f);
    }
    return below_limit(ends, [&] {
      return least_layout(
          scale_layouts(ends[1], scale * (1.0f / 16), search_.finer), ends, sums,
          [&](int layout) { return store_scale(ends[1], scale * (1.0f / 16), layout, range); }, best);
    });
  }

  // ------------------------------------------------------------------------------------------------ indices

  /// Chooses the indices; sets the error.
  void choose_indices(Candidate& candidate) const {
    kShapeTable[static_cast<std::size_t>(candidate.shape)].partitions == 1 ? choose<1>(candidate)
                                                                           : choose<2>(candidate);
  }
  template <int kRegions>
  void choose(Candidate& candidate) const {
    const Weights& weights = weights_of(candidate.shape);
    // Of each region and channel, as ASTC and as BC6H.
    alignas(64) float logs[kRegions][6][16];
    for (int r = 0; r < kRegions; ++r) {
      for (int c = 0; c < 3; ++c) {
        const int a = candidate.ends[r].ends[0][c] << 4, b = candidate.ends[r].ends[1][c] << 4;
        for (int k = 0; k < weights.count; ++k) {
          const int w = weights.weight[k], value = (a * (64 - w) + b * w + 32) >> 6;
          logs[r][c][k] = scale_.log[astc::half_of_logarithm(value)];
        }
      }
    }
    const int first =
        kRegions == 2 && tables_.partitions[static_cast<std::size_t>(candidate.partition)].swapped ? 1 : 0;
    float nearer = 0;
    for (int c = 0; c < 3; ++c) {
      const float(&ends)[16] = logs[first % kRegions][c];
      const float a = log_[c][0] - ends[0], b = log_[c][0] - ends[weights.count - 1];
      nearer += a * a - b * b;
    }
    const Bc6hEnds as = as_bc6h(candidate.ends, kRegions, first, nearer > 0);
    for (int r = 0; r < kRegions; ++r) {
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < weights.count; ++k) {
          logs[r][3 + c][k] = scale_.log[static_cast<std::size_t>(
              bc6h::interpolated(as.wide[r][0][c], as.wide[r][1][c], weights.bc6h[k]))];
        }
      }
    }
    const auto entry = [&](const auto& in_second, int c, int k) {
      if constexpr (kRegions == 1) {
        return Pack(logs[0][c][k]);
      } else {
        return xsimd::select(in_second, Pack(logs[1][c][k]), Pack(logs[0][c][k]));
      }
    };
    alignas(64) float indices[kTexels];
    Pack sum(0.0f);
    for (int p = 0; p < kPacks; ++p) {
      const auto in_second = Pack::load_unaligned(&region_[1][p * kLanes]) > Pack(0.5f);
      const Pack x = Pack::load_unaligned(&log_[0][p * kLanes]),
                 y = Pack::load_unaligned(&log_[1][p * kLanes]),
                 z = Pack::load_unaligned(&log_[2][p * kLanes]);
      Pack least(std::numeric_limits<float>::max()), which(0.0f);
      for (int k = 0; k < weights.count; ++k) {
        Pack error(0.0f);
        for (int c = 0; c < 6; c += 3) {
          const Pack dx = entry(in_second, c, k) - x, dy = entry(in_second, c + 1, k) - y,
                     dz = entry(in_second, c + 2, k) - z;
          error = xsimd::fma(dx, dx, xsimd::fma(dy, dy, xsimd::fma(dz, dz, error)));
        }
        const auto less = error < least;
        least = xsimd::select(less, error, least);
        which = xsimd::select(less, Pack(static_cast<float>(k)), which);
      }
      sum = sum + least;
      which.store_unaligned(indices + p * kLanes);
    }
    for (int i = 0; i < kTexels; ++i) candidate.indices[i] = static_cast<std::uint8_t>(indices[i]);
    candidate.error = xsimd::hadd(sum);
  }

  // ------------------------------------------------------------------------------------------------
  // candidates

  /// Fits endpoints to the texels' shares of the second one, and chooses indices; false when none can be
  /// stored.
  bool fitted(const float* share, Candidate& candidate) const {
    const Shape& what = kShapeTable[static_cast<std::size_t>(candidate.shape)];
    const StoredValues& range = StoredValues::of(what.endpoint_range);
    for (int r = 0; r < what.partitions; ++r) {
      const bool possible = what.mode == 7 ? fit_scale(r, share, range, candidate.ends[r])
                                           : fit_direct(r, share, range, candidate.ends[r]);
      if (!possible) return false;
    }
    choose_indices(candidate);
    return true;
  }

  /// A first candidate of this shape.
  void start(int shape, int partition, const float* share) {
    Candidate& candidate = candidates_[count_];
    candidate = {};
    candidate.shape = shape;
    candidate.partition = partition;
    if (fitted(share, candidate)) ++count_;
  }

  void refine(Candidate candidate, Candidate& best) {
    set_regions_of(candidate);
    const Weights& weights = weights_of(candidate.shape);
    for (int round = 0; round < search_.refits; ++round) {
      Candidate next = candidate;
      alignas(64) float share[kTexels];
      for (int i = 0; i < kTexels; ++i)
        share[i] = static_cast<float>(weights.weight[candidate.indices[i]]) * (1.0f / 64);
      if (!fitted(share, next) || !(next.error < candidate.error)) break;
      candidate = next;
    }
    if (candidate.error < best.error) best = candidate;
  }

  void one_region() {
    Fit::centre();
    set_regions(0);
    Pack axis[3];
    Fit::residual(Fit::whole(), axis);
    float axes[2][3];
    for (int c = 0; c < 3; ++c) axes[0][c] = axes[1][c] = axis[c].get(0);
    alignas(64) float share[kTexels];
    Fit::project(0, axes, nullptr, share);
    start(kOneDirect16, 0, share);
    start(kOneDirect12, 0, share);
    constexpr float kGrey[2][3] = {{1, 1, 1}, {1, 1, 1}};
    Fit::project(0, kGrey, nullptr, share);
    start(kOneScale16, 0, share);
  }

  void two_regions(int partition, bool grey) {
    const unsigned second = tables_.partitions[static_cast<std::size_t>(partition)].second;
    set_regions(second);
    float axes[2][3];
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 3; ++c) axes[r][c] = grey ? 1.0f : axes_[r][c][partition];
    }
    alignas(64) float share[kTexels];
    Fit::project(second, axes, nullptr, share);
    if (!grey) {
      start(kTwoDirect4, partition, share);
      if (search_.all_shapes) start(kTwoDirect3, partition, share);
      return;
    }
    start(kTwoScale8, partition, share);
    start(kTwoScale5, partition, share);
    if (!search_.all_shapes) return;
    for (const int shape : {kTwoScale6, kTwoScale4, kTwoScale3}) start(shape, partition, share);
  }

  /// Moves every value of the endpoints by a step of its range, with the indices chosen again, where that
  /// lessens the error; whether it did.
  bool move(Candidate& best) const {
    const Shape& shape = kShapeTable[static_cast<std::size_t>(best.shape)];
    const StoredValues& range = StoredValues::of(shape.endpoint_range);
    const float before = best.error;
    for (int r = 0; r < shape.partitions; ++r) {
      for (int i = 0; i < shape.values(); ++i) {
        for (const bool up : {true, false}) {
          Candidate next = best;
          StoredEnds& ends = next.ends[r];
          ends.values[i] = (up ? range.above : range.below)[ends.values[i]];
          shape.mode == 7 ? astc::decode_base_and_scale(ends.values, ends.ends)
                          : astc::decode_direct(ends.values, ends.ends);
          if (!ends.legal()) continue;
          choose_indices(next);
          if (next.error < best.error) {
            best = next;
            break;
          }
        }
      }
    }
    return best.error < before;
  }

  static constexpr int kMaxTried = 4;  // partitions

  const Search search_;
  const Tables& tables_;
  Candidate candidates_[3 + 7 * kMaxTried];
  int count_ = 0;
};

}  // namespace welkin::texture::uastc
