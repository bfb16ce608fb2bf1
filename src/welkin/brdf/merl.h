#pragma once

#include <memory>
#include <string>

#include "welkin/brdf/model.h"

/// The binary files of the MERL database of 100 measured materials. Internal to brdf.
///
///     three 32-bit integers: 90, 90, 180
///     doubles, little endian: red, green, blue, each [θh][θd][φd]
///
/// θh, of the half vector to the normal, goes with the square of its index; θd, of the light to the half
/// vector, and φd, about it, evenly to 90° and 180°. Values are to be multiplied by
/// 1/1500, 1.15/1500, 1.66/1500. Source: Matusik, Pfister, Brand & McMillan 2003, and the database's own
/// reading code.
namespace welkin::brdf {

/// Its luminance, linear between the cells' middles. Negative values, which mark angles that were not
/// measured, become 0, and are counted in the notes. Throws Error: no such file, other sizes than 90 × 90 ×
/// 180, a file that ends early or goes on, values that aren't finite.
std::shared_ptr<const AnyBrdf::Model> read_merl(const std::string& path, const std::string& origin);

}  // namespace welkin::brdf
