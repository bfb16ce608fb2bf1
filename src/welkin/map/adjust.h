#pragma once

#include <cstdint>

#include "welkin/map/map.h"

/// Changes to the values of a map's charts. The borders are left as they were.
namespace welkin {

/// Every value times `factor`, but for the channel A.
void scale(Map& map, float factor);

/// Replaces every value of the charts (also outside discs) that is NaN or infinite by the mean of the finite
/// values of its channel among its eight neighbours in the chart, else by `replacement`. Returns how many
/// texels had such a value. The borders are left as they were: fill them again when it isn't 0.
std::uint64_t sanitize(Map& map, float replacement = 0);

}  // namespace welkin
