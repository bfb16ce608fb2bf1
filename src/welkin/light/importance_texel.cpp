#include "welkin/light/importance_texel.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/light/importance_tables.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::light {
namespace {

using sphere::AnyParameterization;

/// A texel is drawn evenly over (u, v) where its density changes by no more.
constexpr float kEven = 1.25f;

/// Where a cell is looked at, in its own coordinates 0…1: just within its edges, on which rims may run.
constexpr double kPlaces[] = {1e-3, 0.25, 0.5, 0.75, 1 - 1e-3};

/// A cell that a rim cuts, in its own coordinates 0…1. Lines run along one of them, from rim to rim; the
/// other counts them. Assumes that the valid part of a cell is convex.
class CutCell {
 public:
  /// `steps` of bisection find a rim.
  CutCell(const AnyParameterization& p, const ChartCell& cell, bool upright, int steps = 50)
      : p_(p), cell_(cell), upright_(upright), steps_(steps) {}

  PlaceInTexel place(double s, double t) const {
    const Part lines = all_lines();
    const double across = lines.from + lines.length() * (kEnd + (1 - 2 * kEnd) * t);
    const Part line = line_at(across);
    const double part = warp(inset(s)), along = line.from + line.length() * part;
    return {upright_ ? across : along, upright_ ? along : across, density(lines, line, part)};
  }

  double density(double x, double y) const {
    const double across = upright_ ? x : y, along = upright_ ? y : x;
    const Part lines = all_lines();
    const double end = kEnd * (1 - kRounding) * lines.length();
    if (!(across >= lines.from + end && across <= lines.to - end)) return 0;
    const Part line = line_at(across);
    return line.length() > 0 ? density(lines, line, (along - line.from) / line.length()) : 0;
  }

  /// Solid angle over the cell's area in (u, v), within some thousandths.
  double solid_angle() const {
    static const QuadratureRule rule = gauss_legendre(4);
    const Part lines = all_lines();
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double across = lines.from + lines.length() * (0.5 + 0.5 * rule.nodes[i]);
      const Part line = line_at(across);
      const double along = (line.from + line.to) / 2, x = upright_ ? across : along,
                   y = upright_ ? along : across;
      sum += rule.weights[i] / 2 * line.length() *
             p_.solid_angle_density(cell_.chart, cell_.u + x * cell_.width, cell_.v + y * cell_.height);
    }
    return sum * lines.length();
  }

 private:
  struct Part {
    double from, to;
    double length() const { return to - from; }
  };

  bool valid(double along, double across) const {
    const double x = upright_ ? across : along, y = upright_ ? along : across;
    return p_.valid(cell_.chart, cell_.u + x * cell_.width, cell_.v + y * cell_.height);
  }

  /// The part of 0…1 where something holds that holds at one of kPlaces at least.
  template <class Test>
  Part part_where(const Test& holds) const {
    int first = -1, last = -1;
    for (int k = 0; k <= 4; ++k) {
      if (!holds(kPlaces[k])) continue;
      if (first < 0) first = k;
      last = k;
    }
    if (first < 0) return {0, 0};
    const auto rim = [&](double inside, double outside) {
      for (int i = 0; i < steps_; ++i) {
        const double middle = (inside + outside) / 2;
        (holds(middle) ? inside : outside) = middle;
      }
      return inside;
    };
    return {first > 0  ? rim(kPlaces[first], kPlaces[first - 1])
            : holds(0) ? 0
                       : rim(kPlaces[0], 0),
            last < 4   ? rim(kPlaces[last], kPlaces[last + 1])
            : holds(1) ? 1
                       : rim(kPlaces[4], 1)};
  }

  Part all_lines() const {
    return part_where([&](double across) {
      for (const double along : kPlaces) {
        if (valid(along, across)) return true;
      }
      return false;
    });
  }
  Part line_at(double across) const {
    return part_where([&](double along) { return valid(along, across); });
  }

  /// What is left out at either end, and how far rounding may move a place there.
  static constexpr double kEnd = 1e-5, kRounding = 1e-6;
  /// Half of the numbers evenly, half as 1/√(x(1 − x)), for a parameterization's density may grow like that
  /// towards a rim: neither part of the line is then drawn much too seldom. Angles of the ends.
  static constexpr double kFirst = 1e-3, kTurn = kPi / 2 - 2 * kFirst;
  static double first_place() { return sin(kFirst) * sin(kFirst); }
  static double warp(double s) {
    if (s < 0.5) return first_place() + 2 * s * (1 - 2 * first_place());
    const double sine = sin(kFirst + kTurn * (2 * s - 1));
    return sine * sine;
  }
  static double density(const Part& lines, const Part& line, double part) {
    const double distance = std::min(part, 1 - part), area = lines.length() * line.length();
    if (!(distance >= first_place() * (1 - 1e-3)) || !(area > 0)) return 0;
    const double along = 0.5 / (1 - 2 * first_place()) + 0.25 / (kTurn * sqrt(distance * (1 - distance)));
    return along / (area * (1 - 2 * kEnd));
  }

