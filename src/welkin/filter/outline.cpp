#include "welkin/filter/outline.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// Texel edges are traced a little inside of where they are, all by the same: exactly on the edge of a chart
/// of the source, where aligned maps have them, rounding would decide on which side they lie.
constexpr double kAside = 7.3e-5;
/// The same at the edges of the target's charts, where no neighbour has what is left out: a pole's whole
/// light may lie within a thousandth of an equal-area map's first row.
constexpr double kAsideOfChart = 1e-9;
/// The same at the target's rim, which may lie on a fold or an edge of the source.
constexpr double kAsideOfRim = 1e-12;
/// Of what an outline is divided into, where it can be followed: one that lies along an edge changes charts
/// with every step.
constexpr std::size_t kMostRuns = 256;
constexpr int kMostPositions = 1 << 17;
/// Deviation of a chord from its curve, texels.
constexpr double kFlat = 0.001;
/// The same along a rim: no neighbour has what a chord cuts off.
constexpr double kFlatRim = 0.0003;
/// Of chords deeper than kDepth, texels or of the chart: beside a pole, on a rim where directions hardly
/// change with positions, rounding bends them.
constexpr double kFlatDeep = 0.01, kFlatDeepOfChart = 3e-6;
/// Of an edge, before what is left of it counts as a jump from one chart to the next, or to elsewhere in one:
/// there it may grow as a root does, or pass a pole.
constexpr int kDepth = 13, kDepthWithinAChart = 36;

double line(int index, int count) {
  if (index == 0) return kAsideOfChart / count;
  if (index == count) return 1 - kAsideOfChart / count;
  return (index + kAside) / count;
}

/// +1 where u, v and the direction make a right-handed frame.
double turn_of(const AnyParameterization& p, int chart) {
  constexpr double kStep = 1e-4;
  for (const double at : {0.5, 0.45, 0.4}) {
    const Vec3d d = p.to_sphere(chart, at, at + 0.01);
    const Vec3d right = p.to_sphere(chart, at + kStep, at + 0.01) - d,
                down = p.to_sphere(chart, at, at + 0.01 + kStep) - d;
    const double volume = dot(cross(right, down), d);
    if (std::fabs(volume) > 1e-12) return volume > 0 ? 1 : -1;
  }
  return 1;
}

std::vector<double> turns_of(const AnyParameterization& p) {
  std::vector<double> turns;
  for (int chart = 0; chart < p.charts(); ++chart) turns.push_back(turn_of(p, chart));
  return turns;
}

/// Whether a position of a chart is valid and shows no direction that lies elsewhere: maps whose texels'
/// centres lie on an edge or pole are valid a little beyond it.
bool is_inside(const AnyParameterization& p, int chart, double u, double v) {
  if (!p.valid(chart, u, v)) return false;
  constexpr double kElsewhere = 1e-6;
  const auto at = p.from_sphere(p.to_sphere(chart, u, v));
  return static_cast<int>(at.chart) == chart && std::fabs(at.u - u) < kElsewhere &&
         std::fabs(at.v - v) < kElsewhere;
}

