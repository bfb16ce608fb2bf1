#pragma once

#include <libheif/heif.h>

namespace welkin::io::heif {

/// The functions of libheif that are called, by one list.
#define WELKIN_LIBHEIF_FUNCTIONS(EACH)                    \
  EACH(heif_context_alloc)                                \
  EACH(heif_context_free)                                 \
  EACH(heif_context_get_primary_image_handle)             \
  EACH(heif_context_read_from_memory_without_copy)        \
  EACH(heif_decode_image)                                 \
  EACH(heif_decoding_options_alloc)                       \
  EACH(heif_decoding_options_free)                        \
  EACH(heif_image_get_bits_per_pixel_range)               \
  EACH(heif_image_get_chroma_format)                      \
  EACH(heif_image_get_colorspace)                         \
  EACH(heif_image_get_height)                             \
  EACH(heif_image_get_plane_readonly)                     \
  EACH(heif_image_get_width)                              \
  EACH(heif_image_handle_free_auxiliary_types)            \
  EACH(heif_image_handle_get_auxiliary_image_handle)      \
  EACH(heif_image_handle_get_auxiliary_type)              \
  EACH(heif_image_handle_get_height)                      \
  EACH(heif_image_handle_get_list_of_auxiliary_image_IDs) \
  EACH(heif_image_handle_get_list_of_metadata_block_IDs)  \
  EACH(heif_image_handle_get_metadata)                    \
  EACH(heif_image_handle_get_metadata_content_type)       \
  EACH(heif_image_handle_get_metadata_size)               \
  EACH(heif_image_handle_get_nclx_color_profile)          \
  EACH(heif_image_handle_get_number_of_auxiliary_images)  \
  EACH(heif_image_handle_get_number_of_metadata_blocks)   \
  EACH(heif_image_handle_get_raw_color_profile)           \
  EACH(heif_image_handle_get_raw_color_profile_size)      \
  EACH(heif_image_handle_get_width)                       \
  EACH(heif_image_handle_is_premultiplied_alpha)          \
  EACH(heif_image_handle_release)                         \
  EACH(heif_image_has_channel)                            \
  EACH(heif_image_release)                                \
  EACH(heif_nclx_color_profile_free)

/// libheif, loaded: `libheif().heif_image_get_width(…)`.
struct Libheif {
#define WELKIN_MEMBER(NAME) decltype(&::NAME) NAME = nullptr;
  WELKIN_LIBHEIF_FUNCTIONS(WELKIN_MEMBER)
#undef WELKIN_MEMBER
};

/// Loads it at the first call; from any thread. Throws Error (unsupported), as LateLibrary does.
const Libheif& libheif();

}  // namespace welkin::io::heif