  const AnyParameterization& p_;
  ChartCell cell_;
  bool upright_;
  int steps_;
};

/// What a cell is, by 5×5 positions.
struct CellKind {
  double solid_angle;  ///< over its area
  bool cut, upright;
};

CellKind kind_of(const AnyParameterization& p, const ChartCell& cell) {
  const auto valid = [&](double x, double y) {
    return p.valid(cell.chart, cell.u + x * cell.width, cell.v + y * cell.height);
  };
  bool whole = true;
  if (!p.full_charts()) {
    // Lines run so that as many as possible cross the valid part.
    int count = 0, rows = 0, columns = 0;
    for (const double a : kPlaces) {
      bool in_row = false, in_column = false;
      for (const double b : kPlaces) {
        count += valid(b, a) ? 1 : 0;
        in_row |= valid(b, a);
        in_column |= valid(a, b);
      }
      rows += in_row ? 1 : 0;
      columns += in_column ? 1 : 0;
    }
    if (count == 0) return {0, false, false};
    whole = count == 25 && valid(0, 0) && valid(1, 0) && valid(0, 1) && valid(1, 1);
    if (!whole) {
      const bool upright = columns > rows;
      const double sum = CutCell(p, cell, upright, 20).solid_angle();
      return {sum > 0 && std::isfinite(sum) ? sum : 0, true, upright};
    }
  }
  double sum = 0;
  for (int k = 0; k < 4; ++k)
    sum += p.solid_angle_density(cell.chart, cell.u + kGauss[k % 2] * cell.width,
                                 cell.v + kGauss[k / 2] * cell.height);
  return {sum > 0 && std::isfinite(sum) ? sum / 4 : 0, false, false};
}

struct Chosen {
  std::size_t index;
  double rest;
};

template <class Sums>
Chosen choose(const Sums& sums, double u) {
  double from = 0;
  for (std::size_t i = 0;; ++i) {
    const double to = static_cast<double>(sums[i]);
    if (u < to || i + 1 == sums.size()) return {i, std::min((u - from) / (to - from), kBelowOne)};
    from = to;
  }
}

template <class Sums>
double probability(const Sums& sums, std::size_t i) {
  return static_cast<double>(sums[i]) - (i == 0 ? 0.0 : static_cast<double>(sums[i - 1]));
}

/// Cumulative, the last exactly 1. Returns the sum.
template <class Sums>
double accumulate(const double* values, Sums& sums) {
  double sum = 0, so_far = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) sum += values[i];
  for (std::size_t i = 0; i < sums.size(); ++i) {
    so_far += values[i];
    sums[i] = sum > 0 ? static_cast<float>(so_far / sum) : 0.0f;
  }
  return sum;
}

}  // namespace

TexelPattern::TexelPattern(const MapFrame& frame, int chart, int x, int y) {
  const ChartCell texel = texel_cell(frame.size, chart, x, y);
  double of_rows[kSide];
  for (std::size_t row = 0; row < kSide; ++row) {
    double of_cells[kSide];
    for (std::size_t column = 0; column < kSide; ++column) {
      const CellKind kind = kind_of(
          frame.parameterization, texel.part(static_cast<int>(column), kSide, static_cast<int>(row), kSide));
      of_cells[column] = kind.solid_angle;
      const std::uint64_t bit = std::uint64_t{1} << (row * kSide + column);
      if (kind.cut) cut_ |= bit;
      if (kind.upright) upright_ |= bit;
    }
    of_rows[row] = accumulate(of_cells, columns_[row]);
  }
  accumulate(of_rows, rows_);
}

double TexelPattern::evenness(std::size_t column, std::size_t row) const {
  return probability(rows_, row) * probability(columns_[row], column) * (kSide * kSide);
}

PlaceInTexel TexelPattern::place(const MapFrame& frame, int chart, int x, int y, double s, double t) const {
  const Chosen row = choose(rows_, t);
  const Chosen column = choose(columns_[row.index], s);
  PlaceInTexel place{inset(column.rest), inset(row.rest), 1};
  if (is_cut(column.index, row.index)) {
    const ChartCell cell =
        texel_cell(frame.size, chart, x, y)
            .part(static_cast<int>(column.index), kSide, static_cast<int>(row.index), kSide);
    place = CutCell(frame.parameterization, cell, is_upright(column.index, row.index))
                .place(column.rest, row.rest);
  }
  return {(static_cast<double>(column.index) + place.x) / kSide,
          (static_cast<double>(row.index) + place.y) / kSide,
          place.density * evenness(column.index, row.index)};
}

