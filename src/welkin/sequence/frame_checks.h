#pragma once

#include <string>
#include <vector>

#include "welkin/prefilter/prefilter.h"
#include "welkin/sequence/bake_frames.h"
#include "welkin/sequence/frame_plan.h"

/// What can be wrong with a sequence, found before any work.
namespace welkin::sequence {

/// A frame's file, opened as the options say.
MapReader open_frame(const std::filesystem::path& file, const BakeFramesOptions& options, bool pixels);

/// Throws Error (not_found), naming all that are missing, unless every frame of `needed` is among `there`.
/// Both ascend.
void check_sources_there(const FrameNames& in, const std::vector<int>& needed, const std::vector<int>& there);

/// Opens the source of every frame: the shape of all of them, whose `channels` mean nothing yet. Throws Error
/// (mismatch) where one differs from the first.
PrefilterShape check_source_shapes(const FrameNames& in, const std::vector<BakedFrame>& frames,
                                   const BakeFramesOptions& options);
/// Throws that Error for a frame of another shape, channels included.
void check_shape(const std::filesystem::path& file, const PrefilterShape& shape,
                 const std::filesystem::path& first_file, const PrefilterShape& first);

/// Throws Error (bad_request) where a file to write is a frame's source.
void check_apart(const FrameNames& in, const FrameNames& out, const std::vector<int>& sources,
                 const std::vector<int>& frames, const sphere::AnyParameterization& target);

/// A frame's chain. What is remarkable about its values goes to `told`. Throws what BakePlan::run does, and
/// Error (bad_value) that counts them, about `file`.
Chain filter_frame(const BakePlan& plan, const Map& source, const std::filesystem::path& file,
                   std::vector<std::string>& told, const Monitor& monitor);

}  // namespace welkin::sequence
