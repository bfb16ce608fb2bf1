#include "welkin/map/footprint.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// Texels across the narrow side of a footprint: the coarsest level that still has as many is read. Eight keep the mean within
/// −55 dB of exact area sampling (bench/filter_quality); four would cost 10 dB and save a tenth of the time.
constexpr double kTexelsAcross = 8;
constexpr int kMostSamples = 4096;

/// Up to so many source texels per target texel the source is interpolated, and one texel later the whole area is averaged.
/// Lanczos interpolation hardly aliases up to here, and averaging earlier blurs a round trip (bench/round_trip).
constexpr double kInterpolated = 1.25;

/// The part of a texel to average over, from the number of source texels that it spans.
double spread(double texels) {
  const double t = clamp(texels - kInterpolated, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double Footprint::right_length() const { return std::hypot(right[0], right[1]); }
double Footprint::down_length() const { return std::hypot(down[0], down[1]); }

double Footprint::narrow() const {
  // Singular values of a 2×2 matrix: σ₁σ₂ = |det|, σ₁² + σ₂² = ‖·‖².
  const double determinant = std::fabs(right[0] * down[1] - right[1] * down[0]);
  const double sum = right[0] * right[0] + right[1] * right[1] + down[0] * down[0] + down[1] * down[1];
  const double difference = std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant));
  const double larger = std::sqrt(0.5 * (sum + difference));
  return larger > 0 ? determinant / larger : 0;
}

Footprint footprint_at(const Map& source, const Map& target, const Matrix3& to_source, int chart, double x,
                       double y) {
  // Half a texel to each side of the place, on the sphere.
  const auto step = [](const sphere::AnyParameterization& p, int c, double u, double v, double du, double dv) {
    return p.to_sphere(c, u + du, v + dv) - p.to_sphere(c, u - du, v - dv);
  };
  const auto& t = target.parameterization;
  const double u = x / target.width(), v = y / target.height();
  const double du = 0.5 / target.width(), dv = 0.5 / target.height();
  const Vec3d right = to_source * step(t, chart, u, v, du, 0);
  const Vec3d down = to_source * step(t, chart, u, v, 0, dv);

  const auto& s = source.parameterization;
  const auto place = s.from_sphere(to_source * t.to_sphere(chart, u, v));
  const int source_chart = static_cast<int>(place.chart);
  const double su = 0.5 / source.width(), sv = 0.5 / source.height();
  const Vec3d texel_right = step(s, source_chart, place.u, place.v, su, 0);
  const Vec3d texel_down = step(s, source_chart, place.u, place.v, 0, sv);

  // Least squares: texel_right·a + texel_down·b ≈ step. At a pole one of the two vanishes; the small term keeps it finite.
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

struct Planner {
  const Map& source;
  const Map& target;
  const Matrix3& to_source;
  int chart;
  std::vector<FootprintTile>& tiles;

  Footprint at(double x, double y) const { return footprint_at(source, target, to_source, chart, x, y); }

  void plan(int x, int y, int width, int height) {
    const Footprint corners[5] = {at(x, y), at(x + width, y), at(x, y + height), at(x + width, y + height),
                                  at(x + 0.5 * width, y + 0.5 * height)};
    double longest = 0, shortest = 1e300, narrowest = 1e300, right = 0, down = 0;
    for (const Footprint& each : corners) {
      const double r = each.right_length(), d = each.down_length();
      longest = std::max({longest, r, d});
      shortest = std::min(shortest, std::max(r, d));
      narrowest = std::min(narrowest, each.narrow());
      right = std::max(right, r);
      down = std::max(down, d);
    }
    // Split where the footprint changes: near poles and the rims of discs.
    if (longest > 1 && longest > 1.5 * shortest && width * height > 4) {
      const int w = (width + 1) / 2, h = (height + 1) / 2;
      plan(x, y, w, h);
      if (w < width) plan(x + w, y, width - w, h);
      if (h < height) plan(x, y + h, w, height - h);
      if (w < width && h < height) plan(x + w, y + h, width - w, height - h);
      return;
    }
    FootprintTile tile{chart, x, y, width, height, 1, 1, 0, false, {}, {}};
    for (int i = 0; i < 4; ++i) {
      tile.spread_right[i] = static_cast<float>(spread(corners[i].right_length()));
      tile.spread_down[i] = static_cast<float>(spread(corners[i].down_length()));
    }
    // One sample per texel of the level, along each axis.
    const auto samples = [&](double texels) {
      return static_cast<int>(std::ceil(std::min(spread(texels) * texels / std::exp2(tile.level), 1e4)));
    };
    const int most_levels = 20;
    tile.level = static_cast<int>(clamp(std::floor(std::log2(narrowest / kTexelsAcross + 1e-300)), 0.0, 20.0));
    while (tile.level < most_levels && samples(right) * static_cast<long>(samples(down)) > kMostSamples) ++tile.level;
    double least_spread = 1;
    for (int i = 0; i < 4; ++i) least_spread = std::min<double>({least_spread, tile.spread_right[i], tile.spread_down[i]});
    tile.whole = least_spread >= 1;
    tile.samples_right = std::max(1, samples(right));
    tile.samples_down = std::max(1, samples(down));
    tiles.push_back(tile);
  }
};

}  // namespace

void plan_tiles(const Map& source, const Map& target, const Matrix3& to_source, int chart, int first_row, int rows,
                std::vector<FootprintTile>& tiles) {
  Planner planner{source, target, to_source, chart, tiles};
  for (int x = 0; x < target.width(); x += kTileSide) {
    planner.plan(x, first_row, std::min(kTileSide, target.width() - x), rows);
  }
}

}  // namespace welkin
