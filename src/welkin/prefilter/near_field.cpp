#include "welkin/prefilter/near_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "welkin/base/parallel.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/panels.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/gauss_legendre.h"
#include "welkin/math/scalar.h"

namespace welkin::prefilter {
namespace {

/// Positions and weights of Gauss's rule of 16 points in each of `panels` parts of 0 … end.
struct Nodes {
  Nodes(double end, int panels) {
    static const QuadratureRule rule = gauss_legendre(16);
    const double half = end / (2 * panels);
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        position.push_back((2 * panel + 1 + rule.nodes[i]) * half);
        weight.push_back(rule.weights[i] * half);
      }
    }
  }
  std::vector<double> position, weight;
};

/// Σ weight cos(m · position) for m = 0 … last, by Chebyshev's recurrence. Sixteen positions at a time.
std::vector<double> cosine_sums(const std::vector<double>& position, const std::vector<double>& weight,
                                int last) {
  constexpr std::size_t kTogether = 16;
  std::vector<double> sums(static_cast<std::size_t>(last) + 1);
  for (std::size_t first = 0; first < position.size(); first += kTogether) {
    double now[kTogether] = {}, before[kTogether] = {}, twice[kTogether] = {};
    for (std::size_t i = 0; i < kTogether && first + i < position.size(); ++i) {
      const double cosine = std::cos(position[first + i]);
      twice[i] = 2 * cosine;
      now[i] = weight[first + i];
      before[i] = weight[first + i] * cosine;
    }
    for (double& sum : sums) {
      double total[2] = {};
      for (std::size_t i = 0; i < kTogether; i += 2) {
        total[0] += now[i];
        total[1] += now[i + 1];
      }
      sum += total[0] + total[1];
      for (std::size_t i = 0; i < kTogether; ++i) {
        const double next = twice[i] * now[i] - before[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
  }
  return sums;
}

/// How a lobe is split: S = degree²/2X, and the near part ends at s = X/S.
struct Split {
  double exponent, core;  ///< X; c of a lobe (1 + s/c)⁻²
};

/// The near part as a function of s, normalised with the lobe.
class Near {
 public:
  Near(const lobe::AnyLobe& lobe, double scale, int degree, const Split& split)
      : lobe_(lobe),
        scale_(scale),
        core_(split.core),
        sharpness_(static_cast<double>(degree) * degree / (2 * split.exponent)),
        last_(split.exponent / sharpness_) {}
  /// Nothing beyond this s.
  double last() const { return last_; }
  /// What is cut off there: for a lobe that falls as s⁻², s·w·χ lies beyond.
  double beyond() const { return 2 * kPi * last_ * full(last_); }
  double operator()(double s) const {
    if (!(s < last_)) return 0;
    // Its end is rounded off: sums over rows converge slowly for a step.
    const double part = s / last_, square = part * part, rounded = 1 - square * square * square;
    return full(s) * rounded * rounded;
  }

 private:
  double full(double s) const {
    const double u = sharpness_ * (s + core_);
    return std::exp(-u) * (1 + u) * scale_ * lobe_.weight(s);
  }
  const lobe::AnyLobe& lobe_;
  double scale_, core_, sharpness_, last_;
};

/// The same for many evaluations: linear between values at even steps of the chord, off by 1e-6 of the
/// largest.
class SampledNear {
 public:
  explicit SampledNear(const Near& near) : last_(near.last()), scale_(kSteps / std::sqrt(2 * last_)) {
    for (int i = 0; i <= kSteps; ++i) values_.push_back(near(i * i / (2 * scale_ * scale_)));
  }
  double last() const { return last_; }
  double operator()(double s) const {
    const double position = std::sqrt(2 * s) * scale_;
    if (!(position < kSteps)) return 0;
    const std::size_t below = static_cast<std::size_t>(position);
    return values_[below] + (position - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr int kSteps = 4096;
  double last_, scale_;
  std::vector<double> values_;
};

/// Harmonics of the near part: 2π ∫ near P_l ds.
template <class Part>
std::vector<double> zonal_of(const Part& near, double width, int degree) {
  // In the angle, by panels that double in width from the axis outward.
  std::vector<double> s, weight;
  const double end = std::acos(1 - near.last());
  for (double from = 0, to = std::min(end, width / 4); from < end; from = to, to = std::min(end, to * 1.6)) {
    const Nodes nodes(to - from, 1);
    for (std::size_t i = 0; i < nodes.position.size(); ++i) {
      const double angle = from + nodes.position[i];
      s.push_back(lobe::s_of_angle(angle));
      weight.push_back(nodes.weight[i] * 2 * kPi * std::sin(angle) * near(s.back()));
    }
  }
  return lobe::legendre_sums(std::move(s), std::move(weight), degree);
}

/// The smallest exponent X for which both truncation errors are negligible; or the one with the best of
/// cores, where the lobe's own core isn't of the form that makes the far part smooth.
Split split_of(const lobe::AnyLobe& lobe, double scale, const std::vector<double>& zonal, int degree,
               double tolerance) {
  const double width = lobe.width(), half = (1 - std::cos(width)) / (std::sqrt(2.0) - 1);
  // Degrees beyond the last come from the near part alone: relative to what the lobe has there.
  const double have = std::fabs(zonal[static_cast<std::size_t>(degree)]);
  Split best{14, half};
  double minimum = 1e300;
  for (double exponent = 3; exponent <= 8; exponent += 0.5) {
    for (double core : {1.0, 0.5, 0.0, -0.25, -0.5, -0.75, -1.0}) {
      const Split split{exponent, core * half};
      const Near near(lobe, scale, degree, split);
      const double far =
          std::fabs(zonal[static_cast<std::size_t>(degree)] - zonal_of(near, width, degree).back());
      const double lost = std::max(far / have, near.beyond());
      if (lost < minimum) {
        minimum = lost;
        best = split;
      }
      if (minimum < 5 * tolerance) return best;
      if (core == 1.0 && near.beyond() > 5 * tolerance) break;
    }
  }
  return best;
}

/// Spreading weights by polynomials of degree five and reading a spline, both between rows, weaken detail of
/// ω radians to a row: 1 at ω = 0, and 0.96, 0.89, 0.79 at 0.5π, 0.6π, 0.7π, averaged over positions between
/// rows. 1 + kSharpening (2 sin ω/2)⁶ makes up for that: 1.05, 1.12, 1.21.
constexpr double kSharpening = 1.0 / 150;

/// Lines at whole numbers of rows from the axis: transforms F(μ) = 1/2π ∫ near(s + y²/2) cos μy dy, and what
/// bends of rows do to them, for μ = 0 … max_order.
///
/// Along a row at a mean sine σ of the two, y = 2σ sin φ/2: mφ = μy (1 + y²/24σ² …) with μ = m/σ, dφ = dy/σ
/// (1 + y²/8σ² …). So K_m = (F + C/σ²)/σ with C = −F″/8 − μF‴/24.
class Lines {
  struct Point {
    double straight, bend;
  };

 public:
  Lines(const SampledNear& near, double core, double step, int reach, int max_order) {
    const double end = std::acos(1 - near.last());
    std::vector<std::vector<double>> lines(static_cast<std::size_t>(reach) + 1);
    parallel_for(reach + 1, [&](int offset) {
      const double beside = lobe::s_of_angle(offset * step);
      Nodes nodes(std::sqrt(2 * std::max(0.0, near.last() - beside)),
                  std::max(4, static_cast<int>(end / std::min(core, end) / 2)));
      for (std::size_t i = 0; i < nodes.position.size(); ++i) {
        nodes.weight[i] *= near(beside + nodes.position[i] * nodes.position[i] / 2) / kPi;
      }
      lines[static_cast<std::size_t>(offset)] = cosine_sums(nodes.position, nodes.weight, max_order);
    });
    const std::size_t count = static_cast<std::size_t>(max_order) + 1;
    for (int offset = 0; offset <= reach; ++offset) {
      // (2 sin ω/2)⁶ across the rows.
      std::vector<double> line = lines[static_cast<std::size_t>(offset)];
      for (int k = -3; k <= 3; ++k) {
        const std::size_t other = static_cast<std::size_t>(std::abs(offset + k));
        constexpr double kSixth[4] = {20, -15, 6, -1};
        if (other >= lines.size()) continue;
        for (std::size_t mu = 0; mu < count; ++mu)
          line[mu] += kSharpening * kSixth[std::abs(k)] * lines[other][mu];
      }
      const auto at = [&](int mu) {
        return line[std::min(static_cast<std::size_t>(std::abs(mu)), count - 1)];
      };
      std::vector<Point>& points = points_.emplace_back();
      for (int mu = 0; mu <= max_order; ++mu) {
        const double second = at(mu + 1) - 2 * at(mu) + at(mu - 1);
        const double third = (at(mu + 2) - 2 * at(mu + 1) + 2 * at(mu - 1) - at(mu - 2)) / 2;
        points.push_back({at(mu), -second / 8 - mu * third / 24});
      }
    }
  }

  /// The largest μ at which all lines together have more than `part` of what they have at 0.
  int last(double part) const {
    const auto everything = [&](std::size_t mu) {
      double sum = 0;
      for (const auto& line : points_) sum += std::fabs(line[mu].straight);
      return sum;
    };
    std::size_t mu = points_[0].size() - 1;
    while (mu > 0 && everything(mu) < part * everything(0)) --mu;
    return static_cast<int>(mu);
  }

  /// K of the order m at `offset` rows, where the product of the rows' sines is `product`.
  class Row {
   public:
    Row(const Lines& lines, int offset, double product)
        : points_(lines.points_[static_cast<std::size_t>(std::abs(offset))]),
          scale_(1 / std::sqrt(product)),
          bend_(scale_ / product) {}
    double operator()(int m) const {
      const double mu = m * scale_;
      const std::size_t below = static_cast<std::size_t>(mu);
      if (below + 1 >= points_.size()) return 0;
      const double part = mu - static_cast<double>(below);
      const Point &a = points_[below], &b = points_[below + 1];
      return (a.straight + part * (b.straight - a.straight)) * scale_ +
             (a.bend + part * (b.bend - a.bend)) * bend_;
    }

   private:
    const std::vector<Point>& points_;
    double scale_, bend_;
  };

 private:
  std::vector<std::vector<Point>> points_;
};

/// K of the orders 0 … last where rows are so short that they bend: by φ itself, all around where the part
/// reaches over the pole.
std::vector<double> around_pole(const SampledNear& near, double core, double apart, double product,
                                int last) {
  const double beside = lobe::s_of_angle(apart), bend = (near.last() - beside) / product;
  const double around = bend >= 2 ? kPi : std::acos(1 - std::max(0.0, bend));
  const double detail = std::max(last * around / 32, around * std::sqrt(product) / core / 2);
  Nodes nodes(around, 1 + static_cast<int>(std::ceil(detail)));
  for (std::size_t i = 0; i < nodes.position.size(); ++i) {
    nodes.weight[i] *= near(beside + product * lobe::s_of_angle(nodes.position[i])) / kPi;
  }
  return cosine_sums(nodes.position, nodes.weight, last);
}

}  // namespace

NearField::NearField(const lobe::AnyLobe& lobe, const std::vector<double>& zonal, int row_count, int degree,
                     double tolerance)
    : rows(row_count) {
  assert(rows % 16 == 0);
  const double core = lobe.width(), scale = 1 / lobe.integral();
  const SampledNear near(Near(lobe, scale, degree, split_of(lobe, scale, zonal, degree, tolerance)));
  far = zonal_of(near, core, degree);
  for (std::size_t l = 0; l < far.size(); ++l) far[l] = zonal[l] - far[l];

  const double step = kPi / rows, end = std::acos(1 - near.last());
  reach = static_cast<int>(end / step);
  const int max_order = static_cast<int>(std::min(zonal.size(), static_cast<std::size_t>(4 * rows))) + 16;
  const Lines lines(near, core, step, reach, max_order);
  last = std::clamp(lines.last(5 * tolerance), 8, max_order - 16);

  const auto sine = [&](int row) { return std::sin((row + 0.5) * step); };
  const int width = 2 * reach + 1;
  std::ptrdiff_t size = 0;
  for (int first = 0; first < rows / 2; first += 8) {
    Pack& pack = packs.emplace_back();
    const double widest = sine(first + 7), narrowest = sine(first);
    pack.last = std::min(last, static_cast<int>(last * std::min(1.0, widest + reach * step)) + 12);
    // As φ, the part is end/sin θ wide: its transform has no finer detail than cos of that times the order.
    for (pack.stride = 1; pack.stride < 16 && 2 * pack.stride * end < 0.7 * narrowest;) pack.stride *= 2;
    pack.begin = size;
    size += static_cast<std::ptrdiff_t>(pack.last / pack.stride + 4) * width * 8;
  }
  table.assign(static_cast<std::size_t>(size), 0.0f);
  const auto pack_of = [&](int row) -> const Pack& { return packs[static_cast<std::size_t>(row / 8)]; };
  const auto blocks_of = [](const Pack& pack) { return pack.last / pack.stride + 4; };
  const auto order = [](const Pack& pack, int block) { return std::abs(block - 1) * pack.stride; };
  const auto entry = [&](int row, int block, int offset) -> float& {
    return table[static_cast<std::size_t>(pack_of(row).begin + (block * width + reach + offset) * 8 +
                                          row % 8)];
  };
  parallel_for(rows / 2, [&](int row) {
    const Pack& pack = pack_of(row);
    const int blocks = blocks_of(pack);
    std::vector<std::pair<int, Lines::Row>> straight;
    for (int offset = -reach; offset <= reach; ++offset) {
      const int other = row + offset;
      const double product = other < 0 ? 0 : sine(row) * sine(other);
      const bool bent = product < 9 * end * end;
      if (!bent) straight.emplace_back(offset, Lines::Row(lines, offset, product));
      // Two rows' K is the same from either.
      if (other < row || !bent) continue;
      const Pack& beside = pack_of(std::min(other, rows / 2 - 1));
      const std::vector<double> exact =
          around_pole(near, core, offset * step, product,
                      std::max(order(pack, blocks), order(beside, blocks_of(beside))));
      for (int block = 0; block < blocks; ++block) {
        entry(row, block, offset) = static_cast<float>(exact[static_cast<std::size_t>(order(pack, block))]);
      }
      for (int block = 0; block < blocks_of(beside) && other < rows / 2; ++block) {
        entry(other, block, -offset) =
            static_cast<float>(exact[static_cast<std::size_t>(order(beside, block))]);
      }
    }
    for (int block = 0; block < blocks; ++block) {
      for (const auto& [offset, k] : straight) {
        entry(row, block, offset) = static_cast<float>(k(order(pack, block)));
      }
    }
  });
}

}  // namespace welkin::prefilter
