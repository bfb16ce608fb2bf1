#include "welkin/lookup/mass_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/map/texel_points.h"
#include "welkin/sphere/cube.h"

namespace welkin {
namespace {

/// Where a point near an edge of a face lies in the face beyond: its angles there are ± the angle left to
/// 90°, and ± that along the edge.
std::array<FaceNeighbor, 24> neighbors() {
  std::array<FaceNeighbor, 24> all{};
  for (int face = 0; face < 6; ++face) {
    const sphere::CubeFace& f = sphere::kCubeFaces[face];
    for (int edge = 0; edge < 4; ++edge) {
      const Vec3d out = (edge % 2 == 0 ? 1.0 : -1.0) * (edge < 2 ? f.right : f.down);
      const Vec3d along = edge < 2 ? f.down : f.right;
      for (int other = 0; other < 6; ++other) {
        const sphere::CubeFace& g = sphere::kCubeFaces[other];
        if (dot(g.forward, out) < 0.5) continue;
        FaceNeighbor& n = all[static_cast<std::size_t>(face * 4 + edge)];
        n.face = other;
        n.out_u = static_cast<float>(dot(g.right, f.forward));
        n.along_u = static_cast<float>(dot(g.right, along));
        n.out_v = static_cast<float>(dot(g.down, f.forward));
        n.along_v = static_cast<float>(dot(g.down, along));
      }
    }
  }
  return all;
}

/// The next level: B of twice the width is a sum of four, ¼ ¾ ¾ ¼.
FaceGrid halved(const FaceGrid& fine, const Monitor& monitor) {
  FaceGrid coarse(fine.size() / 2, fine.margin() / 2, LargeMemory::Contents::zero);
  constexpr float kWeights[4] = {0.25f, 0.75f, 0.75f, 0.25f};
  const int side = coarse.side();
  parallel_for(
      3 * side,
      [&](int job) {
        const int pair = job / side, y = job % side;
        const std::size_t pitch = static_cast<std::size_t>(fine.side()) * FaceGrid::kPair;
        float* to = coarse.pair(pair) + static_cast<std::size_t>(y * side) * FaceGrid::kPair;
        std::vector<float> line(pitch);
        for (int r = 0; r < 4; ++r) {
          const int row = 2 * y - 1 + r;
          if (row < 0 || row >= fine.side()) continue;
          const float* from = fine.pair(pair) + static_cast<std::size_t>(row) * pitch;
          for (std::size_t i = 0; i < pitch; ++i) line[i] += kWeights[r] * from[i];
        }
        for (int x = 0; x < side; ++x, to += FaceGrid::kPair) {
          for (int r = 0; r < 4; ++r) {
            const int column = 2 * x - 1 + r;
            if (column < 0 || column >= fine.side()) continue;
            const float* from = line.data() + static_cast<std::size_t>(column) * FaceGrid::kPair;
            for (std::size_t i = 0; i < FaceGrid::kPair; ++i) to[i] += kWeights[r] * from[i];
          }
        }
      },
      without_progress(monitor));
  return coarse;
}

/// Solid angles of the grid's texels as the fourth value.
void set_solid_angles(FaceGrid& grid) {
  const double step = kPi / 2 / grid.size();
  std::vector<double> tangents(static_cast<std::size_t>(grid.side()));
  for (int i = 0; i < grid.side(); ++i)
    tangents[static_cast<std::size_t>(i)] = std::tan((i - grid.margin() + 0.5) * step - kPi / 4);
  for (int y = 0; y < grid.side(); ++y) {
    for (int x = 0; x < grid.side(); ++x) {
      const double s = tangents[static_cast<std::size_t>(x)], t = tangents[static_cast<std::size_t>(y)];
      const double r2 = 1 + s * s + t * t;
      const float area = static_cast<float>(step * step * (1 + s * s) * (1 + t * t) / (r2 * std::sqrt(r2)));
      for (int face = 0; face < 6; ++face) grid.at(face, x, y)[3] = area;
    }
  }
}

}  // namespace

MassGrid::MassGrid(const Map& map, int first, int size, int margin, int levels, const Monitor& monitor) {
  FaceGrid grid(size, margin, LargeMemory::Contents::zero);
  const sphere::AnyParameterization& p = map.parameterization;
  const Matrix3 to_world = transpose(map.orientation);
  const bool turned = !(to_world == Matrix3{});
  static const std::array<FaceNeighbor, 24> kNeighbors = neighbors();
  const int channels = std::min(3, map.channels() - first);

  constexpr std::size_t kMost = 256;
  alignas(64) float u[kMost], v[kMost], x[kMost], y[kMost], z[kMost], area[kMost], valid[kMost];
  alignas(64) float values[kMost * FaceGrid::kValues];
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<const float> texels = map.level.chart(chart);
    for (int row = 0; row < 2 * map.height(); ++row) {
      if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
      const double at_v = (row / 2 + kGauss[row % 2]) / map.height();
      for (int start = 0; start < 2 * map.width(); start += static_cast<int>(kMost)) {
        const std::size_t count = std::min(kMost, static_cast<std::size_t>(2 * map.width() - start));
        const std::size_t padded = sphere::padded(count);
        for (std::size_t i = 0; i < padded; ++i) {
          const int column = std::min(start + static_cast<int>(i), 2 * map.width() - 1);
          u[i] = static_cast<float>((column / 2 + kGauss[column % 2]) / map.width());
          v[i] = static_cast<float>(at_v);
        }
        p.kernels().to_sphere(p.self(), chart, u, v, x, y, z, count);
        if (p.density_by_row()) {
          p.kernels().density(p.self(), chart, u, v, area, 1);
          std::fill_n(area + 1, padded - 1, area[0]);
        } else {
          p.kernels().density(p.self(), chart, u, v, area, count);
        }
        const float cell = static_cast<float>(0.25 / map.width() / map.height());
        if (!p.full_charts()) {
          p.kernels().valid(p.self(), chart, u, v, valid, count);
          for (std::size_t i = 0; i < count; ++i) area[i] = valid[i] > 0.5f ? area[i] : 0.0f;
        }
        for (std::size_t i = 0; i < count; ++i) {
          const float* texel = texels.at((start + static_cast<int>(i)) / 2, row / 2) + first;
          float* value = values + i * FaceGrid::kValues;
          const float share = area[i] * cell;
          value[0] = share * texel[0];
          value[1] = channels > 1 ? share * texel[1] : 0;
          value[2] = channels > 2 ? share * texel[2] : 0;
          value[3] = share;
        }
        if (turned) {
          for (std::size_t i = 0; i < count; ++i) {
            const Vec3d d = to_world * Vec3d{x[i], y[i], z[i]};
            x[i] = static_cast<float>(d.x);
            y[i] = static_cast<float>(d.y);
            z[i] = static_cast<float>(d.z);
          }
        }
        gaussian_kernels().splat({x, y, z, values, count}, kNeighbors.data(), grid);
      }
    }
  }
  if (!p.whole_world()) set_solid_angles(grid);

  levels_.push_back(std::move(grid));
  for (int k = 1; k < levels; ++k) levels_.push_back(halved(levels_.back(), monitor));
}

}  // namespace welkin
