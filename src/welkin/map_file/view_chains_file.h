#pragma once

#include <filesystem>

#include "welkin/base/export.h"
#include "welkin/map/lobe_sums.h"
#include "welkin/map/view_chains.h"
#include "welkin/map_file/chain_file.h"

/// @file
/// Stacks of angles of view, and chains with tables of lobes to add, ↔ files (docs/view-dependent-lobes.md).
namespace welkin {

/// Writes a stack into one file: a KTX2, whose layers are the angles of view, with all levels; or an EXR,
/// whose parts they are, of one level. The notes go into the file's text metadata, as `welkin.view-…`. Throws
/// as ViewChains::check and write_chain do, and Error (unsupported) for other formats and for EXR of several
/// levels.
WELKIN_API io::WriteReport write_view_chains(const std::filesystem::path& path, const ViewChains& stack,
                                             const WriteMapOptions& options = {});

/// The stack of a file, borders filled. Throws as read_chain does, and Error (unsupported) for a file that
/// isn't a stack of ours, (damaged) for one whose notes don't fit it.
WELKIN_API ViewChains read_view_chains(const std::filesystem::path& path, const ReadMapOptions& options = {});

/// Writes a chain as write_chain does, with its tables of lobes as text metadata, `welkin.lobes-…`: other
/// programs see an ordinary chain. Throws as LobeSumChain::check and write_chain do.
WELKIN_API io::WriteReport write_lobe_sums(const std::filesystem::path& path, const LobeSumChain& chain,
                                           const WriteMapOptions& options = {});

/// The chain of such a file. Throws as read_chain does, and Error (unsupported) for a file without tables,
/// (damaged) for one whose tables don't fit it.
WELKIN_API LobeSumChain read_lobe_sums(const std::filesystem::path& path, const ReadMapOptions& options = {});

}  // namespace welkin
