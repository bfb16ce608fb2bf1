#pragma once

#include <memory>

#include "welkin/io/format.h"
#include "welkin/io/heif/functions.h"

/// libheif's objects, owned.
namespace welkin::io::heif {

/// Gives them back.
struct Release {
  void operator()(heif_context* context) const { libheif().heif_context_free(context); }
  void operator()(heif_decoding_options* options) const { libheif().heif_decoding_options_free(options); }
  void operator()(const heif_image_handle* handle) const { libheif().heif_image_handle_release(handle); }
  void operator()(const heif_image* picture) const { libheif().heif_image_release(picture); }
  void operator()(heif_color_profile_nclx* points) const { libheif().heif_nclx_color_profile_free(points); }
};

using Context = std::unique_ptr<heif_context, Release>;
using Handle = std::unique_ptr<const heif_image_handle, Release>;
using Picture = std::unique_ptr<const heif_image, Release>;
using CodePoints = std::unique_ptr<heif_color_profile_nclx, Release>;

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
