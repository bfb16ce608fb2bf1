#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Folders that hold a set: files that appear together.
namespace welkin {

/// A file for a folder.
struct FolderFile {
  std::string name;                  ///< without a folder
  std::span<const std::byte> bytes;  ///< all of it
};

/// Throws Error unless a set of files of these names can be written to a folder, which need not exist beside
/// its parent: (bad_request) where one of them is there and no manifest of a set lists it, so that it is
/// somebody's own; (denied, not_found, system) of the folder. Nothing is left behind.
WELKIN_API void check_set_folder(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Writes them all, then renames them, so that nothing appears under its name while another may still fail
/// for want of space. Files of an earlier set are replaced; all else stays. Returns the names that the
/// earlier set's manifest lists and this one doesn't replace. Throws as check_set_folder.
WELKIN_API std::vector<std::string> write_set_folder(const std::filesystem::path& folder,
                                                     std::span<const FolderFile> files);

}  // namespace welkin
