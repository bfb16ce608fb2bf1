#pragma once

#include <array>

#include "welkin/lookup/texel_blocks.h"
#include "welkin/sphere/kernels.h"

namespace welkin {

/// Directions of the texels of a block, row by row.
struct BlockDirections {
  static constexpr std::size_t kSize = TexelBlocks::kWidth * TexelBlocks::kHeight;
  static_assert(kSize % sphere::kLanes == 0);

  alignas(64) std::array<float, kSize> x, y, z;

  void find(const sphere::AnyParameterization& p, ChartSize size, const TexelBlocks::Block& block) {
    alignas(64) std::array<float, kSize> u, v;
    const std::size_t count = static_cast<std::size_t>(block.width * block.height);
    const float texel_u = 1.0f / static_cast<float>(size.width),
                texel_v = 1.0f / static_cast<float>(size.height);
    std::size_t i = 0;
    for (int row = 0; row < block.height; ++row) {
      const float down = (static_cast<float>(block.y + row) + 0.5f) * texel_v;
      for (int column = 0; column < block.width; ++column, ++i) {
        u[i] = (static_cast<float>(block.x + column) + 0.5f) * texel_u;
        v[i] = down;
      }
    }
    for (; i < sphere::padded(count); ++i) {
      u[i] = u[0];
      v[i] = v[0];
    }
    p.kernels().to_sphere(p.self(), block.chart, u.data(), v.data(), x.data(), y.data(), z.data(), count);
  }
};

}  // namespace welkin
