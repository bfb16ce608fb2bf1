#pragma once

#include <optional>
#include <string>
#include <vector>

#include "welkin/io/image_file.h"
#include "welkin/map/map.h"
#include "welkin/map_file/map_file.h"

/// Metadata of panoramas ↔ parameterizations and orientations (docs/conventions.md). Internal to map files.
namespace welkin::map_file {

/// The parameterization that the metadata declare, as text, for a picture (of one eye) of this size; empty
/// where they declare none, or what can't be obeyed, of which a warning tells.
std::string shape_of(const io::Panorama& panorama, ChartSize picture, std::vector<std::string>& warnings);

/// From a world whose +Z is north to the panorama. None where the metadata say nothing of it, or no numbers.
std::optional<Matrix3> orientation_of(const io::Panorama& panorama);

/// Warns where the metadata declare another part of the world than the shape is.
void tell_unused_panorama(ChartSize picture, MapFileInfo& info);

/// The pose in words.
std::string pose_text(const io::Panorama& panorama);

/// The metadata of a map that is a lat-long, or part of one, as whole texels of a full one; none of others.
std::optional<io::Panorama> panorama_of(const MapFrame& frame);

}  // namespace welkin::map_file
