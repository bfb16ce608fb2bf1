#pragma once

#include <filesystem>
#include <functional>

#include "welkin/base/export.h"
#include "welkin/filter/resample.h"
#include "welkin/map_file/map_file.h"

/// @file
/// A map resampled while its file is written.
namespace welkin {

/// How a map is resampled and written at once.
struct WriteResampledOptions {
  ResampleOptions resample;  ///< `borders` is of no account
  Matrix3 orientation;       ///< of the map that is written
  float factor = 1;          ///< times every value, but for the channel A (scale)
  ChainNotes notes;          ///< what the file says of its level
  WriteMapOptions write;     ///< of the file
  /// Is given the texels that are made, before `factor`: whole rows of a chart, from row y on, all of them at
  /// least once. From several threads at once. What it throws ends the work, and comes out of the call.
  std::function<void(int chart, int y, ImageView<const float> rows)> made = nullptr;
};

/// Writes what the source becomes as a map of this shape and size: the same file as by resample() without
/// borders (with them, where a safety border is written), scale() and write_chain() of the one level. The map
/// itself is never in memory as a whole, as far as the format is written row by row: its texels are made when
/// their turn comes; but for a safety border, in cells that are rotated or mirrored for Filter::automatic,
/// and in cells on their side for `made`. The source's borders must be filled. Throws as these do, and what a
/// callback of the monitor throws; nothing is left behind then.
WELKIN_API io::WriteReport write_resampled(const std::filesystem::path& path, const Map& source,
                                           const MapShape& shape, ChartSize size,
                                           const WriteResampledOptions& options = {});

}  // namespace welkin
