#include "welkin/map/lobe_sums.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin {

void LobeSumChain::check() const {
  const auto fail = [](const char* what) {
    throw Error(ErrorKind::mismatch, std::string("a table of lobes to add ") + what);
  };
  if (chain.levels.empty()) fail("has no chain");
  for (const Map& map : chain.levels) map.check();
  double before = 0;
  for (const double cosine : sums.view_cosines) {
    if (!(cosine > before && cosine <= 1)) fail("has angles of view whose cosines don't ascend in 0…1");
    before = cosine;
  }
  before = -1;
  for (const double roughness : sums.roughness) {
    if (!(roughness > before && roughness >= 0 && roughness <= 1))
      fail("has a roughness that doesn't ascend in 0…1");
    before = roughness;
  }
  const std::size_t pairs = sums.view_cosines.size() * sums.roughness.size();
  if (pairs == 0 || sums.count < 1 || sums.look_ups.size() != pairs * static_cast<std::size_t>(sums.count))
    fail("isn't as large as its angles of view, its roughness and its number of lobes say");
  const double last = static_cast<double>(chain.levels.size()) - 1;
  for (const LobeLookUp& each : sums.look_ups) {
    if (!(std::isfinite(each.weight) && std::isfinite(each.lift))) fail("has numbers that aren't finite");
    if (!(each.level >= 0 && each.level <= last)) fail("has levels that its chain lacks");
  }
  const bool fits = sums.albedo.values.size() == pairs &&
                    static_cast<std::size_t>(sums.albedo.levels) == sums.roughness.size() &&
                    std::all_of(sums.albedo.values.begin(), sums.albedo.values.end(),
                                [](double x) { return std::isfinite(x); });
  if (!fits) fail("has albedos that don't fit it");
}

}  // namespace welkin
