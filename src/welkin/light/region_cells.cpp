#include "welkin/light/region_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "welkin/base/parallel.h"
#include "welkin/light/bright_regions.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// Lights of at least so many times the mean that are spread by no more than this, radians RMS, are one cell.
constexpr double kBright = 10, kSpot = 1 * kDegree;

/// Sums over a cell.
struct CellSum {
  double x = 0, y = 0, z = 0, light = 0;            ///< by light
  double middle_x = 0, middle_y = 0, middle_z = 0;  ///< by solid angle
  double solid_angle = 0;

  void add(const RegionCell& cell) {
    const double weight = static_cast<double>(cell.light), angle = static_cast<double>(cell.solid_angle);
    light += weight;
    solid_angle += angle;
    x += weight * static_cast<double>(cell.x);
    y += weight * static_cast<double>(cell.y);
    z += weight * static_cast<double>(cell.z);
    middle_x += angle * static_cast<double>(cell.x);
    middle_y += angle * static_cast<double>(cell.y);
    middle_z += angle * static_cast<double>(cell.z);
  }
  /// Mean of |direction − centroid|² of its light.
  double spread() const {
    return light > 0 ? std::max(1 - (x * x + y * y + z * z) / (light * light), 0.0) : 0;
  }

  RegionCell cell() const {
    const auto of = [&](double by_light, double by_angle) {
      return static_cast<float>(light > 0 ? by_light / light : solid_angle > 0 ? by_angle / solid_angle : 0);
    };
    return {of(x, middle_x), of(y, middle_y), of(z, middle_z), static_cast<float>(light),
            static_cast<float>(solid_angle)};
  }
};

}  // namespace

RegionCells::RegionCells(const Map& map, const MapScan& scan, const Monitor& monitor) {
  const double texels = static_cast<double>(map.charts()) * map.width() * map.height();
  side_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(texels / kMostCells))));
  across_ = (map.width() + side_ - 1) / side_;
  down_ = (map.height() + side_ - 1) / side_;
  cells_.resize(static_cast<std::size_t>(map.charts()) * static_cast<std::size_t>(down_) *
                static_cast<std::size_t>(across_));
  const TexelLuminance luminance(map.channel_names);
  const TexelGrid grid(map);
  parallel_for(
      map.charts() * down_,
      [&](int i) {
        const int chart = i / down_, top = i % down_ * side_;
        const std::size_t width = static_cast<std::size_t>(map.width()), room = sphere::padded(width);
        std::vector<float> u(room, 0.5f), v(room), x(room), y(room), z(room);
        for (std::size_t k = 0; k < width; ++k)
          u[k] = (static_cast<float>(k) + 0.5f) / static_cast<float>(map.width());
        std::vector<CellSum> sums(static_cast<std::size_t>(across_));
        for (int row = top; row < std::min(top + side_, map.height()); ++row) {
          std::fill(v.begin(), v.end(), (static_cast<float>(row) + 0.5f) / static_cast<float>(map.height()));
          map.parameterization.kernels().to_sphere(map.parameterization.self(), chart, u.data(), v.data(),
                                                   x.data(), y.data(), z.data(), width);
          const float* texel = map.level.chart(chart).row(row);
          for (std::size_t k = 0; k < width; ++k, texel += map.channels()) {
            const double omega = scan.solid_angle(grid.number(chart, static_cast<int>(k), row));
            if (!(omega > 0)) continue;
            const double light = omega * std::max(static_cast<double>(luminance(texel)), 0.0);
            const double dx = static_cast<double>(x[k]), dy = static_cast<double>(y[k]),
                         dz = static_cast<double>(z[k]);
            CellSum& sum = sums[k / static_cast<std::size_t>(side_)];
            sum.light += light;
            sum.solid_angle += omega;
            sum.x += light * dx;
            sum.y += light * dy;
            sum.z += light * dz;
            sum.middle_x += omega * dx;
            sum.middle_y += omega * dy;
            sum.middle_z += omega * dz;
          }
        }
        for (std::size_t k = 0; k < sums.size(); ++k)
          cells_[static_cast<std::size_t>(i) * sums.size() + k] = sums[k].cell();
      },
      monitor);
  cell_of_square_.resize(cells_.size());
  std::iota(cell_of_square_.begin(), cell_of_square_.end(), std::uint32_t{0});
  merge_spots(map, scan);
}

void RegionCells::merge_spots(const Map& map, const MapScan& scan) {
  const float least = static_cast<float>(kBright * scan.mean());
  if (!(least > 0) || !std::isfinite(least)) return;
  std::vector<BrightTexel> bright;
  scan.for_bright(std::max(least, std::numeric_limits<float>::min()),
                  [&](TexelGrid::Index texel, float value) {
                    bright.push_back({texel, value});
                  });
  const TexelGrid grid(map);
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  for (const BrightRegion& region : find_bright_regions(map, std::move(bright))) {
    std::vector<std::uint32_t> squares;
    for (const TexelGrid::Index texel : region.texels) {
      const auto [chart, x, y] = grid.place(texel);
      const std::size_t square = square_of_row(chart, y) + static_cast<std::size_t>(x / side_);
      // Of two lights in one square, the first has it.
      if (cell_of_square_[square] == square) squares.push_back(static_cast<std::uint32_t>(square));
    }
    std::sort(squares.begin(), squares.end());
    squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
    CellSum sum;
    for (const std::uint32_t square : squares) sum.add(cells_[square]);
    if (squares.size() < 2 || sum.spread() > kSpot * kSpot) continue;
    const std::uint32_t first = squares.front();
    for (const std::uint32_t square : squares) {
      cells_[square] = {0, 0, 0, 0, 0};
      cell_of_square_[square] = first;
    }
    cells_[first] = sum.cell();
    // Marked as taken, though it is its own.
    cell_of_square_[first] = kNone;
  }
  for (std::size_t square = 0; square < cell_of_square_.size(); ++square) {
    if (cell_of_square_[square] == kNone) cell_of_square_[square] = static_cast<std::uint32_t>(square);
  }
}

}  // namespace welkin
