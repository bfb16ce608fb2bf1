#pragma once

#include "welkin/base/export.h"
#include "welkin/camera/camera.h"
#include "welkin/filter/resample.h"

/// @file
/// Pictures of the world.
namespace welkin {

/// What a camera sees of the world, as a map whose one chart is the picture: what reads it back, by any of
/// the functions of maps, is the part of the world that it shows. Options as for resample: without
/// `borders` it is a picture to show, whose every pixel outside a disc holds the fill; `rotation` turns the
/// world. Throws as frame_of and resample do; Cancelled.
WELKIN_API Map view(const Map& world, const Camera& camera, const ResampleOptions& options = {});

/// How the pictures of two eyes lie in one.
enum class Pair {
  left_right,  ///< the left eye's on the left
  top_bottom,  ///< the left eye's on top
};

/// The two views in one picture, each of the camera's size, in the channels of the worlds. Throws Error
/// (mismatch) for worlds of other channels, and as view does.
WELKIN_API Image view_pair(const Map& left_world, const Map& right_world, const Camera& camera, Pair pair,
                           const ResampleOptions& options = {});

}  // namespace welkin
