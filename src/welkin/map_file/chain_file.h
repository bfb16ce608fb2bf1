#pragma once

#include <filesystem>

#include "welkin/map/chain.h"
#include "welkin/map_file/map_file.h"

/// Chains ↔ files (docs/chains.md).
namespace welkin {

/// Throws Error when a chain of so many levels has no place in such a file, naming the path and the cause: a
/// format without levels, more of them than the size has, a layout in several files or with a safety border,
/// a picture whose levels aren't pictures of halved charts. Always passes for one level.
void check_chain(const std::filesystem::path& path, const MapShape& shape, ChartSize finest, int levels,
                 const WriteMapOptions& options = {});

/// Writes the levels into one file, with the notes; one level alone as write_map does, in any format. Throws
/// as check_chain and write_map do.
io::WriteReport write_chain(const std::filesystem::path& path, const Chain& chain, const Layout& layout,
                            const WriteMapOptions& options = {});

/// All levels of a file; one of a file without levels. Changes the level that the reader is set to.
Chain read_chain(MapReader& reader);
Chain read_chain(const std::filesystem::path& path, const ReadMapOptions& options = {});

}  // namespace welkin
