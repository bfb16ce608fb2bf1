#include "welkin/io/glb/container.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/member.h"

namespace welkin::io::glb {
namespace {

using nlohmann::ordered_json;

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
/// Of scenes with much else in them.
constexpr std::size_t kLongestJson = std::size_t{64} << 20;
constexpr const char* kOurs = "welkin";

[[noreturn]] void damaged(const Source& source, const std::string& cause) {
  throw Error(ErrorKind::damaged, source.name, cause);
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, std::endian::little);
}

/// The element, or null where there is none.
const ordered_json& element(const ordered_json& array, const ordered_json& index) {
  static const ordered_json none;
  if (!array.is_array() || !index.is_number_unsigned()) return none;
  const auto at = index.get<std::uint64_t>();
  return at < array.size() ? array[at] : none;
}

struct Chunks {
  ordered_json json;
  std::span<const std::byte> binary;
};

Chunks chunks_of(const Source& source) {
  const std::span<const std::byte> bytes = source.bytes;
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) damaged(source, "ends within its header");
  if (word_at(bytes, 4) != kVersion)
    throw Error(ErrorKind::unsupported, source.name,
                "is glTF of version " + std::to_string(word_at(bytes, 4)) + ": 2 is read");
  Chunks chunks;
  for (std::size_t at = kHeaderBytes, number = 0; at + kChunkHeaderBytes <= bytes.size() && number < 2;
       ++number) {
    const std::size_t length = word_at(bytes, at), kind = word_at(bytes, at + 4);
    at += kChunkHeaderBytes;
    if (length > bytes.size() - at)
      damaged(source, "a chunk of " + std::to_string(length) + " bytes passes the end of the file");
    const std::span<const std::byte> chunk = bytes.subspan(at, length);
    if (kind == kJson && number == 0) {
      if (length > kLongestJson) damaged(source, "its JSON has " + std::to_string(length) + " bytes");
      const char* text = reinterpret_cast<const char*>(chunk.data());
      chunks.json = ordered_json::parse(text, text + length, nullptr, false);
    } else if (kind == kBinary) {
      chunks.binary = chunk;
    }
    at += length;
  }
  if (!chunks.json.is_object()) damaged(source, "its first chunk is no JSON object");
  return chunks;
}

/// The bytes of an image.
std::span<const std::byte> image_of(const Source& source, const Chunks& chunks, const ordered_json& index) {
  const ordered_json& image = element(member(chunks.json, "images"), index);
  if (!image.is_object()) damaged(source, "its light names an image that there isn't");
  if (!member(image, "uri").is_null())
    throw Error(ErrorKind::unsupported, source.name,
                "the images of its light lie in other files; pack them into the .glb");
  const ordered_json& view = element(member(chunks.json, "bufferViews"), member(image, "bufferView"));
  const ordered_json &begin = member(view, "byteOffset"), &size = member(view, "byteLength"),
                     &buffer = member(view, "buffer");
  if (!size.is_number_unsigned() || !(begin.is_null() || begin.is_number_unsigned()))
    damaged(source, "an image of its light lies nowhere");
  if (!buffer.is_number_unsigned() || buffer.get<std::uint64_t>() != 0)
    throw Error(ErrorKind::unsupported, source.name,
                "the images of its light lie in another buffer; pack them into the .glb");
  const auto at = begin.is_null() ? 0 : begin.get<std::uint64_t>(), length = size.get<std::uint64_t>();
  if (at > chunks.binary.size() || length > chunks.binary.size() - at)
    damaged(source,
            "an image of its light, of " + std::to_string(length) + " bytes, passes the end of the file");
  return chunks.binary.subspan(at, length);
}

/// The light of the scene that is shown, of a file with several.
const ordered_json& chosen_light(const ordered_json& json, const ordered_json& lights) {
  const ordered_json& scenes = member(json, "scenes");
  const ordered_json& shown = member(json, "scene");
  const ordered_json& scene =
      shown.is_null() && scenes.is_array() && !scenes.empty() ? scenes[0] : element(scenes, shown);
  const ordered_json& light =
      element(lights, member(member(member(scene, "extensions"), kExtension), "light"));
  return light.is_object() ? light : lights[0];
}

void read_numbers(const Source& source, const ordered_json& light, Light& read) {
  if (const ordered_json& intensity = member(light, "intensity"); intensity.is_number())
    read.intensity = intensity.get<double>();
  if (!(read.intensity >= 0) || !std::isfinite(read.intensity))
    damaged(source, "its light's intensity is no brightness");
  const ordered_json& rotation = member(light, "rotation");
  if (rotation.is_null()) return;
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!rotation.is_array() || rotation.size() != 4 || !rotation[i].is_number())
      damaged(source, "its light's rotation is no quaternion");
    read.rotation[i] = rotation[i].get<double>();
    square += read.rotation[i] * read.rotation[i];
  }
  if (!(square > 0) || !std::isfinite(square)) damaged(source, "its light's rotation is no quaternion");
  for (double& value : read.rotation) value /= std::sqrt(square);
}

