#include "welkin/prefilter/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/lobe/energy.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

using namespace prefilter;

void check(const PrefilterShape& source, const std::vector<PrefilterLevel>& levels,
           const PrefilterOptions& options) {
  const auto positive = [](ChartSize size) { return size.width > 0 && size.height > 0; };
  if (!positive(source.size) || source.channels < 1)
    throw Error(ErrorKind::bad_request, "prefilter: the source has no texels");
  require(is_orthonormal(options.orientation), "the orientation of a map is a rotation or a reflection");
  for (const PrefilterLevel& level : levels) {
    if (!positive(level.size)) throw Error(ErrorKind::bad_request, "prefilter: a level has no texels");
  }
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 0.1)) {
    throw Error(ErrorKind::bad_request, "prefilter: the tolerance is not in 1e-6…0.1");
  }
}

/// Lobes with more degrees than this are split into near and far.
constexpr int kMaxDegree = 480;

/// Whether a lobe is to be split into near and far: too many degrees, and most of it near its axis. A narrow
/// ring isn't.
bool is_split(const lobe::AnyLobe& lobe, int degree) {
  return degree > kMaxDegree && lobe::energy_cone_angle(lobe, 0.5) < 0.2;
}

/// Rows that a near part is done on. They resolve what is left of the lobe at the scale of `texel`, the wider
/// one of the source and the level, or all of it where it is wider. More of them where that is the source's,
/// whose edges then show.
int near_rows(const sphere::AnyParameterization& source, double source_texel, double texel, int degree) {
  const double of_latlong = source_texel < texel ? 2.3 : 2.65;
  const double per_texel = source.traits().latlong_grid ? of_latlong : 2.8;
  const double rows = std::min(per_texel * kPi / texel, 1.8 * degree);
  return std::max(32, static_cast<int>(std::ceil(rows / 16)) * 16);
}

/// Degree of the far part's harmonics: the near part reaches about as many rows then, however fine they are.
int far_degree(int rows) {
  return std::max(300, rows * 2 / 9);
}

/// Throws when a near part's tables and rows would take more memory than is reasonable.
void check_near_size(int rows, int channels) {
  // Tables, points and results; the bands of rows between are small.
  const double n = rows, orders = 1.2 * n;
  const double bytes = 4 * (orders / 8 * 30 * n / 2 + 4.4 * n * n * channels);
  constexpr double kMaxBytes = 24e9;
  if (bytes > kMaxBytes) {
    throw Error(ErrorKind::too_large,
                "prefilter: so narrow a lobe on so fine a level would take " +
                    number_text(std::round(bytes / 1e9)) +
                    " GB of memory: make the level smaller, or the roughness 0 or larger");
  }
}

/// How a level that is no mirror's is done.
struct Choice {
  WidenedLobe lobe;
  int near_rows = 0;  ///< 0 when the lobe isn't split
  int degree() const { return near_rows > 0 ? far_degree(near_rows) : lobe.degree(); }
};

/// None for mirrors. How fine a lobe is decides.
std::vector<std::optional<Choice>> choose(const PrefilterPlan::Tables& t) {
  std::vector<std::optional<Choice>> choices(t.levels.size());
  const double source_texel = mean_texel(t.source.parameterization, t.source.size);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const lobe::AnyLobe& lobe = t.levels[i].lobe;
    if (lobe.is_mirror()) continue;
    const double texel = std::max(source_texel, mean_texel(t.target, t.levels[i].size));
    Choice& choice = choices[i].emplace(Choice{widen(lobe, texel, t.options.tolerance / 5)});
    if (!is_split(lobe, choice.lobe.degree())) continue;
    choice.near_rows = near_rows(t.source.parameterization, source_texel, texel, choice.lobe.degree());
    check_near_size(choice.near_rows, t.source.channels);
  }
  return choices;
}

/// Read from the source.
void add_mirror(PrefilterPlan::Tables& t, std::size_t level) {
  t.methods.push_back({"resample", 0, {}, t.levels[level].lobe});
}

