#include "bake_source.h"

#include <fmt/core.h>

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin::cli {
namespace {

/// Alpha is no light.
Map without_alpha(Map map) {
  const std::vector<std::string> rgba{"R", "G", "B", "A"};
  if (map.channel_names != rgba) return map;
  Map rgb(map.parameterization, map.width(), map.height(), 3);
  rgb.orientation = map.orientation;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* from = map.level.chart(chart).row(y);
      float* to = rgb.level.chart(chart).row(y);
      for (int x = 0; x < map.width(); ++x) std::copy_n(from + 4 * x, 3, to + 3 * x);
    }
  }
  fill_borders(rgb);
  return rgb;
}

void check_source(const Map& source, const std::string& in) {
  const SourceFaults faults = faults_of(source);
  if (faults.not_finite > 0) {
    throw Error(
        ErrorKind::bad_value, in,
        fmt::format("{} texels have NaN or infinite values; --sanitize replaces them", faults.not_finite));
  }
  if (faults.excessive > 0) {
    throw Error(ErrorKind::bad_value, in,
                fmt::format("{} texels have values of over {:g}, too large to filter", faults.excessive,
                            kMaxRadiance));
  }
  if (faults.negative > 0) {
    tell(fmt::format(
        "welkin: {}: {} texels have negative values; they darken what is filtered, at most to 0\n", in,
        faults.negative));
  }
  if (!source.parameterization.whole_world()) {
    tell(fmt::format("welkin: {}: shows {:.1f} % of the sphere; the rest counts as black\n", in,
                     100 * source.parameterization.coverage() / (4 * kPi)));
  }
}

}  // namespace

Map read_bake_source(const std::string& in, const ReadFlags& flags, Faults faults) {
  MapReader reader = flags.open(in);
  Map source = flags.channels.empty() ? without_alpha(reader.read()) : reader.read();
  if (faults == Faults::mended) {
    const std::uint64_t mended = sanitize(source);
    if (mended > 0) fill_borders(source);
    tell(fmt::format("welkin: {}: {} texels with NaN or infinite values mended\n", in, mended));
  }
  check_source(source, in);
  return source;
}

}  // namespace welkin::cli
