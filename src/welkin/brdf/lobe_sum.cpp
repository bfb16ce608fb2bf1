#include "welkin/brdf/lobe_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/brdf/light_power.h"
#include "welkin/lobe/zonal.h"

namespace welkin::brdf {
namespace {

constexpr int kDegree = 320, kMaxLevels = 32, kMaxTerms = 16;
/// Steps of tables over an angle of 0…π.
constexpr int kSteps = 1440;

/// Σ_l (2l + 1)/4π c_l P_l(cos θ) at even steps of θ.
std::vector<double> zonal_table(const std::vector<double>& coefficients) {
  std::vector<double> table(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double x = std::cos(kPi * i / kSteps);
    double before = 1, now = x, sum = 0;
    for (int l = 1; l <= kDegree; ++l) {
      sum += (2 * l + 1) / (4 * kPi) * coefficients[static_cast<std::size_t>(l)] * now;
      const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
      before = now;
      now = next;
    }
    table[static_cast<std::size_t>(i)] = sum;
  }
  return table;
}

/// Linear between a table's steps.
double at(const std::vector<double>& table, double angle) {
  const double position = std::min(std::fabs(angle), kPi) * ((static_cast<double>(table.size()) - 1) / kPi);
  const auto below = std::min(static_cast<std::size_t>(position), table.size() - 2);
  return table[below] + (position - static_cast<double>(below)) * (table[below + 1] - table[below]);
}

}  // namespace

/// All products are weighted by the light's power: ⟨f, g⟩ = Σ_l C_l Σ_m f_lm g_lm, without degree 0, which
/// sums of weight 1 meet exactly.
struct LobeBasis::Tables {
  int levels = 0;
  std::vector<int> elevations;             ///< [level]: steps of 0…π that its axis is tried at
  std::vector<std::vector<double>> lobes;  ///< [level]: ⟨lobe, a point⟩ by the angle between
  std::vector<std::vector<double>>
      products;  ///< [a · levels + b]: ⟨lobe a, lobe b⟩ by the angle between axes

  double product(const LobeTerm& a, const LobeTerm& b) const {
    const double angle = a.tilt - b.tilt;
    double sum = 0;
    const auto [ka, pa] = split(a.level);
    const auto [kb, pb] = split(b.level);
    for (const auto& [k, part] : {std::pair{ka, 1 - pa}, std::pair{ka + 1, pa}}) {
      for (const auto& [m, other] : {std::pair{kb, 1 - pb}, std::pair{kb + 1, pb}}) {
        if (part * other == 0) continue;
        sum += part * other * at(products[static_cast<std::size_t>(k * levels + m)], angle);
      }
    }
    return sum;
  }
  std::pair<int, double> split(double level) const {
    const int below = std::clamp(static_cast<int>(level), 0, std::max(0, levels - 2));
    return {below, level - below};
  }
};

LobeBasis::LobeBasis(const std::vector<lobe::AnyLobe>& levels, double texel) {
  require(!levels.empty() && levels.size() <= kMaxLevels, "a basis has 1 to 32 lobes");
  require(texel > 0, "a texel has a width");
  auto tables = std::make_shared<Tables>();
  tables->levels = static_cast<int>(levels.size());
  std::vector<std::vector<double>> zonal;
  for (const lobe::AnyLobe& each : levels) {
    zonal.push_back(lobe::zonal_coefficients(each, kDegree));
    const double width = each.is_mirror() ? texel : std::max(texel, each.width());
    tables->elevations.push_back(std::clamp(static_cast<int>(6 * kPi / width), 72, 360));
    if (!each.is_mirror()) continue;
    // As wide as an interpolated texel: σ is about 0.4 of it.
    for (int l = 0; l <= kDegree; ++l)
      zonal.back()[static_cast<std::size_t>(l)] = std::exp(-0.08 * texel * texel * l * (l + 1));
  }
  for (const auto& a : zonal) {
    std::vector<double> single(kDegree + 1);
    for (int l = 1; l <= kDegree; ++l) {
      const auto k = static_cast<std::size_t>(l);
      single[k] = light_power(l) * a[k];
    }
    tables->lobes.push_back(zonal_table(single));
    for (const auto& b : zonal) {
      // Symmetric: half is made, half copied.
      const auto i = static_cast<std::size_t>(&a - zonal.data()),
                 j = static_cast<std::size_t>(&b - zonal.data());
      if (j < i) {
        tables->products.push_back(tables->products[j * zonal.size() + i]);
        continue;
      }
      std::vector<double> both(kDegree + 1);
      for (std::size_t l = 1; l <= kDegree; ++l) both[l] = single[l] * b[l];
      tables->products.push_back(zonal_table(both));
    }
  }
  tables_ = std::move(tables);
}

int LobeBasis::levels() const {
  return tables_->levels;
}

namespace {

/// A sum whose positions are being chosen; its weights are always the best for them.
class Fit {
 public:
  Fit(const MergedPoints& points, double view_cosine, const LobeBasis& basis)
      : basis_(basis.tables()), reflected_(std::asin(view_cosine)) {
    for (int level = 0; level < basis_.levels; ++level) target_.push_back(target_of(points, level));
  }

