#include "welkin/light/light_form.h"

#include <algorithm>
#include <cmath>

#include "welkin/light/ellipse_fit.h"

namespace welkin {
namespace {

/// A symmetric matrix of 2×2.
struct Moments {
  double xx = 0, xy = 0, yy = 0;
};

/// Half axes of the even ellipse with these second moments (σ² = a²/4), and the angle of the longer.
FittedEllipse ellipse_of(const Moments& m) {
  const double mean = (m.xx + m.yy) / 2, half = (m.xx - m.yy) / 2, spread = std::hypot(half, m.xy);
  FittedEllipse ellipse;
  ellipse.a = 2 * std::sqrt(std::max(mean + spread, 0.0));
  ellipse.b = 2 * std::sqrt(std::max(mean - spread, 0.0));
  ellipse.angle = std::atan2(m.xy, half) / 2;
  return ellipse;
}

/// An ellipse is said to be one from this ratio of its axes on.
constexpr double kElongated = 1.15;

/// Up to so many texels, and texels across, the ellipse is fitted to texels.
constexpr std::size_t kFittedCells = 600, kFewCells = 80;
constexpr double kFittedAcross = 12;

class FormFinder {
 public:
  FormFinder(const Map& map, const std::vector<LitTexel>& texels)
      : map_(map), grid_(map), texels_(texels), plane_(centroid()) {
    for (const LitTexel& each : texels_) energy_ += each.excess * each.solid_angle;
    for (const Cell& each : cells()) side_ += each.sum * each.solid_angle / energy_;
    side_ = std::sqrt(side_);
  }

  LightForm find() const {
    const FittedEllipse moments = ellipse_of(second_moments());
    const std::vector<Cell> merged = cells();
    if (merged.size() > kFittedCells || 2 * moments.a > kFittedAcross * side_) return form_of(moments);
    return fitted(moments, merged);
  }

 private:
  Vec3d centroid() const {
    Vec3d sum{0, 0, 0};
    for (const LitTexel& each : texels_) sum = sum + each.excess * each.solid_angle * each.direction;
    return length(sum) > 0 ? normalize(sum) : texels_.front().direction;
  }

  Vec3d direction_at(TexelGrid::Index texel, double across, double down) const {
    const auto [chart, x, y] = grid_.place(texel);
    return map_.parameterization.to_sphere(chart, (x + across) / map_.width(), (y + down) / map_.height());
  }

  /// About the centre of the plane, where the first moments are 0 but for the plane's curvature. Texels hold
  /// means, and their centres stand for them: Sheppard's correction, 1/12 of a texel's side squared.
  Moments second_moments() const {
    Moments m;
    FitPoint mean{0, 0};
    for (const LitTexel& each : texels_) {
      const double weight = each.excess * each.solid_angle / energy_;
      const FitPoint p = plane_.point(each.direction);
      mean = {mean.x + weight * p.x, mean.y + weight * p.y};
      m = {m.xx + weight * p.x * p.x, m.xy + weight * p.x * p.y, m.yy + weight * p.y * p.y};
      for (const bool along_u : {true, false}) {
        const FitPoint from = plane_.point(direction_at(each.texel, along_u ? 0 : 0.5, along_u ? 0.5 : 0));
        const FitPoint to = plane_.point(direction_at(each.texel, along_u ? 1 : 0.5, along_u ? 0.5 : 1));
        const double x = to.x - from.x, y = to.y - from.y;
        m = {m.xx - weight * x * x / 12, m.xy - weight * x * y / 12, m.yy - weight * y * y / 12};
      }
    }
    return {m.xx - mean.x * mean.x, m.xy - mean.x * mean.y, m.yy - mean.y * mean.y};
  }

  /// Of an ellipse in the plane, which keeps areas.
  LightForm form_of(const FittedEllipse& ellipse) const {
    const double a = std::max(ellipse.a, ellipse.b), b = std::max(std::min(ellipse.a, ellipse.b), 1e-9);
    const double angle = ellipse.a >= ellipse.b ? ellipse.angle : ellipse.angle + kPi / 2;
    LightForm form;
    form.direction = plane_.direction({ellipse.x, ellipse.y});
    form.shape = a > kElongated * b ? LightShape::ellipse : LightShape::disc;
    form.solid_angle = std::min(kPi * a * b, 4 * kPi);
    const double mean = std::sqrt(a * b);
    const auto angular = [](double chord) { return 2 * std::asin(std::min(chord / 2, 1.0)); };
    form.half_axes = form.shape == LightShape::disc ? std::array{angular(mean), angular(mean)}
                                                    : std::array{angular(a), angular(b)};
    const Vec3d along = std::cos(angle) * plane_.right() + std::sin(angle) * plane_.up();
    form.axis = normalize(along - dot(along, form.direction) * form.direction);
    return form;
  }

