#include "welkin/render/project/texel_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/map/texel_points.h"

namespace welkin::scene {
namespace {

constexpr std::int64_t kMostWeights = 1 << 22;
/// Pieces of a texel's side, away from the lobe's axis and at most.
constexpr int kFewParts = 2, kMostParts = 16;

std::int64_t texels_of(const sphere::AnyParameterization& p, ChartSize size) {
  return static_cast<std::int64_t>(p.charts()) * size.width * size.height;
}

/// Points of the texels, `parts`² · 4 of each, whose solid angles add up to the texel's.
struct Points {
  std::size_t per_texel;
  std::vector<TexelPoint> points;
};

Points points_of(const sphere::AnyParameterization& p, ChartSize size, int parts) {
  Points made{static_cast<std::size_t>(4 * parts * parts), {}};
  std::vector<float> angles(static_cast<std::size_t>(size.width));
  for (int chart = 0; chart < p.charts(); ++chart) {
    for (int y = 0; y < size.height; ++y) {
      texel_solid_angles(p, size.width, size.height, chart, y, angles.data());
      for (int x = 0; x < size.width; ++x) {
        const ChartCell cell = texel_cell(size, chart, x, y);
        const std::size_t first = made.points.size();
        for (int j = 0; j < parts; ++j)
          for (int i = 0; i < parts; ++i) append_gauss_points(p, cell.part(i, parts, j, parts), made.points);
        double sum = 0;
        for (std::size_t k = first; k < made.points.size(); ++k) sum += made.points[k].solid_angle;
        const double scale = sum > 0 ? static_cast<double>(angles[static_cast<std::size_t>(x)]) / sum : 0;
        for (std::size_t k = first; k < made.points.size(); ++k) made.points[k].solid_angle *= scale;
      }
    }
  }
  return made;
}

}  // namespace

std::optional<TexelMatrix> TexelMatrix::make(const sphere::AnyParameterization& parameterization,
                                             ChartSize from, ChartSize to, const lobe::AnyLobe& lobe) {
  if (lobe.is_mirror() || !parameterization.full_charts() ||
      texels_of(parameterization, from) * texels_of(parameterization, to) > kMostWeights)
    return std::nullopt;
  const double parts = std::ceil(4 * mean_texel(parameterization, from) / lobe.width());
  if (!(parts <= kMostParts)) return std::nullopt;
  return TexelMatrix(parameterization, from, to, lobe, std::max(kFewParts, static_cast<int>(parts)));
}

TexelMatrix::TexelMatrix(const sphere::AnyParameterization& parameterization, ChartSize from, ChartSize to,
                         const lobe::AnyLobe& lobe, int parts)
    : parameterization_(parameterization), from_(from), to_(to) {
  const auto sources = static_cast<std::size_t>(texels_of(parameterization, from)),
             targets = static_cast<std::size_t>(texels_of(parameterization, to));
  const Points coarse = points_of(parameterization, from, kFewParts),
               fine = points_of(parameterization, from, parts);
  const double texel = mean_texel(parameterization, from), near = 4 * texel + 2 * lobe.width();
  weights_.resize(sources * targets);
  parallel_for(static_cast<int>(targets), [&](int index) {
    const auto t = static_cast<std::size_t>(index);
    const int x = index % to_.width, y = index / to_.width % to_.height,
              chart = index / to_.width / to_.height;
    const Vec3d axis = parameterization_.to_sphere(chart, (x + 0.5) / to_.width, (y + 0.5) / to_.height);
    std::vector<double> s, w(fine.per_texel), row(sources);
    double whole = 0;
    for (std::size_t k = 0; k < sources; ++k) {
      const Vec3d to_texel = coarse.points[k * coarse.per_texel].direction - axis;
      const Points& from_points = dot(to_texel, to_texel) < near * near ? fine : coarse;
      const TexelPoint* points = from_points.points.data() + k * from_points.per_texel;
      s.resize(from_points.per_texel);
      for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3d difference = points[i].direction - axis;
        s[i] = std::min(2.0, dot(difference, difference) / 2);
      }
      lobe.weights64(s.data(), w.data(), s.size());
      for (std::size_t i = 0; i < s.size(); ++i) row[k] += w[i] * points[i].solid_angle;
      whole += row[k];
    }
    for (std::size_t k = 0; k < sources; ++k) weights_[k * targets + t] = static_cast<float>(row[k] / whole);
  });
}

Map TexelMatrix::apply(const Map& source) const {
  assert(source.width() == from_.width && source.height() == from_.height);
  const int channels = source.channels();
  Map level(parameterization_, to_.width, to_.height, channels);
  level.orientation = source.orientation;
  const auto targets = static_cast<std::size_t>(texels_of(parameterization_, to_));
  // Channel by channel, and four texels at once: sums are loaded and stored less often.
  const auto sources = weights_.size() / targets;
  std::vector<float> values(sources * static_cast<std::size_t>(channels)),
      sums(targets * static_cast<std::size_t>(channels));
  std::size_t source_texel = 0;
  for (int chart = 0; chart < source.charts(); ++chart)
    for (int y = 0; y < from_.height; ++y)
      for (int x = 0; x < from_.width; ++x, ++source_texel)
        for (int c = 0; c < channels; ++c)
          values[static_cast<std::size_t>(c) * sources + source_texel] =
              source.level.chart(chart).at(x, y)[c];
  for (std::size_t k = 0; k < sources; k += 4) {
    const std::size_t count = std::min<std::size_t>(4, sources - k);
    const float* w = weights_.data() + k * targets;
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      float* to = sums.data() + c * targets;
      const float* v = values.data() + c * sources + k;
      if (count == 4) {
        const float v0 = v[0], v1 = v[1], v2 = v[2], v3 = v[3];
        for (std::size_t t = 0; t < targets; ++t)
          to[t] += (w[t] * v0 + w[targets + t] * v1) + (w[2 * targets + t] * v2 + w[3 * targets + t] * v3);
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t t = 0; t < targets; ++t) to[t] += w[i * targets + t] * v[i];
    }
  }
  std::size_t t = 0;
  for (int chart = 0; chart < level.charts(); ++chart)
    for (int y = 0; y < to_.height; ++y)
      for (int x = 0; x < to_.width; ++x, ++t)
        for (int c = 0; c < channels; ++c)
          level.level.chart(chart).at(x, y)[c] = sums[static_cast<std::size_t>(c) * targets + t];
  fill_borders(level);
  return level;
}

}  // namespace welkin::scene
