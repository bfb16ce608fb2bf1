#pragma once

#include <array>
#include <span>

#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// A smooth function on a lat-long grid, read by a cubic spline.
namespace welkin::prefilter {

/// Columns [first, last) of the western half and their counterparts 180° on: values become
/// coefficients of the cubic B-spline along the meridian, the great circle that the two halves make (M.
/// Unser, A. Aldroubi & M. Eden, "B-spline signal processing", 1993, part I, eqs. 2.5; poles z = √3 − 2).
/// Values must have been multiplied by 6; those along rows are coefficients already.
void to_spline_columns(Level& grid, int first, int last);

/// All columns of all grids, and then their borders. Throws Cancelled.
void to_splines(std::span<Level> grids, const Monitor& monitor);

/// Fills sixteen rows of one channel of a grid from `lanes`, [column][16]: `rows` are at their first values,
/// null where a lane isn't wanted.
void store_lanes(const float* lanes, const std::array<float*, 16>& rows, const Level& grid);

}  // namespace welkin::prefilter
