#pragma once

#include <memory>
#include <string>

#include "welkin/brdf/model.h"

/// Measured BRDFs: a grid of angles. Internal to brdf.
namespace welkin::brdf {

/// The model of a grid; `label` begins errors. See AnyBrdf::from_grid.
std::shared_ptr<const AnyBrdf::Model> measured_model(const std::string& label, const std::string& origin,
                                                     MeasuredGrid grid);

/// Reads a table of θi, θr, Δφ (degrees) and value: four numbers a line, separated by blanks or commas, in
/// any order of lines; `#` begins a comment, and the first line may name the columns. Every combination of
/// the angles that occur must be there once. Throws Error, with file and line: no such file, over 256 MiB,
/// what isn't four numbers, angles out of range, values that are negative or not finite, a combination that
/// is missing or given twice, angles that don't begin at 0, or Δφ that doesn't end at 180.
std::shared_ptr<const AnyBrdf::Model> read_measured(const std::string& path, const std::string& origin);

}  // namespace welkin::brdf
