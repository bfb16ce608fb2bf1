#include "welkin/map_file/byte_remap.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/texel_points.h"
#include "welkin/map_file/cell_walk.h"

namespace welkin {
namespace {

constexpr int kSteps = 64;  ///< of a texel
constexpr int kBatch = 256;

/// Channels of a texel in one number, 21 bits for each, so that one product weighs all of them: a sum of 2×2
/// texels with weights that add up to 64² stays below 2²⁰.
template <int kChannels>
std::uint64_t spread(const std::uint8_t* texel) {
  std::uint64_t lanes = texel[0];
  if constexpr (kChannels > 1) lanes |= std::uint64_t{texel[1]} << 21;
  if constexpr (kChannels > 2) lanes |= std::uint64_t{texel[2]} << 42;
  return lanes;
}

template <int kChannels>
void blend(const std::uint8_t* const texels[4], unsigned right, unsigned down, std::uint8_t* out) {
  const std::uint64_t high = kSteps - down, left = kSteps - right;
  constexpr std::uint64_t kHalf = 2048, kHalves = kHalf | (kHalf << 21) | (kHalf << 42);
  const std::uint64_t sum = spread<kChannels>(texels[0]) * (left * high) +
                            spread<kChannels>(texels[1]) * (right * high) +
                            spread<kChannels>(texels[2]) * (left * down) +
                            spread<kChannels>(texels[3]) * (std::uint64_t{right} * down) + kHalves;
  out[0] = static_cast<std::uint8_t>(sum >> 12);
  if constexpr (kChannels > 1) out[1] = static_cast<std::uint8_t>(sum >> 33);
  if constexpr (kChannels > 2) out[2] = static_cast<std::uint8_t>(sum >> 54);
}

}  // namespace

ByteRemap::Tap ByteRemap::tap_at(const MapFrame& source, float u, float v, std::vector<Edge>& edges) const {
  const auto [width, height] = source_;
  // In 64ths of a texel from the centre of the first.
  const auto fixed = [](float position, int size) {
    const double at = (static_cast<double>(position) * size - 0.5) * kSteps;
    return static_cast<std::int64_t>(std::lround(std::clamp(at, -1.0 * kSteps, 1.0 * kSteps * size)));
  };
  const std::int64_t x = fixed(u, width), y = fixed(v, height);
  const int left = static_cast<int>(x >> 6), top = static_cast<int>(y >> 6);
  Tap tap{0, static_cast<std::uint16_t>(x & 63), static_cast<std::uint16_t>(y & 63)};
  const auto index = [width = width](int column, int row) {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(width) +
           static_cast<std::uint32_t>(column);
  };
  if (left >= 0 && top >= 0 && left + 1 < width && top + 1 < height) {
    tap.texel = index(left, top);
    return tap;
  }
  // Past an edge lies the texel that is seen there, if there is one; else the nearest is repeated.
  const auto& p = source.parameterization;
  Edge edge;
  for (int i = 0; i < 4; ++i) {
    int column = left + i % 2, row = top + i / 2;
    if (column < 0 || row < 0 || column >= width || row >= height) {
      const Vec3d d = p.to_sphere(0, (column + 0.5) / width, (row + 0.5) / height);
      if (p.covers(d)) {
        const auto at = p.from_sphere(d);
        column = static_cast<int>(std::floor(at.u * width));
        row = static_cast<int>(std::floor(at.v * height));
      }
      column = std::clamp(column, 0, width - 1);
      row = std::clamp(row, 0, height - 1);
    }
    edge.texels[i] = index(column, row);
  }
  tap.texel = kIsEdge | static_cast<std::uint32_t>(edges.size());
  edges.push_back(edge);
  return tap;
}

ByteRemap::ByteRemap(const MapFrame& source, const MapFrame& target, const Layout& layout, std::uint8_t fill)
    : source_(source.size), fill_(fill) {
  require(source.parameterization.charts() == 1, "an 8-bit picture is resampled from one chart");
  require(layout.kind == LayoutKind::picture, "an 8-bit picture is resampled into one picture");
  check_turns(layout, target.size);
  if (static_cast<std::uint64_t>(source_.width) * static_cast<std::uint64_t>(source_.height) >= kIsEdge)
    throw Error(ErrorKind::too_large, "an 8-bit picture of 2³¹ pixels and more is not resampled");
  const int width = target.size.width, height = target.size.height;
  target_ = {layout.columns * width, layout.rows * height};
  taps_.assign(static_cast<std::size_t>(target_.width) * static_cast<std::size_t>(target_.height),
               {kIsFill, 0, 0});
  const Matrix3 to_source = source.orientation * transpose(target.orientation);
  const auto& to = target.parameterization;
  const auto& from = source.parameterization;
  const int rows_of_cells = static_cast<int>(layout.cells.size()) * height;
  std::vector<std::vector<Edge>> edges(static_cast<std::size_t>(rows_of_cells));
  parallel_for(rows_of_cells, [&](int i) {
    const LayoutCell& cell = layout.cells[static_cast<std::size_t>(i / height)];
    const TexelWalk walk = walk_of(cell, target.size);
    const int y = i % height;
    alignas(64) float u[kBatch], v[kBatch], dx[kBatch], dy[kBatch], dz[kBatch], chart[kBatch], shown[kBatch],
        valid[kBatch];
    Tap* row = taps_.data() + static_cast<std::ptrdiff_t>(cell.row * height + y) * target_.width +
               cell.column * width;
    for (int start = 0; start < width; start += kBatch) {
      const int count = std::min(kBatch, width - start);
      for (int x = 0; x < static_cast<int>(sphere::padded(static_cast<std::size_t>(count))); ++x) {
        const int at = start + std::min(x, count - 1);
        u[x] = (static_cast<float>(walk.image_x(at, y)) + 0.5f) / static_cast<float>(width);
        v[x] = (static_cast<float>(walk.image_y(at, y)) + 0.5f) / static_cast<float>(height);
      }
      const auto n = static_cast<std::size_t>(count);
      to.kernels().valid(to.self(), cell.chart, u, v, valid, n);
      to.kernels().to_sphere(to.self(), cell.chart, u, v, dx, dy, dz, n);
      multiply(to_source, dx, dy, dz, sphere::padded(n));
      from.kernels().covers(from.self(), dx, dy, dz, shown, n);
      from.kernels().from_sphere(from.self(), dx, dy, dz, chart, u, v, n);
      for (int x = 0; x < count; ++x) {
        if (!(shown[x] > 0)) continue;
        if (valid[x] > 0 || to.filled_to_edges() ||
            !is_outside_texel(to, target.size, cell.chart, walk.image_x(start + x, y),
                              walk.image_y(start + x, y)))
          row[start + x] = tap_at(source, u[x], v[x], edges[static_cast<std::size_t>(i)]);
      }
    }
  });
  // Every row counted its own edges; now all of them together.
  for (int i = 0; i < rows_of_cells; ++i) {
    const std::vector<Edge>& own = edges[static_cast<std::size_t>(i)];
    if (own.empty()) continue;
    const LayoutCell& cell = layout.cells[static_cast<std::size_t>(i / height)];
    Tap* row = taps_.data() + static_cast<std::ptrdiff_t>(cell.row * height + i % height) * target_.width +
               cell.column * width;
    for (int x = 0; x < width; ++x) {
      if (row[x].texel != kIsFill && (row[x].texel & kIsEdge) != 0)
        row[x].texel += static_cast<std::uint32_t>(edges_.size());
    }
    edges_.insert(edges_.end(), own.begin(), own.end());
  }
}

template <int kChannels>
void ByteRemap::apply_rows(const std::uint8_t* source, std::ptrdiff_t stride, std::uint8_t* out,
                           const Tap* taps, int count) const {
  const auto texel = [&](std::uint32_t index) {
    const auto width = static_cast<std::uint32_t>(source_.width);
    return source + static_cast<std::ptrdiff_t>(index / width) * stride + index % width * kChannels;
  };
  const bool packed = stride == static_cast<std::ptrdiff_t>(source_.width) * kChannels;
  for (int x = 0; x < count; ++x, out += kChannels) {
    const Tap& tap = taps[x];
    const std::uint8_t* texels[4];
    if ((tap.texel & kIsEdge) == 0) {
      texels[0] = packed ? source + static_cast<std::ptrdiff_t>(tap.texel) * kChannels : texel(tap.texel);
      texels[1] = texels[0] + kChannels;
      texels[2] = texels[0] + stride;
      texels[3] = texels[2] + kChannels;
    } else if (tap.texel == kIsFill) {
      std::memset(out, fill_, kChannels);
      continue;
    } else {
      const Edge& edge = edges_[tap.texel & ~kIsEdge];
      for (int i = 0; i < 4; ++i) texels[i] = texel(edge.texels[i]);
    }
    if constexpr (kChannels < 4) {
      blend<kChannels>(texels, tap.right, tap.down, out);
    } else {
      const std::uint8_t* const second[4] = {texels[0] + 2, texels[1] + 2, texels[2] + 2, texels[3] + 2};
      blend<2>(texels, tap.right, tap.down, out);
      blend<2>(second, tap.right, tap.down, out + 2);
    }
  }
}

void ByteRemap::apply(const ByteView<const std::uint8_t>& source,
                      const ByteView<std::uint8_t>& target) const {
  const auto differs = [](ChartSize size, int width, int height) {
    return size.width != width || size.height != height;
  };
  if (differs(source_, source.width, source.height) || differs(target_, target.width, target.height))
    throw Error(ErrorKind::mismatch,
                "the pictures have other sizes than those that positions were found for");
  if (source.channels != target.channels || source.channels < 1 || source.channels > 4)
    throw Error(ErrorKind::mismatch, "8-bit pictures to resample have the same 1 to 4 channels");
  constexpr int kRows = 8;
  parallel_for((target_.height + kRows - 1) / kRows, [&](int band) {
    const int end = std::min(target_.height, (band + 1) * kRows);
    for (int y = band * kRows; y < end; ++y) {
      std::uint8_t* out = target.data + y * target.row_stride;
      const Tap* taps = taps_.data() + static_cast<std::ptrdiff_t>(y) * target_.width;
      switch (source.channels) {
        case 1:
          apply_rows<1>(source.data, source.row_stride, out, taps, target_.width);
          break;
        case 2:
          apply_rows<2>(source.data, source.row_stride, out, taps, target_.width);
          break;
        case 3:
          apply_rows<3>(source.data, source.row_stride, out, taps, target_.width);
          break;
        default:
          apply_rows<4>(source.data, source.row_stride, out, taps, target_.width);
      }
    }
  });
}

}  // namespace welkin