  std::vector<LobeTerm> run(int count) {
    for (int n = 0; n < count; ++n) {
      if (!add_best()) break;
      refine();
    }
    std::erase_if(terms_, [](const LobeTerm& term) { return term.weight <= 0; });
    std::sort(terms_.begin(), terms_.end(),
              [](const LobeTerm& a, const LobeTerm& b) { return a.weight > b.weight; });
    return terms_;
  }

 private:
  /// ⟨lobe of the level, BRDF's lobe⟩ for axes at even steps of elevation, 0…π.
  std::vector<double> target_of(const MergedPoints& points, int level) const {
    const std::vector<double>& lobe = basis_.lobes[static_cast<std::size_t>(level)];
    // By cosine, not by angle: no arc cosine for each pair. Dense near the axis by 1 − cos = 2 u².
    constexpr int kFine = 4096;
    std::vector<double> by_root(kFine + 2);
    for (int i = 0; i <= kFine + 1; ++i)
      by_root[static_cast<std::size_t>(i)] =
          at(lobe, 2 * std::asin(std::min(1.0, static_cast<double>(i) / kFine)));
    const int steps = basis_.elevations[static_cast<std::size_t>(level)];
    std::vector<double> table(static_cast<std::size_t>(steps) + 1);
    for (int e = 0; e <= steps; ++e) {
      const double elevation = kPi * e / steps, x = -std::cos(elevation), z = std::sin(elevation);
      double sum = 0;
      for (std::size_t i = 0; i < points.directions.size(); ++i) {
        const Vec3d& d = points.directions[i];
        const double half = 0.5 * (1 - (d.x * x + d.z * z));
        const double position = std::sqrt(std::max(0.0, half)) * kFine;
        const auto below = static_cast<std::size_t>(position);
        sum += points.weights[i] * (by_root[below] + (position - static_cast<double>(below)) *
                                                         (by_root[below + 1] - by_root[below]));
      }
      table[static_cast<std::size_t>(e)] = sum;
    }
    return table;
  }

  double target(const LobeTerm& term) const {
    const auto [below, part] = basis_.split(term.level);
    const double elevation = reflected_ + term.tilt;
    const double a = at(target_[static_cast<std::size_t>(below)], elevation);
    return part == 0 ? a : a + part * (at(target_[static_cast<std::size_t>(below) + 1], elevation) - a);
  }

