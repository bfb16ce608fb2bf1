#include "bake_source.h"

#include <fmt/core.h>

#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin::cli {
namespace {

void check_source(const Map& source, const std::string& in) {
  const SourceFaults faults = faults_of(source);
  if (faults.not_finite > 0) {
    throw Error(
        ErrorKind::bad_value, in,
        fmt::format("{} texels have NaN or infinite values; --sanitize repairs them", faults.not_finite));
  }
  if (faults.excessive > 0) {
    throw Error(ErrorKind::bad_value, in,
                fmt::format("{} texels have values of over {:g}, too large to filter", faults.excessive,
                            kMaxRadiance));
  }
  if (faults.negative > 0) {
    print_message(fmt::format(
        "welkin: {}: {} texels have negative values; they darken what is filtered, at most to 0\n", in,
        faults.negative));
  }
  if (!source.parameterization.whole_world()) {
    print_message(fmt::format("welkin: {}: shows {:.1f} % of the sphere; the rest is black\n", in,
                              100 * source.parameterization.coverage() / (4 * kPi)));
  }
}

}  // namespace

Map read_bake_source(const std::string& in, const ReadFlags& flags, const SanitizeFlags& repair,
                     const SanitizeOptions& repairs) {
  MapReader reader = flags.open(in);
  Map source = reader.read();
  if (repair.any()) repair.print(in, sanitize(source, repairs), repairs);
  check_source(source, in);
  return source;
}

}  // namespace welkin::cli
