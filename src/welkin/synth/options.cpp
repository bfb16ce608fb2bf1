#include <cmath>
#include <sstream>

#include "welkin/base/error.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {
namespace {

[[noreturn]] void refuse(double value, const OptionRange& range, std::string_view wanted) {
  std::ostringstream message;
  message << "synth " << range.map << ": " << range.option << " must be " << wanted << " from " << range.low
          << " to " << range.high << ", not " << value;
  throw Error(ErrorKind::bad_request, message.str());
}

}  // namespace

double checked_option(double value, const OptionRange& range) {
  if (!(value >= range.low && value <= range.high)) refuse(value, range, "a number");
  return value;
}

double option_or(const std::optional<double>& value, double fallback, const OptionRange& range) {
  return value ? checked_option(*value, range) : fallback;
}

int whole_option_or(const std::optional<double>& value, int fallback, int step, const OptionRange& range) {
  if (!value) return fallback;
  const bool inside = *value >= range.low && *value <= range.high;
  if (!inside || std::fmod(*value, step) != 0) {
    refuse(*value, range, step == 1 ? "a whole number" : "an even whole number");
  }
  return static_cast<int>(*value);
}

double scale_option(const SynthOptions& options, std::string_view map) {
  return option_or(options.intensity, 1, {map, "intensity", 0, 1e9});
}

}  // namespace welkin::synth
