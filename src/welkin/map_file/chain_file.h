#pragma once

#include <filesystem>

#include "welkin/base/export.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/map_file.h"

/// @file
/// Chains ↔ files (docs/chains.md).
namespace welkin {

/// Throws Error when such a file can't hold a chain of so many levels, naming the path and the cause: a
/// format without levels, more of them than the size has, a layout in several files or with a safety border,
/// a picture whose levels aren't pictures of halved charts. Always passes for one level.
WELKIN_API void check_chain(const std::filesystem::path& path, const MapShape& shape, ChartSize finest,
                            int levels, const WriteMapOptions& options = {});

/// Writes the levels into one file, with the notes; one level alone as write_map does, in any format. Throws
/// as check_chain and write_map do, and Error (bad_request) for a chain without levels, (mismatch) for levels
/// whose sizes, channels or orientations don't belong together.
WELKIN_API io::WriteReport write_chain(const std::filesystem::path& path, const Chain& chain,
                                       const Layout& layout, const WriteMapOptions& options = {});
/// The same in the layout that such a file gets by default (default_layout).
WELKIN_API io::WriteReport write_chain(const std::filesystem::path& path, const Chain& chain,
                                       const WriteMapOptions& options = {});
/// The same into a sink, in the format of that name: `ktx2`, `exr`.
WELKIN_API io::WriteReport write_chain(io::ByteSink& sink, std::string_view format, const Chain& chain,
                                       const WriteMapOptions& options = {});

/// All levels of a file; one of a file without levels. Their borders are filled. Changes the level that the
/// reader is set to. Throws as MapReader::read does.
WELKIN_API Chain read_chain(MapReader& reader);
/// Opens and reads.
WELKIN_API Chain read_chain(const std::filesystem::path& path, const ReadMapOptions& options = {});

/// From memory, which must last until this returns; `name` stands for the path in messages.
WELKIN_API Chain read_chain(std::span<const std::byte> bytes, const std::string& name,
                            const ReadMapOptions& options = {});

}  // namespace welkin