/// How far from the middle positions are valid along a line of constant v (or u).
double valid_until(const AnyParameterization& p, bool along_u, double end) {
  const auto valid = [&](double t) { return along_u ? p.valid(0, t, 0.5) : p.valid(0, 0.5, t); };
  if (valid(end)) return end;
  double inside = 0.5, outside = end;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    (valid(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

Outline::Outline(const AnyParameterization& source, ChartSize source_size, const MapFrame& target,
                 const Matrix3& to_source)
    : source_(source),
      target_(target),
      to_source_(to_source),
      width_(source_size.width),
      height_(source_size.height),
      left_(valid_until(source, true, 0) * width_),
      right_(valid_until(source, true, 1) * width_),
      top_(valid_until(source, false, 0) * height_),
      bottom_(valid_until(source, false, 1) * height_),
      rectangle_(source.full_charts()),
      target_full_(target.parameterization.full_charts()),
      turn_(turns_of(source)),
      target_turn_(turns_of(target.parameterization)) {
  if (determinant(to_source_) < 0) {
    for (double& turn : turn_) turn = -turn;
  }
  if (!rectangle_) {
    const double inside_x = 1e-6 * width_, inside_y = 1e-6 * height_;
    rectangle_ = true;
    for (const double x : {left_ + inside_x, right_ - inside_x}) {
      for (const double y : {top_ + inside_y, bottom_ - inside_y})
        rectangle_ = rectangle_ && source.valid(0, x / width_, y / height_);
    }
  }
}

Outline::Position Outline::locate(int chart, double u, double v) const {
  const Vec3d direction = to_source_ * target_.parameterization.to_sphere(chart, u, v);
  const auto position = source_.from_sphere(direction);
  return {u,
          v,
          static_cast<int>(position.chart),
          position.u * width_,
          position.v * height_,
          source_.covers(direction)};
}

bool Outline::follow(int chart, const Position& from, const Position& to, bool on_rim, int depth,
                     Followed& followed) const {
  auto& runs = followed.runs;
  if (runs.size() > kMostRuns || ++followed.positions > kMostPositions) return false;
  const TargetPoint between =
      on_rim ? rim_between(chart, from, to) : TargetPoint{0.5 * (from.u + to.u), 0.5 * (from.v + to.v)};
  const Position middle = locate(chart, between.u, between.v);
  if (!middle.shown) return false;
  const bool one_chart = from.chart == to.chart && middle.chart == from.chart;
  // Away from the chord, and uneven along it where that is more than a few texels long.
  const double away_x = middle.x - 0.5 * (from.x + to.x), away_y = middle.y - 0.5 * (from.y + to.y);
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double tolerance = depth > kDepth ? std::max(kFlatDeep, kFlatDeepOfChart * std::max(width_, height_))
                                          : (on_rim ? kFlatRim : kFlat);
  const bool flat = std::max(std::fabs(away_x), std::fabs(away_y)) < tolerance &&
                    length < 0.2 * std::min(width_, height_) + 2;
  if (one_chart && flat) {
    runs.back().points.push_back({to.x, to.y});
    return true;
  }
  const double apart = std::max(std::fabs(to.x - from.x), std::fabs(to.y - from.y));
  if (depth >= (one_chart ? kDepthWithinAChart : kDepth)) {
    if (from.chart != to.chart || apart > 1e-3) runs.push_back({to.chart, {}});
    runs.back().points.push_back({to.x, to.y});
    return true;
  }
  return follow(chart, from, middle, on_rim, depth + 1, followed) &&
         follow(chart, middle, to, on_rim, depth + 1, followed);
}

/// Positions on the chart's edge from its top left corner on, clockwise, 0…4.
double Outline::along_edge(const OutlinePoint& point) const {
  const double across = (point.x - left_) / (right_ - left_), down = (point.y - top_) / (bottom_ - top_);
  const double from[4] = {std::fabs(down), std::fabs(1 - across), std::fabs(1 - down), std::fabs(across)};
  const double at[4] = {across, down, 1 - across, 1 - down};
  const auto side = std::min_element(std::begin(from), std::end(from)) - std::begin(from);
  return static_cast<double>(side) + std::clamp(at[side], 0.0, 1.0);
}

void Outline::add_corners(double from, double length, std::vector<OutlinePoint>& points) const {
  const OutlinePoint corners[4] = {{left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}};
  if (length >= 0) {
    for (int k = static_cast<int>(std::floor(from)) + 1; k < from + length; ++k)
      points.push_back(corners[k & 3]);
  } else {
    for (int k = static_cast<int>(std::ceil(from)) - 1; k > from + length; --k)
      points.push_back(corners[k & 3]);
  }
}

Outline::TargetPoint Outline::rim_between(int chart, const Position& from, const Position& to) const {
  const double width = target_.size.width, height = target_.size.height;
  const double right = (to.u - from.u) * width, down = (to.v - from.v) * height;
  const double chord = std::hypot(right, down);
  const TargetPoint middle{0.5 * (from.u + to.u), 0.5 * (from.v + to.v)};
  if (!(chord > 0)) return middle;
  const auto at = [&](double away) {
    return TargetPoint{middle.u + away * down / chord / width, middle.v - away * right / chord / height};
  };
  double inside = 0, outside = chord;
  for (int i = 0; i < 50 && outside > 1e-15; ++i) {
    const double away = 0.5 * (inside + outside);
    const TargetPoint point = at(away);
    (is_inside(target_.parameterization, chart, point.u, point.v) ? inside : outside) = away;
  }
  return at(std::max(0.0, inside - kAsideOfRim * std::min(width, height)));
}

bool Outline::clip_to_rim(int chart, std::vector<TargetPoint>& ring, bool& has_rim) const {
  const auto& p = target_.parameterization;
  const std::size_t count = ring.size();
  std::vector<bool> valid(count);
  for (std::size_t i = 0; i < count; ++i) valid[i] = is_inside(p, chart, ring[i].u, ring[i].v);
  std::size_t first = count, entries = 0;
  const auto find_entries = [&] {
    entries = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (valid[i] || !valid[(i + 1) % count]) continue;
      first = i;
      ++entries;
    }
  };
  find_entries();
  if (entries > 1) {
    // Where the rim only just touches an edge.
    for (std::size_t i = 0; i < count; ++i) {
      if (i % (count / 4) != 0 && !valid[(i + 1) % count] && !valid[(i + count - 1) % count])
        valid[i] = false;
    }
    find_entries();
  }
  if (entries == 0) return valid[0];
  if (entries > 1) return false;
  const auto rim = [&](TargetPoint inside, TargetPoint outside) {
    for (int i = 0; i < 50; ++i) {
      const TargetPoint middle{0.5 * (inside.u + outside.u), 0.5 * (inside.v + outside.v)};
      (is_inside(p, chart, middle.u, middle.v) ? inside : outside) = middle;
    }
    return inside;
  };
  std::vector<TargetPoint> clipped{rim(ring[(first + 1) % count], ring[first])};
  std::size_t i = (first + 1) % count;
  for (; valid[i]; i = (i + 1) % count) clipped.push_back(ring[i]);
  clipped.push_back(rim(clipped.back(), ring[i]));
  // Towards the middle: along the edge it might be along the rim.
  TargetPoint middle{0, 0};
  for (const TargetPoint& point : clipped) {
    middle.u += point.u / static_cast<double>(clipped.size());
    middle.v += point.v / static_cast<double>(clipped.size());
  }
  for (TargetPoint* const end : {&clipped.front(), &clipped.back()}) {
    const double right = middle.u - end->u, down = middle.v - end->v, away = std::hypot(right, down);
    const double part = std::min(1.0, kAsideOfRim / away);
    if (away > 0) *end = {end->u + part * right, end->v + part * down};
  }
  ring = std::move(clipped);
  has_rim = true;
  return true;
}

bool Outline::trace(int chart, int x, int y, std::vector<OutlineLoop>& loops) const {
  loops.clear();
  const double u[2] = {line(x, target_.size.width), line(x + 1, target_.size.width)},
               v[2] = {line(y, target_.size.height), line(y + 1, target_.size.height)};
  // Of an edge; more where a rim may cross it.
  const int steps = target_full_ ? 2 : 8;
  // Clockwise. Both texels at an edge divide it at the same positions.
  std::vector<TargetPoint> ring;
  for (int edge = 0; edge < 4; ++edge) {
    for (int step = 0; step < steps; ++step) {
      const double t = static_cast<double>(step) / steps, s = edge < 2 ? t : 1 - t;
      const double across = u[0] + s * (u[1] - u[0]), down = v[0] + s * (v[1] - v[0]);
      const bool right = edge == 0 || edge == 2;
      ring.push_back(right ? TargetPoint{across, edge == 0 ? v[0] : v[1]}
                           : TargetPoint{edge == 1 ? u[1] : u[0], down});
    }
  }
  bool has_rim = false;
  if (!target_full_ && !clip_to_rim(chart, ring, has_rim)) return false;
  Followed followed{std::vector<Run>(1)};
  auto& runs = followed.runs;
  const Position start = locate(chart, ring[0].u, ring[0].v);
  if (!start.shown) return false;
  runs[0] = {start.chart, {{start.x, start.y}}};
  Position at = start;
  for (std::size_t i = 1; i <= ring.size(); ++i) {
    const Position next = i == ring.size() ? start : locate(chart, ring[i].u, ring[i].v);
    const bool on_rim = has_rim && i == ring.size();
    if (!next.shown || !follow(chart, at, next, on_rim, 0, followed)) return false;
    at = next;
  }
  // The last run goes on in the first, at the corner that both have.
  const bool whole = runs.size() == 1;
  if (!whole) {
    Run& first = runs.front();
    const Run& last = runs.back();
    first.points.insert(first.points.begin(), last.points.begin(), last.points.end() - 1);
    runs.pop_back();
  }
  const auto turn = [&](int source_chart) {
    return turn_[static_cast<std::size_t>(source_chart)] * target_turn_[static_cast<std::size_t>(chart)];
  };
  if (whole) {
    // Around the outside of a disc, all of whose rim is one direction, it turns the other way.
    double area = 0;
    const auto& p = runs[0].points;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) area += p[i].x * p[i + 1].y - p[i + 1].x * p[i].y;
    if (area * turn(runs[0].chart) < 0) return false;
    loops.push_back({runs[0].chart, std::move(runs[0].points)});
    return true;
  }
  if (!rectangle_) return false;

  // Runs end on the edge of the chart, and its edge leads on to the next: clockwise or against it, as the
  // outline itself turns there.
  std::vector<bool> used(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (used[i]) continue;
    OutlineLoop loop{runs[i].chart, {}};
    const double direction = turn(loop.chart);
    std::size_t now = i;
    do {
      used[now] = true;
      loop.points.insert(loop.points.end(), runs[now].points.begin(), runs[now].points.end());
      const double end = along_edge(runs[now].points.back());
      std::size_t next = i;
      double shortest = 5;
      for (std::size_t k = 0; k < runs.size(); ++k) {
        if (runs[k].chart != loop.chart || (used[k] && k != i)) continue;
        double length = direction * (along_edge(runs[k].points.front()) - end);
        length -= 4 * std::floor(length / 4);
        // All the way round is where it began.
        if (length > 3.99) length = 0;
        if (length < shortest) {
          shortest = length;
          next = k;
        }
      }
      if (shortest > 3.5) return false;
      add_corners(end, direction * shortest, loop.points);
      now = next;
    } while (now != i);
    loops.push_back(std::move(loop));
  }
  return true;
}

}  // namespace welkin
