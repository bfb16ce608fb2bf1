#include "welkin/io/env/manifest.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "welkin/base/error.h"
#include "welkin/io/member.h"

namespace welkin::io::env {
namespace {

using nlohmann::ordered_json;

/// Of WriteOptions::irradiance, in its order.
constexpr const char* kTerms[] = {"x", "y", "z", "xx", "yy", "zz", "yz", "zx", "xy"};
constexpr const char* kOurs = "welkin";

[[noreturn]] void damaged(const Source& source, const std::string& cause) {
  throw Error(ErrorKind::damaged, source.name, cause);
}

int face_width(const Source& source, const ordered_json& json) {
  const ordered_json& width = member(json, "width");
  if (!width.is_number_unsigned()) damaged(source, "its manifest has no width");
  const auto value = width.get<std::uint64_t>();
  if (value < 1 || value > kLargestRgbdFace || !std::has_single_bit(value))
    damaged(source, "its faces are " + std::to_string(value) + " wide, no power of two up to " +
                        std::to_string(kLargestRgbdFace));
  return static_cast<int>(value);
}

Extent extent_of(const Source& source, const ordered_json& entry, std::size_t index,
                 std::uint64_t images_at) {
  const ordered_json &position = member(entry, "position"), &length = member(entry, "length");
  const std::string image = "image " + std::to_string(index);
  if (!position.is_number_unsigned() || !length.is_number_unsigned())
    damaged(source, image + " has no position or no length");
  const auto at = position.get<std::uint64_t>(), size = length.get<std::uint64_t>();
  const std::uint64_t room = source.bytes.size() - images_at;
  if (at > room || size > room - at)
    damaged(source, image + ", of " + std::to_string(size) + " bytes from byte " +
                        std::to_string(at > room ? at : images_at + at) + " on, passes the end of the file");
  return {images_at + at, size};
}

}  // namespace

Manifest parse_manifest(const Source& source) {
  const std::span<const std::byte> after = source.bytes.subspan(std::min(sizeof kMagic, source.bytes.size()));
  const auto limit = after.begin() + static_cast<std::ptrdiff_t>(std::min(after.size(), kLongestManifest));
  const auto end = std::find(after.begin(), limit, std::byte{0});
  if (end == limit)
    damaged(source, "its manifest has no end within " + std::to_string(limit - after.begin()) + " bytes");
  const auto length = static_cast<std::size_t>(end - after.begin());
  const char* text = reinterpret_cast<const char*>(after.data());
  const ordered_json json = ordered_json::parse(text, text + length, nullptr, false);
  if (!json.is_object()) damaged(source, "its manifest is no JSON object");

  const ordered_json& version = member(json, "version");
  if (!version.is_number_unsigned() || version.get<std::uint64_t>() < 1)
    damaged(source, "its manifest has no version");
  if (version.get<std::uint64_t>() > 2)
    throw Error(ErrorKind::unsupported, source.name,
                "is of version " + std::to_string(version.get<std::uint64_t>()) + ": 1 and 2 are read");
  Manifest manifest;
  manifest.width = face_width(source, json);
  manifest.levels = static_cast<int>(std::bit_width(static_cast<unsigned>(manifest.width)));
  const ordered_json& specular = member(json, "specular");
  const ordered_json& mipmaps = member(specular, "mipmaps");
  const std::size_t wanted = 6 * static_cast<std::size_t>(manifest.levels);
  if (!mipmaps.is_array() || mipmaps.size() != wanted)
    damaged(source, "faces of " + std::to_string(manifest.width) + " take " + std::to_string(wanted) +
                        " images, not " + std::to_string(mipmaps.is_array() ? mipmaps.size() : 0));
  const std::uint64_t images_at = sizeof kMagic + length + 1;
  for (const ordered_json& entry : mipmaps)
    manifest.images.push_back(extent_of(source, entry, manifest.images.size(), images_at));
  if (const ordered_json& scale = member(specular, "lodGenerationScale"); scale.is_number()) {
    const double value = scale.get<double>();
    if (std::isfinite(value) && value > 0) manifest.lod_scale = value;
  }
  manifest.irradiance = member(member(json, "irradiance"), "xx").is_array();
  manifest.attributes = text_members(member(json, kOurs));
  return manifest;
}

std::string manifest_text(int width, const std::vector<std::uint64_t>& image_bytes,
                          const std::vector<double>& irradiance,
                          const std::map<std::string, std::string>& attributes) {
  ordered_json json{{"version", 2}, {"width", width}, {"imageType", "image/png"}};
  for (std::size_t i = 0; i + 2 < irradiance.size(); i += 3)
    json["irradiance"][kTerms[i / 3]] = {irradiance[i], irradiance[i + 1], irradiance[i + 2]};
  ordered_json mipmaps = ordered_json::array();
  std::uint64_t position = 0;
  for (const std::uint64_t bytes : image_bytes) {
    mipmaps.push_back({{"length", bytes}, {"position", position}});
    position += bytes;
  }
  json["specular"] = {{"mipmaps", std::move(mipmaps)}, {"lodGenerationScale", 0.8}};
  for (const auto& [key, value] : attributes) json[kOurs][key] = value;
  // Babylon.js reads a character a byte.
  return json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

}  // namespace welkin::io::env