double TexelPattern::density(const MapFrame& frame, int chart, int x, int y, double across,
                             double down) const {
  const std::size_t column = std::min(static_cast<std::size_t>(across * kSide), kSide - 1);
  const std::size_t row = std::min(static_cast<std::size_t>(down * kSide), kSide - 1);
  const double even = evenness(column, row);
  if (even == 0 || !is_cut(column, row)) return even;
  const ChartCell cell =
      texel_cell(frame.size, chart, x, y).part(static_cast<int>(column), kSide, static_cast<int>(row), kSide);
  return even *
         CutCell(frame.parameterization, cell, is_upright(column, row))
             .density(across * kSide - static_cast<double>(column), down * kSide - static_cast<double>(row));
}

namespace {

/// Finds the texels of a row that can't be drawn evenly: by the density and the validity at their corners and
/// centres.
class UnevenTexels {
 public:
  explicit UnevenTexels(const MapFrame& frame)
      : p_(frame.parameterization), size_(frame.size), full_(p_.full_charts()) {
    const std::size_t room = sphere::padded(static_cast<std::size_t>(size_.width) + 1);
    for (std::vector<float>* each : {&u_, &v_, &density_, &valid_}) each->resize(room);
    const std::size_t texels = static_cast<std::size_t>(size_.width);
    for (std::vector<float>* each : {&least_, &most_, &count_}) each->resize(texels);
  }

  /// 1 for those.
  std::vector<char> of_row(int chart, int y) {
    std::fill(least_.begin(), least_.end(), 3e38f);
    std::fill(most_.begin(), most_.end(), 0.0f);
    std::fill(count_.begin(), count_.end(), 0.0f);
    for (const int down : {0, 1}) {
      at_positions(chart, 0, static_cast<float>(y + down));
      for (std::size_t i = 0; i < least_.size(); ++i) {
        for (const std::size_t corner : {i, i + 1}) take(i, corner);
      }
    }
    at_positions(chart, 0.5f, static_cast<float>(y) + 0.5f);
    for (std::size_t i = 0; i < least_.size(); ++i) take(i, i);
    std::vector<char> uneven(least_.size());
    for (std::size_t i = 0; i < uneven.size(); ++i)
      uneven[i] = most_[i] <= kEven * least_[i] && (full_ || count_[i] == 5) ? 0 : 1;
    return uneven;
  }

 private:
  void at_positions(int chart, float across, float down) {
    const std::size_t count = static_cast<std::size_t>(size_.width) + 1;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      u_[i] = std::min((static_cast<float>(i) + across) / static_cast<float>(size_.width), 1.0f);
      v_[i] = down / static_cast<float>(size_.height);
    }
    p_.kernels().density(p_.self(), chart, u_.data(), v_.data(), density_.data(), count);
    if (!full_) p_.kernels().valid(p_.self(), chart, u_.data(), v_.data(), valid_.data(), count);
  }
  /// NaN makes a texel uneven.
  void take(std::size_t texel, std::size_t at) {
    const float density = density_[at];
    if (!(density >= least_[texel])) least_[texel] = density == density ? density : -1;
    if (density > most_[texel]) most_[texel] = density;
    if (!full_) count_[texel] += valid_[at];
  }

  const AnyParameterization& p_;
  ChartSize size_;
  bool full_;
  std::vector<float> u_, v_, density_, valid_, least_, most_, count_;
};

}  // namespace

TexelPatterns::TexelPatterns(const MapFrame& frame, std::vector<float>& solid_angles, const Monitor& monitor)
    : width_(static_cast<std::uint32_t>(frame.size.width)),
      by_row_(frame.parameterization.full_charts() && frame.parameterization.density_by_row()) {
  const std::size_t rows = solid_angles.size() / width_;
  struct RowPatterns {
    std::vector<std::uint32_t> columns;
    std::vector<TexelPattern> patterns;
  };
  std::vector<RowPatterns> found(rows);
  parallel_for(
      static_cast<int>(rows),
      [&](int r) {
        const int chart = r / frame.size.height, y = r % frame.size.height;
        RowPatterns& row = found[static_cast<std::size_t>(r)];
        float* omega = &solid_angles[static_cast<std::size_t>(r) * width_];
        const std::vector<char> uneven = UnevenTexels(frame).of_row(chart, y);
        for (std::uint32_t x = 0; x < (by_row_ ? 1 : width_); ++x) {
          if (uneven[x] == 0 || !(omega[x] > 0)) continue;
          row.columns.push_back(x);
          row.patterns.emplace_back(frame, chart, static_cast<int>(x), y);
          if (row.patterns.back().empty()) omega[x] = 0;
        }
      },
      monitor);

  words_.resize((by_row_ ? rows : solid_angles.size()) / 64 + 1);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t i = 0; i < found[r].columns.size(); ++i) {
      const std::size_t bit = by_row_ ? r : r * width_ + found[r].columns[i];
      words_[bit / 64].bits |= std::uint64_t{1} << bit % 64;
      patterns_.push_back(found[r].patterns[i]);
    }
    found[r] = {};
  }
  std::size_t before = 0;
  for (Word& word : words_) {
    word.before = before;
    before += static_cast<std::size_t>(std::popcount(word.bits));
  }
}

}  // namespace welkin::light