void add_harmonic(PrefilterPlan::Tables& t, std::size_t level, const WidenedLobe& lobe) {
  HarmonicLevel& harmonic =
      t.harmonic.emplace_back(lobe, lobe.zonal, static_cast<int>(level), t.analysis->points.width);
  // Tables are slow to look up.
  if (lobe.lobe.name() == "table") harmonic.sampled.emplace(lobe.lobe);
  t.methods.push_back({"harmonics", lobe.degree(), harmonic.grid, lobe.lobe, lobe.sigma});
}

void add_near_and_far(PrefilterPlan::Tables& t, std::size_t level, const Choice& choice) {
  const int rows = choice.near_rows;
  auto group = std::find_if(t.near.begin(), t.near.end(),
                            [&](const NearGroup& each) { return each.points.height == rows; });
  if (group == t.near.end()) group = t.near.emplace(t.near.end(), t.source, rows, 4 * rows);
  const NearLevel& near = group->levels.emplace_back(choice.lobe, t.harmonic.size(), rows, choice.degree(),
                                                     t.options.tolerance / 5, group->points.width);
  t.harmonic.emplace_back(choice.lobe, near.field.far, static_cast<int>(level), t.analysis->points.width)
      .all = true;
  t.methods.push_back({"near and far", choice.degree(), near.grid, choice.lobe.lobe, choice.lobe.sigma});
}

/// Finds the levels that are summed together; of fewer than these each is as fast alone.
void add_groups(PrefilterPlan::Tables& t) {
  constexpr std::size_t kFewest = 4;
  std::vector<bool> taken(t.harmonic.size(), false);
  for (std::size_t i = 0; i < t.harmonic.size(); ++i) {
    const auto size_of = [&](std::size_t k) {
      return t.levels[static_cast<std::size_t>(t.harmonic[k].index)].size;
    };
    std::vector<std::size_t> members;
    std::vector<const lobe::AnyLobe*> lobes;
    std::vector<double> scales;
    double core = 2;
    for (std::size_t k = i; k < t.harmonic.size(); ++k) {
      const HarmonicLevel& level = t.harmonic[k];
      const bool alike = size_of(k).width == size_of(i).width && size_of(k).height == size_of(i).height;
      if (taken[k] || !level.sampled || level.all || !alike) continue;
      members.push_back(k);
      lobes.push_back(&level.lobe);
      scales.push_back(level.scale);
      core = std::min(core, static_cast<double>(level.sampled->core));
    }
    if (members.size() < kFewest) continue;
    for (const std::size_t k : members) taken[k] = true;
    t.groups.push_back({std::move(members), SampledGroup(lobes, core, scales)});
  }
}

}  // namespace

PrefilterPlan::PrefilterPlan(const PrefilterShape& source, const sphere::AnyParameterization& target,
                             std::vector<PrefilterLevel> levels, const PrefilterOptions& options) {
  check(source, levels, options);
  auto tables = std::make_shared<Tables>(Tables{source, target, std::move(levels), options});
  const std::vector<std::optional<Choice>> choices = choose(*tables);
  // The points and their analysis serve the level of the largest degree.
  int degree = -1;
  for (const auto& choice : choices) {
    if (choice) degree = std::max(degree, choice->degree());
  }
  if (degree >= 0) tables->analysis.emplace(source, degree);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (!choices[i]) {
      add_mirror(*tables, i);
    } else if (choices[i]->near_rows == 0) {
      add_harmonic(*tables, i, choices[i]->lobe);
    } else {
      add_near_and_far(*tables, i, *choices[i]);
    }
  }
  add_groups(*tables);
  std::vector<const WidenedLobe*> lobes;
  for (const HarmonicLevel& each : tables->harmonic)
    lobes.push_back(&choices[static_cast<std::size_t>(each.index)]->lobe);
  if (tables->near.empty() && tables->groups.empty())
    tables->coarse = CoarsePlan::make(source, tables->harmonic, lobes, options.tolerance);
  tables_ = std::move(tables);
}

const std::vector<PrefilterMethod>& PrefilterPlan::methods() const {
  return tables_->methods;
}

}  // namespace welkin
