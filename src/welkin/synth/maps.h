#pragma once

#include <optional>
#include <string_view>

#include "welkin/synth/synth.h"

/// Inside this room: one function for each map, in a file of its own, and what they share.
namespace welkin::synth {

Radiance make_axes(const SynthOptions& options);
Radiance make_checker(const SynthOptions& options);
Radiance make_constant(const SynthOptions& options);
Radiance make_lamps(const SynthOptions& options);
Radiance make_lines(const SynthOptions& options);
Radiance make_room(const SynthOptions& options);
Radiance make_sky(const SynthOptions& options);
Radiance make_studio(const SynthOptions& options);
Radiance make_sun(const SynthOptions& options);
Radiance make_zoneplate(const SynthOptions& options);

/// Which option of which map, and the values it may take (ends included).
struct OptionRange {
  std::string_view map, option;
  double low, high;
};

/// `value`, or `fallback` where there is none. Throws Error outside `range`.
double option_or(const std::optional<double>& value, double fallback, const OptionRange& range);

/// `value`. Throws Error outside `range`, or when it is not finite.
double checked_option(double value, const OptionRange& range);

/// As option_or, for whole numbers that are multiples of `step`.
int whole_option_or(const std::optional<double>& value, int fallback, int step, const OptionRange& range);

/// The factor on a map whose intensity is one: 0 … 1e9.
double scale_option(const SynthOptions& options, std::string_view map);

}  // namespace welkin::synth
