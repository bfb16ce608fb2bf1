#include "welkin/filter/footprint.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// Texels across the narrow side of a footprint: the coarsest level that still has as many is read. Eight
/// keep the mean within −55 dB of exact area sampling (bench/filter_quality); four would cost 10 dB and save
/// a tenth of the time.
constexpr double kTexelsAcross = 8;
constexpr int kMaxTexels = 4096;  ///< of that level, under one footprint

/// Samples for each texel of that level, along either axis, where a texel's area is bent or lies over an
/// edge.
constexpr double kSamplesPerTexel = 2;

/// Up to so many source texels per target texel the source is interpolated, and one texel later the whole
/// area is averaged. Lanczos interpolation hardly aliases up to here, and averaging earlier blurs a round
/// trip (bench/round_trip).
constexpr float kInterpolated = 1.25f;

/// A side of a texel, at least an eighth as long as the other one: so that thin texels at a pole do not get a
/// sample each.
Vec3d widened(const Vec3d& side, const Vec3d& other) {
  const double long_enough = length(other) / 8, now = length(side);
  return now > 0 && now < long_enough ? (long_enough / now) * side : side;
}

}  // namespace

float averaged_fraction(float texels) {
  const float t = clamp(texels - kInterpolated, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

double Footprint::right_length() const {
  return std::hypot(right[0], right[1]);
}
double Footprint::down_length() const {
  return std::hypot(down[0], down[1]);
}

double Footprint::narrow() const {
  // Singular values of a 2×2 matrix: σ₁σ₂ = |det|, σ₁² + σ₂² = ‖·‖².
  const double determinant = std::fabs(right[0] * down[1] - right[1] * down[0]);
  const double sum = right[0] * right[0] + right[1] * right[1] + down[0] * down[0] + down[1] * down[1];
  const double difference = std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant));
  const double larger = std::sqrt(0.5 * (sum + difference));
  return larger > 0 ? determinant / larger : 0;
}

Footprint footprint_at(const Map& source, const MapFrame& target, const Matrix3& to_source, int chart,
                       double x, double y) {
  // Tangents on the sphere times a texel's size: differences over half a texel to each side, or less where a
  // texel is so large that its ends meet.
  const auto step = [](const sphere::AnyParameterization& p, int c, double u, double v, double texel_u,
                       double texel_v) {
    constexpr double kLongest = 1.0 / 16;
    const double part = std::min(1.0, kLongest / (texel_u + texel_v));
    const double du = 0.5 * part * texel_u, dv = 0.5 * part * texel_v;
    return (1 / part) * (p.to_sphere(c, u + du, v + dv) - p.to_sphere(c, u - du, v - dv));
  };
  const auto& t = target.parameterization;
  const double u = x / target.size.width, v = y / target.size.height;
  const Vec3d right = to_source * step(t, chart, u, v, 1.0 / target.size.width, 0);
  const Vec3d down = to_source * step(t, chart, u, v, 0, 1.0 / target.size.height);

  const auto& s = source.parameterization;
  const auto position = s.from_sphere(to_source * t.to_sphere(chart, u, v));
  const int source_chart = static_cast<int>(position.chart);
  // Half a texel inside the chart: past an octahedron's edge positions fold back, and their difference
  // would vanish.
  const double texel_u = 1.0 / source.width(), texel_v = 1.0 / source.height();
  const double su = clamp(position.u, 0.5 * texel_u, 1 - 0.5 * texel_u),
               sv = clamp(position.v, 0.5 * texel_v, 1 - 0.5 * texel_v);
  const Vec3d across = step(s, source_chart, su, sv, texel_u, 0),
              along = step(s, source_chart, su, sv, 0, texel_v);
  const Vec3d texel_right = widened(across, along), texel_down = widened(along, across);

  // Least squares: texel_right·a + texel_down·b ≈ step. The small term keeps it finite where the two are
  // parallel.
  const double tiny = 1e-14 + 1e-9 * (dot(texel_right, texel_right) + dot(texel_down, texel_down));
  const double rr = dot(texel_right, texel_right) + tiny, dd = dot(texel_down, texel_down) + tiny;
  const double rd = dot(texel_right, texel_down);
  const double determinant = rr * dd - rd * rd;
  const auto solve = [&](const Vec3d& d, double* out) {
    const double r = dot(d, texel_right), b = dot(d, texel_down);
    out[0] = (r * dd - b * rd) / determinant;
    out[1] = (b * rr - r * rd) / determinant;
  };
  Footprint footprint{};
  solve(right, footprint.right);
  solve(down, footprint.down);
  return footprint;
}

