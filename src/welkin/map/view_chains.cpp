#include "welkin/map/view_chains.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin {
namespace {

void check_table(const ViewTable& table, const char* name, std::size_t views, std::size_t levels) {
  const bool fits =
      static_cast<std::size_t>(table.levels) == levels && table.values.size() == views * levels &&
      std::all_of(table.values.begin(), table.values.end(), [](double x) { return std::isfinite(x); });
  if (!fits)
    throw Error(ErrorKind::mismatch, std::string("a stack of angles of view has a table of ") + name +
                                         " that doesn't fit its levels");
}

}  // namespace

void ViewChains::check() const {
  const auto fail = [](const char* what) {
    throw Error(ErrorKind::mismatch, std::string("a stack of angles of view ") + what);
  };
  if (views.empty() || views.size() != notes.view_cosines.size())
    fail("has another number of chains than of angles");
  double before = 0;
  for (const double cosine : notes.view_cosines) {
    if (!(cosine > before && cosine <= 1)) fail("has angles whose cosines don't ascend in 0…1");
    before = cosine;
  }
  const Chain& first = views.front();
  for (const Chain& chain : views) {
    if (chain.levels.empty() || chain.levels.size() != first.levels.size())
      fail("has chains of different numbers of levels, or of none");
    for (std::size_t k = 0; k < chain.levels.size(); ++k) {
      const Map &a = chain.levels[k], &b = first.levels[k];
      a.check();
      if (!(a.parameterization == b.parameterization) || a.width() != b.width() || a.height() != b.height() ||
          a.channel_names != b.channel_names || !(a.orientation == b.orientation))
        fail("has chains that differ in shape, size or channels");
    }
  }
  check_table(notes.lift, "lifts", views.size(), first.levels.size());
  check_table(notes.albedo, "albedos", views.size(), first.levels.size());
}

std::vector<double> default_view_cosines(int count) {
  require(count >= 1, "a stack has at least one angle of view");
  std::vector<double> cosines;
  for (int k = 0; k < count; ++k) {
    const double middle = (k + 0.5) / count;
    cosines.push_back(middle * middle);
  }
  return cosines;
}

ViewPosition view_position(const std::vector<double>& cosines, double view_cosine) {
  const std::size_t last = cosines.size() - 1;
  if (!(view_cosine > cosines.front())) return {0, 0, 0};
  if (view_cosine >= cosines.back()) return {last, last, 0};
  const auto next = std::upper_bound(cosines.begin(), cosines.end(), view_cosine);
  const auto above = static_cast<std::size_t>(next - cosines.begin());
  const double from = std::sqrt(cosines[above - 1]), to = std::sqrt(cosines[above]);
  return {above - 1, above, (std::sqrt(view_cosine) - from) / (to - from)};
}

}  // namespace welkin
