#pragma once

#include "welkin/filter/reconstruction_impl.h"
#include "welkin/filter/refinement.h"

/// Included by one source file per instruction set, as fetch_impl.h.
namespace welkin {

template <class Wide, class Four>
class RefinementOf : private ReconstructionOf<Wide, Four> {
  using Whole = ReconstructionOf<Wide, Four>;
  using typename Whole::Coefficients;

 public:
  using typename Whole::Pack;
  using Whole::kSize;

  static void divide(const LevelView& texels, const ReconstructedTexels& whole, int row, int parts,
                     const DividedRow& out) {
    if (parts == 2) return divide_row<2>(texels, whole, row, out);
    divide_row<4>(texels, whole, row, out);
  }

  static void reconstruct_parts(const LevelView& parts, ReconstructedTexels& out) {
    const std::ptrdiff_t channels = out.channels, row = out.width * channels, down = parts.row_stride;
    const float* first = parts.texels + out.y * down + static_cast<std::ptrdiff_t>(out.x) * channels;
    const Pack half(0.5f), quarter(0.25f), beyond(kBeyondParts);
    for (int y = 0; y < out.height; ++y, first += down) {
      for (std::ptrdiff_t i = 0; i < row; i += kSize) {
        const auto at = [&](int right, int below) {
          return Pack::load_unaligned(first + i + below * down + right * channels);
        };
        const Pack m = at(0, 0), left = at(-1, 0), right = at(1, 0), above = at(0, -1), below = at(0, 1);
        const Pack corners[4] = {at(-1, -1), at(1, -1), at(-1, 1), at(1, 1)};
        Coefficients a{m,
                       half * (right - left),
                       half * (below - above),
                       half * (left + right) - m,
                       quarter * ((corners[0] + corners[3]) - (corners[1] + corners[2])),
                       half * (above + below) - m};
        Pack low = xsimd::min(xsimd::min(m, xsimd::min(left, right)), xsimd::min(above, below));
        Pack high = xsimd::max(xsimd::max(m, xsimd::max(left, right)), xsimd::max(above, below));
        for (const Pack& corner : corners) {
          low = xsimd::min(low, corner);
          high = xsimd::max(high, corner);
        }
        Whole::limit(a, Whole::lowest_point(a), low - slack(low, high, beyond), Whole::highest_point(a),
                     high + beyond * (high - low));
        Whole::store(a, out, y, i);
      }
    }
  }

 private:
  /// How far below the lowest of some texels a part may go.
  static Pack slack(const Pack& low, const Pack& high, const Pack& beyond) {
    const Pack range = high - low, tiny(1e-30f);
    const Pack steep = range / xsimd::fma(Pack(kFlatFloor), xsimd::abs(low), tiny);
    return beyond * range * xsimd::max(Pack(1.0f) - steep, Pack(0.0f));
  }

