#include "welkin/io/capabilities.h"

#include <algorithm>
#include <cctype>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/io/format.h"

namespace welkin::io {
namespace {

constexpr PixelType kTypes[] = {
    PixelType::uint8,  PixelType::uint16,    PixelType::uint32, PixelType::half,      PixelType::float32,
    PixelType::rgb9e5, PixelType::r11g11b10, PixelType::bc6h,   PixelType::uastc_hdr, PixelType::astc_hdr};

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::string_view name_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return "uint8";
    case PixelType::uint16:
      return "uint16";
    case PixelType::uint32:
      return "uint32";
    case PixelType::half:
      return "half";
    case PixelType::float32:
      return "float";
    case PixelType::rgb9e5:
      return "rgb9e5";
    case PixelType::r11g11b10:
      return "r11g11b10";
    case PixelType::bc6h:
      return "bc6h";
    case PixelType::uastc_hdr:
      return "uastc-hdr";
    case PixelType::astc_hdr:
      return "astc-hdr";
  }
  return "?";
}

bool is_packed(PixelType type) {
  return type == PixelType::rgb9e5 || type == PixelType::r11g11b10 || type == PixelType::bc6h ||
         type == PixelType::uastc_hdr;
}

PixelType pixel_type_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const PixelType type : kTypes) {
    if (name_of(type) == name) return type;
    names.emplace_back(name_of(type));
  }
  throw Error(ErrorKind::bad_request, unknown_name("pixel type", name, names));
}

std::string only_read(const Capabilities& format) {
  return format.title +
         " is only read here, not written (can be written: " + listed(writable_extensions(), ", ") + ")";
}

bool Capabilities::holds(PixelType type) const {
  return std::find(types.begin(), types.end(), type) != types.end();
}

const std::vector<Capabilities>& all_capabilities() {
  static const std::vector<Capabilities> all = [] {
    std::vector<Capabilities> list;
    for (const Format& format : formats()) list.push_back(format.capabilities);
    return list;
  }();
  return all;
}

const Capabilities& capabilities(std::string_view format) {
  std::vector<std::string> names;
  for (const Capabilities& each : all_capabilities()) {
    if (each.format == format) return each;
    names.push_back(each.format);
  }
  throw Error(ErrorKind::bad_request, unknown_name("format", format, names));
}

const Capabilities& capabilities_for(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  for (const Capabilities& each : all_capabilities()) {
    if (std::count(each.extensions.begin(), each.extensions.end(), extension) == 0) continue;
    if (!each.writable) throw Error(ErrorKind::unsupported, path.string(), only_read(each));
    return each;
  }
  throw Error(ErrorKind::bad_request, path.string(),
              extension.empty() ? "the name has no extension to tell the format by (one of: " +
                                      listed(writable_extensions(), ", ") + ")"
                                : unknown_name("extension", extension, writable_extensions()));
}

std::vector<std::string> writable_extensions() {
  std::vector<std::string> names;
  for (const Capabilities& each : all_capabilities()) {
    if (each.writable) names.insert(names.end(), each.extensions.begin(), each.extensions.end());
  }
  return names;
}

}  // namespace welkin::io