  /// Gives the terms the best weights that are not negative and add up to 1; returns their squared error,
  /// less that of no lobe at all.
  double solve(std::vector<LobeTerm>& terms) const {
    const std::size_t n = terms.size();
    std::array<std::array<double, kMaxTerms>, kMaxTerms> products;
    std::array<double, kMaxTerms> targets;
    std::array<bool, kMaxTerms> used{};
    for (std::size_t i = 0; i < n; ++i) {
      targets[i] = target(terms[i]);
      used[i] = true;
      for (std::size_t j = 0; j <= i; ++j)
        products[i][j] = products[j][i] = basis_.product(terms[i], terms[j]);
    }
    // Those whose weight would be negative are left out, the worst first.
    std::array<double, kMaxTerms> weights{};
    for (;;) {
      std::array<std::size_t, kMaxTerms> index;
      std::size_t m = 0;
      for (std::size_t i = 0; i < n; ++i) {
        if (used[i]) index[m++] = i;
      }
      // G w = b + μ 1, Σ w = 1: two solutions of one symmetric system.
      std::array<std::array<double, kMaxTerms + 2>, kMaxTerms> rows;
      for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) rows[i][j] = products[index[i]][index[j]];
        rows[i][i] *= 1 + 1e-9;  // two equal terms are one
        rows[i][m] = targets[index[i]];
        rows[i][m + 1] = 1;
      }
      eliminate(rows, m);
      double first = 0, second = 0;
      for (std::size_t i = 0; i < m; ++i) first += rows[i][m], second += rows[i][m + 1];
      const double multiplier = (1 - first) / second;
      std::size_t worst = n;
      double least = 0;
      weights.fill(0);
      for (std::size_t i = 0; i < m; ++i) {
        const double weight = rows[i][m] + multiplier * rows[i][m + 1];
        weights[index[i]] = weight;
        if (weight < least) least = weight, worst = index[i];
      }
      if (worst == n) break;
      used[worst] = false;
    }
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
      terms[i].weight = weights[i];
      error -= 2 * weights[i] * targets[i];
      for (std::size_t j = 0; j < n; ++j) error += weights[i] * weights[j] * products[i][j];
    }
    return error;
  }

  /// Gauss–Jordan on a positive definite matrix with two right-hand sides.
  template <class Rows>
  static void eliminate(Rows& rows, std::size_t m) {
    for (std::size_t k = 0; k < m; ++k) {
      const double pivot = 1 / rows[k][k];
      for (std::size_t j = k; j < m + 2; ++j) rows[k][j] *= pivot;
      for (std::size_t i = 0; i < m; ++i) {
        if (i == k || rows[i][k] == 0) continue;
        const double factor = rows[i][k];
        for (std::size_t j = k; j < m + 2; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
  }

  LobeTerm within(LobeTerm term) const {
    term.level = std::clamp(term.level, 0.0, basis_.levels - 1.0);
    term.tilt = std::clamp(term.tilt, -reflected_, kPi - reflected_);
    return term;
  }

  /// Adds the term that helps most, of a coarse grid; false where none does.
  bool add_best() {
    std::vector<LobeTerm> best, tried = terms_;
    tried.emplace_back();
    double least = terms_.empty() ? 1e300 : error_ - 1e-6 * std::fabs(error_);
    for (int half = 0; half <= 2 * (basis_.levels - 1); ++half) {
      for (int k = 0; k <= 60; ++k) {
        tried.assign(terms_.begin(), terms_.end());
        tried.push_back(within({0, 0.5 * half, kPi * k / 60 - reflected_}));
        const double error = solve(tried);
        if (error < least) {
          least = error;
          best = tried;
        }
      }
    }
    if (best.empty()) return false;
    terms_ = std::move(best);
    error_ = least;
    return true;
  }

  /// Moves one number of one term at a time as long as that helps, by ever smaller steps.
  void refine() {
    for (double step = 1; step > 0.02; step /= 2) {
      for (int sweep = 0; sweep < 12; ++sweep) {
        bool moved = false;
        for (std::size_t i = 0; i < terms_.size(); ++i) {
          for (const auto& [levels, radians] : {std::pair{step, 0.0}, std::pair{-step, 0.0},
                                                std::pair{0.0, 0.1 * step}, std::pair{0.0, -0.1 * step}}) {
            std::vector<LobeTerm> tried = terms_;
            tried[i].level += levels;
            tried[i].tilt += radians;
            tried[i] = within(tried[i]);
            const double error = solve(tried);
            if (error >= error_ - 1e-12 * std::fabs(error_)) continue;
            terms_ = std::move(tried);
            error_ = error;
            moved = true;
          }
        }
        if (!moved) break;
      }
    }
  }

  const LobeBasis::Tables& basis_;
  double reflected_;
  std::vector<std::vector<double>> target_;
  std::vector<LobeTerm> terms_;
  double error_ = 0;
};

}  // namespace

std::vector<LobeTerm> fit_lobe_sum(const AnyBrdf& brdf, double view_cosine, const LobeBasis& basis,
                                   int count) {
  require(count >= 1 && count <= kMaxTerms, "a sum has 1 to 16 lobes");
  // Points as fine as the narrowest details that count at the highest degree.
  const MergedPoints points = merged(lobe_points(brdf, view_cosine, 4), 0.004);
  return Fit(points, view_cosine, basis).run(count);
}

}  // namespace welkin::brdf
