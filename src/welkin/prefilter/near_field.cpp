#include "welkin/prefilter/near_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "welkin/base/parallel.h"
#include "welkin/lobe/panels.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/scalar.h"
#include "welkin/prefilter/sampled_lobe.h"

namespace welkin::prefilter {
namespace {

/// Places and weights of Gauss's rule of 16 points in each of `panels` parts of 0 … end.
struct Nodes {
  Nodes(double end, int panels) {
    static const lobe::Rule rule = lobe::gauss_legendre(16);
    const double half = end / (2 * panels);
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < rule.places.size(); ++i) {
        place.push_back((2 * panel + 1 + rule.places[i]) * half);
        weight.push_back(rule.weights[i] * half);
      }
    }
  }
  std::vector<double> place, weight;
};

/// Σ weight cos(m · place) for m = 0 … last. Eight places at a time.
std::vector<double> cosine_sums(const std::vector<double>& place, const std::vector<double>& weight,
                                int last) {
  std::vector<double> sums(static_cast<std::size_t>(last) + 1);
  for (std::size_t first = 0; first < place.size(); first += 8) {
    double now[8] = {}, before[8] = {}, twice[8] = {};
    for (std::size_t i = 0; i < 8 && first + i < place.size(); ++i) {
      twice[i] = 2 * std::cos(place[first + i]);
      now[i] = weight[first + i];
      before[i] = weight[first + i] * std::cos(place[first + i]);
    }
    for (double& sum : sums) {
      double total = 0;
      for (int i = 0; i < 8; ++i) total += now[i];
      sum += total;
      for (int i = 0; i < 8; ++i) {
        const double next = twice[i] * now[i] - before[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
  }
  return sums;
}

/// The near part as a function of s, normalised with the lobe: linear between values at even steps of the
/// chord, off by 1e-6 of the largest.
class Near {
 public:
  Near(const ChordSamples& lobe, double sharpness, double exponent, double core)
      : sharpness_(sharpness),
        core_(core),
        last_(exponent / sharpness),
        scale_(kSteps / std::sqrt(2 * last_)) {
    for (int i = 0; i <= kSteps + 1; ++i) {
      const double chord = i / scale_, s = chord * chord / 2;
      // Its end is rounded off: sums over rows don't take to a step.
      const double part = s / last_, rounded = part < 1 ? 1 - std::pow(part, 6) : 0;
      const double value = window(s) * lobe.at_chord(chord);
      values_.push_back(value * rounded * rounded);
      // What is cut off there: for a lobe that falls as s⁻², s·w·χ lies beyond.
      if (i == kSteps) beyond_ = 2 * kPi * last_ * value;
    }
  }
  /// Nothing beyond this s.
  double last() const { return last_; }
  double beyond() const { return beyond_; }
  double operator()(double s) const {
    const double place = std::sqrt(2 * s) * scale_;
    if (!(place < kSteps)) return 0;
    const std::size_t below = static_cast<std::size_t>(place);
    return values_[below] + (place - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr int kSteps = 4096;
  double window(double s) const {
    const double u = sharpness_ * (s + core_);
    return std::exp(-u) * (1 + u);
  }
  double sharpness_;
  double core_;  ///< c of a lobe (1 + s/c)⁻²
  double last_, scale_, beyond_ = 0;
  std::vector<double> values_;
};

/// Harmonics of the near part: 2π ∫ near P_l ds.
std::vector<double> zonal_of(const Near& near, double width, int degree) {
  // In the angle, by panels that double in width from the axis outward.
  std::vector<double> s, weight;
  const double end = std::acos(1 - near.last());
  for (double from = 0, to = std::min(end, width / 4); from < end; from = to, to = std::min(end, to * 1.6)) {
    const Nodes nodes(to - from, 1);
    for (std::size_t i = 0; i < nodes.place.size(); ++i) {
      const double angle = from + nodes.place[i], sine = std::sin(angle / 2);
      s.push_back(2 * sine * sine);
      weight.push_back(nodes.weight[i] * 2 * kPi * std::sin(angle) * near(s.back()));
    }
  }
  return lobe::legendre_sums(std::move(s), std::move(weight), degree);
}

/// How a lobe is split: S = degree²/2X, and the near part ends at s = X/S.
struct Split {
  double exponent, core;
};

/// The smallest exponent X with which neither cut matters; or the one with the best of cores, where the
/// lobe's own core isn't of the form that makes the far part smooth.
Split split_of(const ChordSamples& lobe, double width, const std::vector<double>& zonal, int degree,
               double tolerance) {
  const double half = (1 - std::cos(width)) / (std::sqrt(2.0) - 1);
  // Degrees beyond the last come from the near part alone: relative to what the lobe has there.
  const double have = std::fabs(zonal[static_cast<std::size_t>(degree)]);
  Split best{14, half};
  double least = 1e300;
  for (double exponent = 3; exponent <= 8; exponent += 0.5) {
    const double sharpness = static_cast<double>(degree) * degree / (2 * exponent);
    for (double core : {1.0, 0.5, 0.0, -0.25, -0.5, -0.75, -1.0}) {
      const Near near(lobe, sharpness, exponent, core * half);
      const std::vector<double> inner = zonal_of(near, width, degree);
      const double far = std::fabs(zonal[static_cast<std::size_t>(degree)] - inner.back());
      const double lost = std::max(far / have, near.beyond());
      if (lost < least) {
        least = lost;
        best = {exponent, core * half};
      }
      if (least < 5 * tolerance) return best;
      if (core == 1.0 && near.beyond() > 5 * tolerance) break;
    }
  }
  return best;
}

}  // namespace

NearField::NearField(const lobe::AnyLobe& lobe, const std::vector<double>& zonal, int row_count, int degree,
                     double tolerance)
    : rows(row_count) {
  assert(rows % 16 == 0);
  const double core = lobe.width();
  const ChordSamples samples(lobe, core, 1 << 14, 1 / lobe.integral());
  const Split split = split_of(samples, core, zonal, degree, tolerance);
  const Near near(samples, static_cast<double>(degree) * degree / (2 * split.exponent), split.exponent,
                  split.core);
  far = zonal_of(near, core, degree);
  for (std::size_t l = 0; l < far.size(); ++l) far[l] = zonal[l] - far[l];

  const double step = kPi / rows, end = std::acos(1 - near.last());
  reach = static_cast<int>(end / step);
  // A line at an offset from the axis: its transform F(μ) = 1/2π ∫ near(s + y²/2) cos μy dy, for whole μ.
  const int most = static_cast<int>(std::min(zonal.size(), static_cast<std::size_t>(4 * rows))) + 16;
  std::vector<std::vector<double>> lines(static_cast<std::size_t>(reach) + 1);
  parallel_for(reach + 1, [&](int offset) {
    const double beside = 2 * std::pow(std::sin(offset * step / 2), 2);
    Nodes nodes(std::sqrt(2 * std::max(0.0, near.last() - beside)),
                std::max(4, static_cast<int>(end / std::min(core, end) / 2)));
    for (std::size_t i = 0; i < nodes.place.size(); ++i) {
      nodes.weight[i] *= near(beside + nodes.place[i] * nodes.place[i] / 2) / kPi;
    }
    lines[static_cast<std::size_t>(offset)] = cosine_sums(nodes.place, nodes.weight, most);
  });
  // Along a row at a mean sine σ of the two, y = 2σ sin φ/2: mφ = μy (1 + y²/24σ² …) with μ = m/σ, dφ = dy/σ
  // (1 + y²/8σ² …). So K_m = (F + C/σ²)/σ with C = −F″/8 − μF‴/24.
  std::vector<std::vector<double>> bends(lines.size());
  for (std::size_t offset = 0; offset < lines.size(); ++offset) {
    const std::vector<double>& f = lines[offset];
    const auto at = [&](int mu) { return f[std::min(static_cast<std::size_t>(std::abs(mu)), f.size() - 1)]; };
    for (int mu = 0; mu < static_cast<int>(f.size()); ++mu) {
      const double second = at(mu + 1) - 2 * at(mu) + at(mu - 1);
      const double third = (at(mu + 2) - 2 * at(mu + 1) + 2 * at(mu - 1) - at(mu - 2)) / 2;
      bends[offset].push_back(-second / 8 - mu * third / 24);
    }
  }
  last = most - 16;
  double peak = 0;
  for (const auto& line : lines) peak += 2 * line[0];
  const auto everything = [&](int mu) {
    double sum = 0;
    for (const auto& line : lines) sum += 2 * std::fabs(line[static_cast<std::size_t>(mu)]);
    return sum;
  };
  while (last > 8 && everything(last) < 5 * tolerance * peak) --last;

  const int packs = rows / 8, width = 2 * reach + 1, blocks = last / 8 + 4;
  std::vector<double> sines;
  for (int row = 0; row < rows; ++row) sines.push_back(std::sin((row + 0.5) * step));
  const auto sine = [&](int row) { return sines[static_cast<std::size_t>(row)]; };
  last_order.resize(static_cast<std::size_t>(packs));
  polar.assign(static_cast<std::size_t>(packs), -1);
  std::ptrdiff_t polar_size = 0;
  for (int pack = 0; pack < packs; ++pack) {
    const double widest = std::max(sine(pack * 8), sine(pack * 8 + 7));
    last_order[static_cast<std::size_t>(pack)] =
        std::min(last, static_cast<int>(last * std::min(1.0, widest + reach * step)) + 12);
    if (widest < 0.35) {
      polar[static_cast<std::size_t>(pack)] = polar_size;
      polar_size += static_cast<std::ptrdiff_t>(last_order[static_cast<std::size_t>(pack)] + 1) * width * 8;
    }
  }
  table.assign(
      static_cast<std::size_t>(blocks) * static_cast<std::size_t>(width) * static_cast<std::size_t>(rows),
      0.0f);
  polar_table.assign(static_cast<std::size_t>(polar_size), 0.0f);
  // The southern rows mirror the northern.
  parallel_for(rows / 2, [&](int row) {
    const std::size_t pack = static_cast<std::size_t>(row / 8),
                      mirror = static_cast<std::size_t>(rows - 1 - row);
    for (int offset = -reach; offset <= reach; ++offset) {
      const int other = row + offset;
      if (other < 0 || other >= rows) continue;
      const double product = sine(row) * sine(other), mean = std::sqrt(product);
      const std::vector<double>& line = lines[static_cast<std::size_t>(std::abs(offset))];
      const std::vector<double>& bend_line = bends[static_cast<std::size_t>(std::abs(offset))];
      const auto planar = [&](int m) {
        const double mu = m / mean;
        const std::size_t below = static_cast<std::size_t>(mu);
        if (below + 1 >= line.size()) return 0.0;
        const double part = mu - static_cast<double>(below);
        const double straight = line[below] + part * (line[below + 1] - line[below]);
        return (straight + (bend_line[below] + part * (bend_line[below + 1] - bend_line[below])) / product) /
               mean;
      };
      const std::size_t column = static_cast<std::size_t>(reach + offset);
      const std::size_t mirror_column = static_cast<std::size_t>(reach - offset);
      if (polar[pack] < 0) {
        for (int block = 0; block < blocks; ++block) {
          const std::size_t at = static_cast<std::size_t>(block) * static_cast<std::size_t>(width);
          const float value = static_cast<float>(planar(std::abs(block - 1) * 8));
          table[(at + column) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row)] = value;
          table[(at + mirror_column) * static_cast<std::size_t>(rows) + mirror] = value;
        }
        continue;
      }
      std::vector<double> exact;
      if (mean < 3 * end) {
        // The row bends: φ itself, all around where the part reaches over the pole.
        const double beside = 2 * std::pow(std::sin(offset * step / 2), 2);
        const double bend = (near.last() - beside) / product;
        const double around = bend >= 2 ? kPi : std::acos(1 - std::max(0.0, bend));
        const double detail = std::max(last_order[pack] * around / 24, around * mean / core / 2);
        Nodes nodes(around, 1 + static_cast<int>(std::ceil(detail)));
        for (std::size_t i = 0; i < nodes.place.size(); ++i) {
          nodes.weight[i] *= near(beside + 2 * product * std::pow(std::sin(nodes.place[i] / 2), 2)) / kPi;
        }
        exact = cosine_sums(nodes.place, nodes.weight, last_order[pack]);
      }
      const std::ptrdiff_t mirror_polar = polar[mirror / 8];
      for (int m = 0; m <= last_order[pack]; ++m) {
        const float value =
            static_cast<float>(exact.empty() ? planar(m) : exact[static_cast<std::size_t>(m)]);
        const std::size_t at = static_cast<std::size_t>(m) * static_cast<std::size_t>(width);
        polar_table[static_cast<std::size_t>(polar[pack]) + (at + column) * 8 +
                    static_cast<std::size_t>(row % 8)] = value;
        polar_table[static_cast<std::size_t>(mirror_polar) + (at + mirror_column) * 8 + mirror % 8] = value;
      }
    }
  });
}

}  // namespace welkin::prefilter
