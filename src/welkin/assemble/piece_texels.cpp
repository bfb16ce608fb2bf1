#include "welkin/assemble/piece_texels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/math/angles.h"

namespace welkin {
namespace {

int tiles_along(int texels) {
  return (texels + Tile::kSide - 1) / Tile::kSide;
}

double squared_distance(const Vec3d& a, const Vec3d& b) {
  const Vec3d d = a - b;
  return dot(d, d);
}

/// Of unit vectors that far apart, the angle.
double angle_of(double squared_distance) {
  return 2 * std::asin(std::min(0.5 * std::sqrt(squared_distance), 1.0));
}

/// How far texels reach from their centres, by the distances between these.
double reach_of(const Tile& tile) {
  if (tile.width < 2 || tile.height < 2) return kPi;
  double farthest = 0;
  const std::size_t row = static_cast<std::size_t>(tile.width);
  for (std::size_t i = 0; i < tile.directions.size(); ++i) {
    const Vec3d& d = tile.directions[i];
    if (i % row > 0) farthest = std::max(farthest, squared_distance(tile.directions[i - 1], d));
    if (i >= row) farthest = std::max(farthest, squared_distance(tile.directions[i - row], d));
  }
  return angle_of(farthest);
}

}  // namespace

Tiles::Tiles(const MapFrame& frame)
    : frame_(frame),
      to_world_(transpose(frame.orientation)),
      columns_(tiles_along(frame.size.width)),
      rows_(tiles_along(frame.size.height)) {}

int Tiles::count() const {
  return frame_.parameterization.charts() * columns_ * rows_;
}

Tile Tiles::at(int number) const {
  Tile tile;
  tile.chart = number / (columns_ * rows_);
  tile.x = number % columns_ * Tile::kSide;
  tile.y = number / columns_ % rows_ * Tile::kSide;
  tile.width = std::min(Tile::kSide, frame_.size.width - tile.x);
  tile.height = std::min(Tile::kSide, frame_.size.height - tile.y);
  const auto count = static_cast<std::size_t>(tile.count());
  constexpr std::size_t kMost = sphere::padded(std::size_t{Tile::kSide} * Tile::kSide);
  alignas(64) float u[kMost], v[kMost], x[kMost], y[kMost], z[kMost];
  for (std::size_t i = 0; i < sphere::padded(count); ++i) {
    const int texel = static_cast<int>(std::min(i, count - 1));
    u[i] = (static_cast<float>(tile.x + texel % tile.width) + 0.5f) / static_cast<float>(frame_.size.width);
    v[i] = (static_cast<float>(tile.y + texel / tile.width) + 0.5f) / static_cast<float>(frame_.size.height);
  }
  const auto& p = frame_.parameterization;
  p.kernels().to_sphere(p.self(), tile.chart, u, v, x, y, z, count);
  tile.directions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d d{static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
    tile.directions.push_back(to_world_ * d);
  }
  tile.centre = tile.directions[static_cast<std::size_t>(tile.height / 2 * tile.width + tile.width / 2)];
  double farthest = 0;
  for (const Vec3d& d : tile.directions) farthest = std::max(farthest, squared_distance(d, tile.centre));
  tile.radius = angle_of(farthest);
  tile.texel = reach_of(tile);
  return tile;
}

PieceTexels::PieceTexels(const Piece& piece, const MapFrame& frame)
    : piece_(piece), maker_(make_texels(piece.map, frame, {})) {}

double PieceTexels::feather_at(const Tile& tile, std::size_t texel) const {
  const Vec3d d = piece_.map.orientation * tile.directions[texel];
  double depth = kPi, feather = 1;
  for (const Cap& cap : piece_.edges) {
    const double inside = cap.depth(d);
    depth = std::min(depth, inside);
    if (piece_.feather > 0) feather *= smooth_step(0, piece_.feather, inside);
  }
  // At an edge of the map part of a texel may be seen; an edge inside it leaves out what has its centre
  // beyond.
  const bool seen = depth > 0 || (depth > -tile.texel && !piece_.map.parameterization.covers(d));
  return seen ? feather : -1;
}

bool PieceTexels::make(const Tile& tile, float* colours, double* feathers) const {
  double least_depth = kPi;
  for (const Cap& cap : piece_.edges)
    least_depth = std::min(least_depth, cap.depth(piece_.map.orientation * tile.centre));
  if (least_depth < -(tile.radius + tile.texel)) return false;
  bool any = true;
  if (least_depth > tile.radius + piece_.feather) {
    std::fill_n(feathers, tile.count(), 1.0);
  } else {
    any = false;
    for (int i = 0; i < tile.count(); ++i) {
      feathers[i] = feather_at(tile, static_cast<std::size_t>(i));
      any = any || feathers[i] >= 0;
    }
  }
  if (!any) return false;
  const ImageView<float> out{colours, tile.width, tile.height, 4, tile.width * std::ptrdiff_t{4}};
  ChartPart part;
  part.chart = tile.chart;
  part.walk.start_x = tile.x;
  part.walk.start_y = tile.y;
  maker_->make(part, out);
  const float gain = static_cast<float>(piece_.gain);
  for (int i = 0; i < tile.count(); ++i) {
    for (int c = 0; c < 3; ++c) colours[4 * i + c] *= gain;
    if (feathers[i] < 0) {
      std::fill_n(colours + 4 * i, 4, 0.0f);
      feathers[i] = 0;
    }
  }
  return true;
}

double PieceTexels::fineness(const Vec3d& direction) const {
  const auto& p = piece_.map.parameterization;
  const auto at = p.from_sphere(piece_.map.orientation * direction);
  const int chart = static_cast<int>(at.chart);
  const double u = clamp(at.u, 0.0, 1.0), v = clamp(at.v, 0.0, 1.0);
  // What a step of one texel to the right and one down turns the direction by.
  const double width = piece_.map.width(), height = piece_.map.height();
  constexpr double kStep = 1e-3;
  const Vec3d here = p.to_sphere(chart, u, v);
  const Vec3d right = (1 / kStep) * (p.to_sphere(chart, u + kStep / width, v) - here);
  const Vec3d down = (1 / kStep) * (p.to_sphere(chart, u, v + kStep / height) - here);
  // The larger singular value of both.
  const double a = dot(right, right), b = dot(down, down), c = dot(right, down);
  const double longest = 0.5 * (a + b + std::sqrt((a - b) * (a - b) + 4 * c * c));
  return 1 / std::max(longest, 1e-20);
}

std::vector<double> PieceTexels::fineness(const Tile& tile) const {
  constexpr int kEvery = 8;
  const int columns = (tile.width - 2 + kEvery) / kEvery + 1, rows = (tile.height - 2 + kEvery) / kEvery + 1;
  std::vector<double> nodes;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int x = std::min(i * kEvery, tile.width - 1), y = std::min(j * kEvery, tile.height - 1);
      nodes.push_back(fineness(tile.directions[static_cast<std::size_t>(y * tile.width + x)]));
    }
  }
  // The node before a texel, and how far the texel is from it to the next, 0 … 1.
  const auto place = [](int texel, int count, int size) {
    const int node = std::clamp(texel / kEvery, 0, std::max(count - 2, 0));
    const int span = std::min((node + 1) * kEvery, size - 1) - node * kEvery;
    return std::pair{node, span > 0 ? static_cast<double>(texel - node * kEvery) / span : 0.0};
  };
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(tile.count()));
  for (int y = 0; y < tile.height; ++y) {
    const auto [row, down] = place(y, rows, tile.height);
    for (int x = 0; x < tile.width; ++x) {
      const auto [column, right] = place(x, columns, tile.width);
      const auto node = [&](int i, int j) {
        return nodes[static_cast<std::size_t>(std::min(j, rows - 1) * columns + std::min(i, columns - 1))];
      };
      const double above = node(column, row) + right * (node(column + 1, row) - node(column, row));
      const double below =
          node(column, row + 1) + right * (node(column + 1, row + 1) - node(column, row + 1));
      values.push_back(above + down * (below - above));
    }
  }
  return values;
}

}  // namespace welkin