  template <int K>
  static void divide_row(const LevelView& texels, const ReconstructedTexels& whole, int row,
                         const DividedRow& out) {
    constexpr int kParts = K * K;
    const std::ptrdiff_t channels = whole.channels, values = whole.width * channels, plane = whole.plane();
    const float* middle =
        texels.texels + (whole.y + row) * texels.row_stride + static_cast<std::ptrdiff_t>(whole.x) * channels;
    const float* coefficients = whole.coefficients.data() + row * values;
    for (std::ptrdiff_t i = 0; i < values; i += kSize) {
      const auto at = [&](int right, int below) {
        return Pack::load_unaligned(middle + i + below * texels.row_stride + right * channels);
      };
      const auto of = [&](int k) { return Pack::load_unaligned(coefficients + k * plane + i); };
      const auto share = [&](int t) {
        return Pack::load_unaligned(out.shares + static_cast<std::size_t>(t) * out.stride + i);
      };
      const Pack m = at(0, 0);

      // Means over the parts.
      const Pack constant = of(0), x = of(1), y = of(2), xx = of(3), xy = of(4), yy = of(5);
      Pack part[kParts], excess(0.0f);
      for (int t = 0; t < kParts; ++t) {
        constexpr float kSide = 1.0f / K;
        const float right = (static_cast<float>(t % K) + 0.5f) * kSide - 0.5f,
                    below = (static_cast<float>(t / K) + 0.5f) * kSide - 0.5f;
        const Pack px(right), py(below), pxx(right * right + kSide * kSide / 12),
            pyy(below * below + kSide * kSide / 12);
        part[t] = xsimd::fma(px, xsimd::fma(py, xy, x),
                             xsimd::fma(py, y, xsimd::fma(pxx, xx, xsimd::fma(pyy, yy, constant))));
        excess = xsimd::fma(share(t), part[t] - m, excess);
      }

      // The limits of each quarter.
      Pack floor[4], ceiling[4];
      for (int q = 0; q < 4; ++q) {
        const int right = q % 2 * 2 - 1, below = q / 2 * 2 - 1;
        const Pack a = at(right, 0), b = at(0, below), c = at(right, below), beyond(kBeyondTexels);
        const Pack low = xsimd::min(xsimd::min(m, a), xsimd::min(b, c)),
                   high = xsimd::max(xsimd::max(m, a), xsimd::max(b, c));
        floor[q] = low - slack(low, high, beyond);
        ceiling[q] = high + beyond * (high - low);
      }
      const auto quarter = [](int t) { return t % K * 2 / K + t / K * 2 / K * 2; };
      Pack clipped(0.0f);
      for (int t = 0; t < kParts; ++t) {
        const Pack wanted = part[t] - excess;
        part[t] = xsimd::min(xsimd::max(wanted, floor[quarter(t)]), ceiling[quarter(t)]);
        clipped = xsimd::max(clipped, xsimd::abs(part[t] - wanted));
      }

      // What was clipped is shared among those that have room.
      const auto missing = [&] {
        Pack sum(0.0f);
        for (int t = 0; t < kParts; ++t) sum = xsimd::fma(share(t), m - part[t], sum);
        return sum;
      };
      // Rounding is none of it.
      const auto limited = clipped > Pack(1e-5f) * xsimd::abs(m);
      if (xsimd::any(limited)) {
        for (int round = 0; round < kClippedRounds; ++round) {
          const Pack zero(0.0f), lack = xsimd::select(limited, missing(), zero);
          const auto upwards = lack > zero;
          const auto has_room = [&](int t) {
            const Pack room =
                xsimd::select(upwards, ceiling[quarter(t)] - part[t], part[t] - floor[quarter(t)]);
            return room > zero;
          };
          Pack room(0.0f);
          for (int t = 0; t < kParts; ++t) room += xsimd::select(has_room(t), share(t), zero);
          const Pack step = xsimd::select(room > zero, lack / room, zero);
          for (int t = 0; t < kParts; ++t) {
            const Pack moved = xsimd::min(xsimd::max(part[t] + step, floor[quarter(t)]), ceiling[quarter(t)]);
            part[t] = xsimd::select(has_room(t), moved, part[t]);
          }
        }
      }
      const Pack rest = missing();
      for (int t = 0; t < kParts; ++t) part[t] += rest;
      for (int t = 0; t < kParts; ++t)
        part[t].store_unaligned(out.parts + static_cast<std::size_t>(t) * out.stride + i);
    }
  }
};

template <class Wide, class Four>
ReconstructionKernels reconstruction_kernels_of(int channels) {
  using Kernels = ReconstructionOf<Wide, Four>;
  using Parts = RefinementOf<Wide, Four>;
  const auto with = [](auto means) {
    return ReconstructionKernels{Kernels::reconstruct, means, Parts::divide, Parts::reconstruct_parts};
  };
  switch (channels) {
    case 1:
      return with(Kernels::template means<1>);
    case 3:
      return with(Kernels::template means<3>);
    case 4:
      return with(Kernels::template means<4>);
    default:
      return with(Kernels::template means<0>);
  }
}

}  // namespace welkin
