#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

/// Files that people hold and that are not read: what they are, and what makes them readable.
namespace welkin::io {

/// What to say of a file of a known kind that no format here reads, as `a DDS texture, which is not read;
/// convert it with …`. Nothing for bytes of no kind that is known.
std::optional<std::string> unread_format(std::span<const std::byte> bytes);

/// The same for cameras' raw files that are TIFFs by their first bytes: their own pictures are reduced ones,
/// or single colours behind a filter.
std::optional<std::string> camera_raw(std::span<const std::byte> bytes);

}  // namespace welkin::io
