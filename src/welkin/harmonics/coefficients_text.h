#pragma once

#include <optional>
#include <string>
#include <vector>

#include "welkin/harmonics/bases.h"

/// What reading and writing coefficients share. Internal to harmonics.
namespace welkin::harmonics {

inline constexpr std::size_t kMostChannels = 64;

/// The default names of so many channels.
std::vector<std::string> names_of(std::size_t channels);

/// Checks the number of rows against the basis, and the order where there is one; sets the degree.
void set_degree(BasisCoefficients& coefficients, std::size_t rows, std::optional<double> order);

}  // namespace welkin::harmonics
