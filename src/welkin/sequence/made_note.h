#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "welkin/base/export.h"
#include "welkin/sequence/bake_frames.h"
#include "welkin/sequence/frame_names.h"

/// @file
/// What a frame's file says of what it was made from, so that an interrupted sequence can go on.
namespace welkin::sequence {

/// Text metadata of a frame's file.
inline constexpr const char* kFrameKey = "welkin.frame";

/// Sixteen hexadecimal digits that differ, but for chance, where anything differs that the outputs depend on
/// beside the frames' own files: their names, how they are read, filtered and written, the library's version.
WELKIN_API std::string request_digest(const FrameNames& in, const BakeFramesOptions& options);

/// The same of a request in any words, and of the library's version.
WELKIN_API std::string digest_of(std::string_view request);

/// `12 (6f0e…)` of a frame that was baked; `0.7*11 + 0.3*21 (6f0e…)` of one between two others.
/// @{
WELKIN_API std::string made_note(int frame, const std::string& digest);
WELKIN_API std::string made_note(int from, int to, int frame, const std::string& digest);
/// @}

/// Whether a frame's files are there, say `note`, and were written after all files of the sources, which may
/// have a `%s`. Files that can't be read are not.
WELKIN_API bool is_made(std::span<const std::filesystem::path> files, const std::string& note,
                        std::span<const std::filesystem::path> sources);

}  // namespace welkin::sequence
