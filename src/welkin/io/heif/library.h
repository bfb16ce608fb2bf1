#pragma once

#include <libheif/heif.h>

#include <memory>

#include "welkin/io/format.h"

/// libheif's objects, owned.
namespace welkin::io::heif {

using Context = std::unique_ptr<heif_context, void (*)(heif_context*)>;
using Handle = std::unique_ptr<const heif_image_handle, void (*)(const heif_image_handle*)>;
using Picture = std::unique_ptr<const heif_image, void (*)(const heif_image*)>;
using CodePoints = std::unique_ptr<heif_color_profile_nclx, void (*)(heif_color_profile_nclx*)>;

/// Throws libheif's error as one of the kind that it is.
void check(const heif_error& error, const Source& source);

/// The file's primary picture, whose headers are read. `context` refers to source.bytes.
Handle primary_picture(const Context& context, const Source& source);

/// All of its pixels: grey as it is coded, luma and chroma as R G B of as many bits. Rotated, mirrored and
/// cropped as the file says (irot, imir, clap).
Picture decode(const Handle& handle, const Source& source);

/// The code points of the box `colr`. Null where there is none, or with numbers that libheif doesn't know:
/// `doubt` says which then.
CodePoints code_points(const Handle& handle, std::string& doubt);

/// An ICC profile; empty where there is none.
std::vector<std::byte> icc_profile(const Handle& handle, const Source& source);

/// The XMP packet; empty where there is none.
std::string xmp(const Handle& handle, const Source& source);

/// The types, URNs, of the pictures that come with it, besides alpha.
std::vector<std::string> auxiliary_types(const Handle& handle);

}  // namespace welkin::io::heif
