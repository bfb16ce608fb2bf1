// Before tinygltf, which is told not to bring its own copy.
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "welkin/scene/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "welkin/base/error.h"

namespace welkin::scene {
namespace {

using nlohmann::json;

[[noreturn]] void damaged(const std::string& cause) {
  throw Error(ErrorKind::damaged, cause);
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return word;
}

/// The chunks of a .glb: JSON, and binary data if there is any.
struct Chunks {
  std::string_view text;
  std::span<const std::byte> data;
  bool has_data = false;
};

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Chunks chunks_of(std::span<const std::byte> bytes) {
  Chunks chunks;
  if (bytes.size() < 4 || as_text(bytes.first(4)) != "glTF") return {as_text(bytes), {}, false};
  if (bytes.size() < 20) damaged("the .glb ends in its header");
  if (word_at(bytes, 4) != 2)
    throw Error(ErrorKind::unsupported,
                "is of version " + std::to_string(word_at(bytes, 4)) + " of the container; glTF 2.0 is read");
  if (word_at(bytes, 8) > bytes.size())
    damaged("the .glb should have " + std::to_string(word_at(bytes, 8)) + " bytes, and has " +
            std::to_string(bytes.size()) + ": is it cut off?");
  bytes = bytes.first(word_at(bytes, 8));
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::uint32_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
    if (size > bytes.size() - at - 8)
      damaged("a chunk of the .glb leaves the file (byte " + std::to_string(at) + ")");
    const auto content = bytes.subspan(at + 8, size);
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (at == 12 && type != kJson) damaged("the first chunk of the .glb is no JSON");
    if (type == kJson && chunks.text.empty()) chunks.text = as_text(content);
    if (type == kBinary && !chunks.has_data) {
      chunks.data = content;
      chunks.has_data = true;
    }
    at += 8 + ((std::size_t{size} + 3) & ~std::size_t{3});
  }
  return chunks;
}

/// Deep nesting would overflow the stack of those who walk the tree.
void check_depth(std::string_view text) {
  constexpr int kDeepest = 64;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) damaged("its JSON is nested more than 64 deep");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

std::vector<std::byte> from_base64(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t held = 0;
  int bits = 0;
  for (const char c : text) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) damaged("a data URI has a character that base64 doesn't have");
    held = held << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::byte>(held >> bits & 0xff));
    }
  }
  return bytes;
}

/// %20 and its like.
std::string from_percent(const std::string& text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
      plain += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

HeldBytes resolve(const std::string& uri, const SceneInput& input) {
  if (!uri.starts_with("data:")) return input.open_beside(from_percent(uri));
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos)
    damaged("a data URI is not in base64");
  auto bytes = std::make_shared<std::vector<std::byte>>(from_base64(std::string_view(uri).substr(comma + 1)));
  return {*bytes, bytes};
}

const json* member(const json& object, const char* key) {
  const auto at = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && at != object.end() ? &*at : nullptr;
}

std::string text_of(const json& object, const char* key) {
  const json* value = member(object, key);
  return value && value->is_string() ? value->get<std::string>() : "";
}

/// Takes a list out of the file.
json taken(json& root, const char* key) {
  json list = json::array();
  if (const auto at = root.find(key); at != root.end()) {
    list = std::move(*at);
    root.erase(at);
  }
  if (!list.is_array()) damaged(std::string("its '") + key + "' are no list");
  return list;
}

void open_buffers(const json& list, const Chunks& chunks, const SceneInput& input, GltfFile& file) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string what = "buffer " + std::to_string(i);
    const json* declared = member(list[i], "byteLength");
    if (!declared || !declared->is_number_unsigned()) damaged(what + " has no byteLength");
    const std::uint64_t length = declared->get<std::uint64_t>();
    HeldBytes held{chunks.data, nullptr};
    if (member(list[i], "uri")) {
      held = resolve(text_of(list[i], "uri"), input);
    } else if (i != 0 || !chunks.has_data) {
      // Extensions (EXT_meshopt_compression) have buffers without bytes.
      held.bytes = {};
      if (!member(list[i], "extensions")) damaged(what + " has no bytes");
    }
    if (!held.bytes.empty() && held.bytes.size() < length)
      damaged(what + " should have " + std::to_string(length) + " bytes, and has " +
              std::to_string(held.bytes.size()));
    held.bytes = held.bytes.first(std::min<std::uint64_t>(length, held.bytes.size()));
    file.buffers.push_back(std::move(held));
  }
}

void open_images(const json& list, const SceneInput& input, GltfFile& file) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    GltfImage image;
    image.name = text_of(list[i], "name");
    const std::string uri = text_of(list[i], "uri");
    if (image.name.empty() && !uri.starts_with("data:")) image.name = uri;
    if (image.name.empty()) image.name = "image " + std::to_string(i);
    try {
      if (const json* view = member(list[i], "bufferView"); view && view->is_number_integer()) {
        const auto index = view->get<std::int64_t>();
        if (index < 0 || index >= static_cast<std::int64_t>(file.model.bufferViews.size()))
          damaged("is in a buffer view that there isn't");
        image.data = {view_of(file, static_cast<int>(index)).bytes, nullptr};
      } else if (!uri.empty()) {
        image.data = resolve(uri, input);
      } else {
        damaged("has neither a file nor a buffer view");
      }
    } catch (const Error& error) {
      image.fault = error.what();
    }
    file.images.push_back(std::move(image));
  }
}

}  // namespace

GltfFile open_gltf(const SceneInput& input) {
  const Chunks chunks = chunks_of(input.bytes);
  constexpr std::size_t kLargest = std::size_t{1} << 30;
  if (chunks.text.size() > kLargest) throw Error(ErrorKind::too_large, "its JSON has over 1 GiB");
  check_depth(chunks.text);
  json root;
  try {
    root = json::parse(chunks.text);
  } catch (const json::exception& error) {
    damaged(std::string("its JSON can't be read: ") + error.what());
  }
  if (!root.is_object() || !member(root, "asset")) damaged("is no glTF: its JSON has no 'asset'");
  const std::string version = text_of(root["asset"], "version");
  if (!version.starts_with("2."))
    throw Error(ErrorKind::unsupported, "is glTF of version '" + version + "'; 2.0 is read");
  const json buffers = taken(root, "buffers"), images = taken(root, "images");

  GltfFile file;
  std::string error, warning;
  try {
    const std::string text = root.dump();
    tinygltf::TinyGLTF reader;
    if (!reader.LoadASCIIFromString(&file.model, &error, &warning, text.c_str(),
                                    static_cast<unsigned int>(text.size()), ""))
      damaged("is no valid glTF: " + error.substr(0, error.find('\n')));
  } catch (const json::exception& fault) {
    damaged(std::string("is no valid glTF: ") + fault.what());
  } catch (const std::logic_error& fault) {
    damaged(std::string("is no valid glTF: ") + fault.what());
  }
  open_buffers(buffers, chunks, input, file);
  open_images(images, input, file);
  return file;
}

GltfView view_of(const GltfFile& file, int index) {
  const std::string what = "buffer view " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.bufferViews.size())
    damaged("there is no " + what);
  const tinygltf::BufferView& view = file.model.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= file.buffers.size())
    damaged(what + " is of a buffer that there isn't");
  const auto bytes = file.buffers[static_cast<std::size_t>(view.buffer)].bytes;
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
    damaged(what + " leaves its buffer");
  return {bytes.subspan(view.byteOffset, view.byteLength), view.byteStride};
}

double number_of(const tinygltf::Value& object, const char* key, double other) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return other;
  return object.Get(key).GetNumberAsDouble();
}

}  // namespace welkin::scene
