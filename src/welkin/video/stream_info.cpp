#include "welkin/video/stream_info.h"

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin::video {
namespace {

/// The place of a name among others.
std::size_t index_of(std::string_view name, const std::vector<std::string>& names, const char* kind) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(ErrorKind::bad_request, unknown_name(kind, std::string(name), names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

const std::vector<std::string>& stream_kind_names() {
  static const std::vector<std::string> names{"y4m", "ppm", "pfm"};
  return names;
}

StreamKind stream_kind_from_name(std::string_view name) {
  return static_cast<StreamKind>(index_of(name, stream_kind_names(), "kind of stream"));
}

std::string_view name_of(StreamKind kind) {
  return stream_kind_names()[static_cast<std::size_t>(kind)];
}

const std::vector<std::string>& yuv_matrix_names() {
  static const std::vector<std::string> names{"bt601", "bt709", "bt2020"};
  return names;
}

YuvMatrix yuv_matrix_from_name(std::string_view name) {
  return static_cast<YuvMatrix>(index_of(name, yuv_matrix_names(), "matrix"));
}

}  // namespace welkin::video