void append(std::vector<std::byte>& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
}

/// Chunks and images begin at multiples of four bytes.
std::size_t padded(std::size_t size) {
  return (size + 3) & ~std::size_t{3};
}

}  // namespace

bool matches(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && word_at(bytes, 0) == kMagic;
}

Light parse_light(const Source& source) {
  const Chunks chunks = chunks_of(source);
  const ordered_json& lights = member(member(member(chunks.json, "extensions"), kExtension), "lights");
  if (!lights.is_array() || lights.empty())
    throw Error(ErrorKind::unsupported, source.name,
                std::string("is a glTF file without an image-based light (") + kExtension + ")");
  const ordered_json& light = chosen_light(chunks.json, lights);
  Light read;
  read.lights = lights.size();
  const ordered_json& width = member(light, "specularImageSize");
  if (!width.is_number() || !(width.get<double>() >= 1 && width.get<double>() <= kLargestRgbdFace))
    damaged(source, "its light's specularImageSize is none of 1 … " + std::to_string(kLargestRgbdFace));
  read.width = static_cast<int>(width.get<double>());
  if (!std::has_single_bit(static_cast<unsigned>(read.width)))
    damaged(source, "its light's faces are " + std::to_string(read.width) + " wide, no power of two");
  const ordered_json& levels = member(light, "specularImages");
  const std::size_t most = std::bit_width(static_cast<unsigned>(read.width));
  if (!levels.is_array() || levels.empty() || levels.size() > most)
    damaged(source, "its light has no specularImages of 1 to " + std::to_string(most) + " levels");
  for (const ordered_json& faces : levels) {
    if (!faces.is_array() || faces.size() != 6) damaged(source, "a level of its light has no six faces");
    for (const ordered_json& index : faces) read.images.push_back(image_of(source, chunks, index));
  }
  read_numbers(source, light, read);
  read.attributes = text_members(member(member(light, "extras"), kOurs));
  return read;
}

std::vector<std::byte> file_of(int width, const std::vector<std::vector<std::byte>>& images,
                               const std::vector<double>& irradiance,
                               const std::map<std::string, std::string>& attributes) {
  ordered_json light{{"intensity", 1.0}, {"rotation", {0.0, 0.0, 0.0, 1.0}}};
  for (std::size_t i = 0; i + 2 < irradiance.size(); i += 3)
    light["irradianceCoefficients"].push_back({irradiance[i], irradiance[i + 1], irradiance[i + 2]});
  light["specularImageSize"] = width;
  for (const auto& [key, value] : attributes) light["extras"][kOurs][key] = value;

  ordered_json json{{"asset", {{"version", "2.0"}, {"generator", "Welkin"}}}};
  std::size_t size = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    light["specularImages"][i / 6].push_back(i);
    json["images"].push_back({{"bufferView", i}, {"mimeType", "image/png"}});
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", size}, {"byteLength", images[i].size()}});
    size += padded(images[i].size());
  }
  json["buffers"] = ordered_json::array({{{"byteLength", size}}});
  json["extensionsUsed"] = {kExtension};
  json["extensions"][kExtension]["lights"].push_back(std::move(light));
  json["scene"] = 0;
  json["scenes"].push_back({{"extensions", {{kExtension, {{"light", 0}}}}}});

  std::string text = json.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  text.resize(padded(text.size()), ' ');
  const std::size_t whole = kHeaderBytes + 2 * kChunkHeaderBytes + text.size() + size;
  if (whole > 0xFFFFFFFF) throw Error(ErrorKind::unsupported, "a .glb holds no more than 4 GiB");
  std::vector<std::byte> bytes;
  bytes.reserve(whole);
  for (const std::size_t word :
       {std::size_t{kMagic}, std::size_t{kVersion}, whole, text.size(), std::size_t{kJson}})
    append(bytes, static_cast<std::uint32_t>(word));
  const auto characters = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), characters.begin(), characters.end());
  append(bytes, static_cast<std::uint32_t>(size));
  append(bytes, kBinary);
  for (const std::vector<std::byte>& image : images) {
    bytes.insert(bytes.end(), image.begin(), image.end());
    bytes.resize(padded(bytes.size()));
  }
  return bytes;
}

}  // namespace welkin::io::glb
