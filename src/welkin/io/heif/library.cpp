#include "welkin/io/heif/library.h"

#include "welkin/base/error.h"

namespace welkin::io::heif {
namespace {

ErrorKind kind_of(const heif_error& error) {
  if (error.subcode == heif_suberror_Security_limit_exceeded) return ErrorKind::too_large;
  switch (error.code) {
    case heif_error_Unsupported_filetype:
    case heif_error_Unsupported_feature:
    case heif_error_Plugin_loading_error:
      return ErrorKind::unsupported;
    default:
      return ErrorKind::damaged;
  }
}

}  // namespace

void check(const heif_error& error, const Source& source) {
  if (error.code == heif_error_Ok) return;
  if (error.code == heif_error_Memory_allocation_error && error.subcode == heif_suberror_Unspecified)
    throw std::bad_alloc();
  throw Error(kind_of(error), source.name, std::string("libheif cannot read it: ") + error.message);
}

Handle primary_picture(const Context& context, const Source& source) {
  check(libheif().heif_context_read_from_memory_without_copy(context.get(), source.bytes.data(),
                                                             source.bytes.size(), nullptr),
        source);
  heif_image_handle* handle = nullptr;
  check(libheif().heif_context_get_primary_image_handle(context.get(), &handle), source);
  return Handle(handle);
}

Picture decode(const Handle& handle, const Source& source) {
  const std::unique_ptr<heif_decoding_options, Release> options(libheif().heif_decoding_options_alloc());
  if (options == nullptr) throw std::bad_alloc();
  options->strict_decoding = 1;
  heif_image* picture = nullptr;
  check(libheif().heif_decode_image(handle.get(), &picture, heif_colorspace_undefined, heif_chroma_undefined,
                                    options.get()),
        source);
  return Picture(picture);
}

CodePoints code_points(const Handle& handle, std::string& doubt) {
  heif_color_profile_nclx* found = nullptr;
  const heif_error error = libheif().heif_image_handle_get_nclx_color_profile(handle.get(), &found);
  CodePoints points(found);
  if (error.code == heif_error_Ok) return points;
  // In spite of the error there is a profile, of other numbers than the file's.
  if (error.code != heif_error_Color_profile_does_not_exist) doubt = error.message;
  points.reset();
  return points;
}

std::vector<std::byte> icc_profile(const Handle& handle, const Source& source) {
  std::vector<std::byte> profile(libheif().heif_image_handle_get_raw_color_profile_size(handle.get()));
  if (!profile.empty())
    check(libheif().heif_image_handle_get_raw_color_profile(handle.get(), profile.data()), source);
  return profile;
}

std::string xmp(const Handle& handle, const Source& source) {
  const int count = libheif().heif_image_handle_get_number_of_metadata_blocks(handle.get(), "mime");
  std::vector<heif_item_id> ids(static_cast<std::size_t>(count));
  libheif().heif_image_handle_get_list_of_metadata_block_IDs(handle.get(), "mime", ids.data(), count);
  for (const heif_item_id id : ids) {
    if (libheif().heif_image_handle_get_metadata_content_type(handle.get(), id) !=
        std::string("application/rdf+xml"))
      continue;
    std::string packet(libheif().heif_image_handle_get_metadata_size(handle.get(), id), '\0');
    if (!packet.empty())
      check(libheif().heif_image_handle_get_metadata(handle.get(), id, packet.data()), source);
    return packet;
  }
  return {};
}

std::vector<std::string> auxiliary_types(const Handle& handle) {
  const int filter = static_cast<int>(LIBHEIF_AUX_IMAGE_FILTER_OMIT_ALPHA);
  const int count = libheif().heif_image_handle_get_number_of_auxiliary_images(handle.get(), filter);
  std::vector<heif_item_id> ids(static_cast<std::size_t>(count));
  libheif().heif_image_handle_get_list_of_auxiliary_image_IDs(handle.get(), filter, ids.data(), count);
  std::vector<std::string> types;
  for (const heif_item_id id : ids) {
    heif_image_handle* found = nullptr;
    if (libheif().heif_image_handle_get_auxiliary_image_handle(handle.get(), id, &found).code !=
        heif_error_Ok)
      continue;
    const Handle auxiliary(found);
    const char* type = nullptr;
    if (libheif().heif_image_handle_get_auxiliary_type(auxiliary.get(), &type).code != heif_error_Ok)
      continue;
    types.emplace_back(type);
    libheif().heif_image_handle_free_auxiliary_types(auxiliary.get(), &type);
  }
  return types;
}

}  // namespace welkin::io::heif