  /// Texels of a row that lie side by side and together are about square: near a pole they are many.
  struct Cell {
    TexelGrid::Place first{};
    int count = 0;
    double sum = 0, solid_angle = 0;  ///< of excess · solid angle
    double width = 0;                 ///< its longer side, radians
  };
  std::vector<Cell> cells() const {
    std::vector<LitTexel> sorted = texels_;
    std::sort(sorted.begin(), sorted.end(),
              [](const LitTexel& a, const LitTexel& b) { return a.texel < b.texel; });
    std::vector<Cell> cells;
    TexelGrid::Index next = -1;
    int room = 0;
    for (const LitTexel& each : sorted) {
      if (each.texel != next || room == 0 || grid_.place(each.texel).x == 0) {
        cells.push_back({grid_.place(each.texel)});
        const double across = length(direction_at(each.texel, 1, 0.5) - direction_at(each.texel, 0, 0.5));
        const double down = length(direction_at(each.texel, 0.5, 1) - direction_at(each.texel, 0.5, 0));
        room = static_cast<int>(std::clamp(down / std::max(across, 1e-9), 1.0, map_.width() / 12.0 + 1));
        cells.back().width = std::max(down, across);
      }
      Cell& cell = cells.back();
      ++cell.count;
      cell.sum += each.excess * each.solid_angle;
      cell.solid_angle += each.solid_angle;
      next = each.texel + 1;
      --room;
    }
    return cells;
  }

  LightForm fitted(const FittedEllipse& moments, const std::vector<Cell>& cells) const {
    const int parts = cells.size() <= kFewCells ? 10 : 6;
    EllipseFit fit(side_, parts);
    for (const Cell& cell : cells) {
      fit.begin_texel(cell.sum / cell.solid_angle, cell.width);
      for (int k = 0; k < parts * parts; ++k) {
        const double u = (cell.first.x + cell.count * (k % parts + 0.5) / parts) / map_.width(),
                     v = (cell.first.y + (k / parts + 0.5) / parts) / map_.height();
        fit.add_point(plane_.point(map_.parameterization.to_sphere(cell.first.chart, u, v)),
                      std::max(map_.parameterization.solid_angle_density(cell.first.chart, u, v), 1e-12));
      }
    }
    const double radius = std::max(std::sqrt(moments.a * moments.b), 0.5 * side_);
    const EllipseFit::Result disc = fit.disc({0, 0, radius, radius, 0});
    if (const std::optional<FittedEllipse> largest = fit.largest_alike(disc)) {
      LightForm form = form_of(*largest);
      form.direction = plane_.direction({0, 0});
      form.shape = LightShape::point;
      return form;
    }
    EllipseFit::Result best = disc;
    // Few texels that are nearly a disc's are one's, whose rim was sampled coarsely.
    const bool round = moments.a < 2 * side_ && disc.misfit < kRound;
    if (moments.a > kElongated * moments.b && texels_.size() > 8 && !round) {
      FittedEllipse start = moments;
      start.a = std::max(start.a, 0.6 * side_);
      start.b = std::max(start.b, 0.4 * side_);
      const EllipseFit::Result ellipse = fit.ellipse(start);
      if (ellipse.misfit < 0.7 * disc.misfit) best = ellipse;
    }
    // What isn't an even ellipse at all has the moments that it has.
    if (best.misfit > kMisfit) {
      LightForm form = form_of(moments);
      form.direction = plane_.direction({0, 0});
      return form;
    }
    return form_of(best.ellipse);
  }

  /// Σ (texel − fit)² / Σ texel² up to which a fit is believed.
  static constexpr double kMisfit = 0.05;
  /// Up to which a small light is a disc.
  static constexpr double kRound = 0.01;

  const Map& map_;
  const TexelGrid grid_;
  const std::vector<LitTexel>& texels_;
  const LightPlane plane_;
  double energy_ = 0;
  double side_ = 0;  ///< of a texel, or of texels merged to a square, radians
};

}  // namespace

LightForm find_form(const Map& map, const std::vector<LitTexel>& texels) {
  return FormFinder(map, texels).find();
}

}  // namespace welkin
