#pragma once

#include <filesystem>
#include <vector>

#include "welkin/map/chain_notes.h"
#include "welkin/map/map_file.h"

/// Chains: the levels of a texture, each half as large as the one before (docs/chains.md).
namespace welkin {

struct Chain {
  /// Level 0, the finest, first. Level k's charts have chain_size(level 0's, k); the parameterization
  /// (at_size), orientation and channels are the same in all. At least one.
  std::vector<Map> levels;
  ChainNotes notes;
};

/// Charts of level k: max(1, side >> k).
ChartSize chain_size(ChartSize finest, int level);

/// How many levels charts of this size have, down to 1×1.
int most_levels(ChartSize finest);

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