namespace {

/// The lengths of a footprint's side over a tile.
struct Range {
  double minimum = 1e300, maximum = 0;

  void add(double length) {
    minimum = std::min(minimum, length);
    maximum = std::max(maximum, length);
  }
  bool varies() const { return maximum > 1 && maximum > 1.5 * minimum; }
};

struct Planner {
  const Map& source;
  const MapFrame& target;
  const Matrix3& to_source;
  int chart;
  std::vector<FootprintTile>& tiles;

  Footprint at(double x, double y) const { return footprint_at(source, target, to_source, chart, x, y); }

  /// Whether nine points of a rectangle are all invalid in the target: it lies outside a disc, except perhaps
  /// for a thin part.
  bool outside(int x, int y, int width, int height) const {
    for (int i = 0; i < 9; ++i) {
      const double u = (x + 0.5 * (i % 3) * width) / target.size.width,
                   v = (y + 0.5 * (i / 3) * height) / target.size.height;
      if (target.parameterization.valid(chart, u, v)) return false;
    }
    return true;
  }

  void plan(int x, int y, int width, int height) {
    if (outside(x, y, width, height)) {
      tiles.push_back({chart, x, y, width, height, 1, 1, 0, false, {}, {}});
      return;
    }
    const Footprint corners[5] = {at(x, y), at(x + width, y), at(x, y + height), at(x + width, y + height),
                                  at(x + 0.5 * width, y + 0.5 * height)};
    Range right, down;
    double narrowest = 1e300;
    for (const Footprint& each : corners) {
      right.add(each.right_length());
      down.add(each.down_length());
      narrowest = std::min(narrowest, each.narrow());
    }
    // Split where the footprint changes: near poles and the rims of discs.
    if ((right.varies() || down.varies()) && width * height > 1) {
      const int w = (width + 1) / 2, h = (height + 1) / 2;
      plan(x, y, w, h);
      if (w < width) plan(x + w, y, width - w, h);
      if (h < height) plan(x, y + h, w, height - h);
      if (w < width && h < height) plan(x + w, y + h, width - w, height - h);
      return;
    }
    FootprintTile tile{chart, x, y, width, height, 1, 1, 0, false, {}, {}};
    for (int i = 0; i < 4; ++i) {
      // In a texel at a pole the corners do not bound what lies between them.
      tile.texels_right[i] = static_cast<float>(right.varies() ? right.maximum : corners[i].right_length());
      tile.texels_down[i] = static_cast<float>(down.varies() ? down.maximum : corners[i].down_length());
    }
    const auto averaged = [&](double texels) {
      const double part = static_cast<double>(averaged_fraction(static_cast<float>(texels)));
      return std::min(part * texels / std::exp2(tile.level), 1e4);
    };
    const int max_levels = 20;
    tile.level =
        static_cast<int>(clamp(std::floor(std::log2(narrowest / kTexelsAcross + 1e-300)), 0.0, 20.0));
    while (tile.level < max_levels && averaged(right.maximum) * averaged(down.maximum) > kMaxTexels)
      ++tile.level;
    const float fewest = std::min(*std::min_element(tile.texels_right, tile.texels_right + 4),
                                  *std::min_element(tile.texels_down, tile.texels_down + 4));
    tile.whole = averaged_fraction(fewest) >= 1;
    const auto samples = [&](double texels) {
      const double density = averaged_fraction(static_cast<float>(texels)) < 1 ? 1 : kSamplesPerTexel;
      return std::max(1, static_cast<int>(std::ceil(density * averaged(texels))));
    };
    tile.samples_right = samples(right.maximum);
    tile.samples_down = samples(down.maximum);
    tiles.push_back(tile);
  }
};

}  // namespace

void plan_tiles(const Map& source, const MapFrame& target, const Matrix3& to_source, int chart, int first_row,
                int rows, std::vector<FootprintTile>& tiles) {
  Planner planner{source, target, to_source, chart, tiles};
  for (int x = 0; x < target.size.width; x += kTileSide) {
    planner.plan(x, first_row, std::min(kTileSide, target.size.width - x), rows);
  }
}

}  // namespace welkin
