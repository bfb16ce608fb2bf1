#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "welkin/light/extract.h"
#include "welkin/math/rotation.h"

namespace welkin::cli {

/// One line for each light, under a heading. `world`: to the coordinates that directions are printed in.
void print_lights(const LightSet& set, const Matrix3& world = {});
/// The light that `bake --extract-sun` took out, or that there was none.
void print_sun(const LightSet& sun);
/// What a light's line can't hold: clipped, cut, restored, too small. On stderr, naming the file.
void warn_of_lights(const std::string& in, const LightSet& set);

/// Irradiance and peaks times `factor`.
LightSet brightened(LightSet set, double factor);

nlohmann::ordered_json json_of(const LightSet& set, std::size_t light, const Matrix3& world = {});
/// `{"R": 1, …}`: values by channel.
nlohmann::ordered_json by_channel(const LightSet& set, const std::vector<double>& values);

}  // namespace welkin::cli
