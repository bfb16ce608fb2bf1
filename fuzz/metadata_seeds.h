#pragma once

#include <filesystem>

namespace welkin::fuzz {

/// Seeds of what files carry beside their pixels: XMP packets, ICC profiles, Exif blocks and gain maps by
/// themselves (root/xmp/…, root/icc/…, root/exif/…, root/gain_map/…), and JPEGs and PNGs that hold them.
void write_metadata_seeds(const std::filesystem::path& root);

}  // namespace welkin::fuzz
