#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "welkin/measure/energy.h"

namespace welkin::cli {

/// `0.2688,0.6018,0.7510`.
std::string direction_text(const Vec3d& d);

/// Energy of a map and of its lights.
void print_energy(const MapEnergy& energy);
nlohmann::ordered_json json_of(const MapEnergy& energy);

/// Energy before and after, of the whole and of each light.
void print_energy(const EnergyComparison& energy);
/// A line for each light alone.
void print_lights(const EnergyComparison& energy);
nlohmann::ordered_json json_of(const EnergyComparison& energy);

/// `+25.1 %`, of a ratio.
std::string change_text(double ratio);

}  // namespace welkin::cli
