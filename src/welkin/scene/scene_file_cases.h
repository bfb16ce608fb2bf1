#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"
#include "welkin/scene/scene_input.h"

/// @file
/// Scenes in memory, for the tests of readers.
namespace welkin::scene {

using Bytes = std::vector<std::byte>;

template <class T>
void append(Bytes& bytes, std::initializer_list<T> values) {
  for (const T value : values) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    std::memcpy(bytes.data() + at, &value, sizeof value);
  }
}

inline Bytes bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

inline std::string base64(const Bytes& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

/// A PNG of 2 × 1 texels, sRGB 188 0 255 and 0 188 0, the second with half of the coverage.
inline Bytes small_png() {
  Image image(2, 1, 4);
  const float texels[] = {0.502886f, 0, 1, 1, 0, 0.502886f * 0.501961f, 0, 0.501961f};
  std::copy(std::begin(texels), std::end(texels), image.at(0, 0));
  io::MemorySink sink;
  io::WritePart part;
  part.image = image.view();
  part.channels = {"R", "G", "B", "A"};
  io::write(sink, "png", std::span(&part, 1), {.type = io::PixelType::uint8});
  const auto bytes = sink.bytes();
  return {bytes.begin(), bytes.end()};
}

/// A square in the plane z = 0 that faces +Z: interleaved positions, normals and coordinates (4 × 32 bytes),
/// then indices of 16 bits (12 bytes).
inline Bytes square_bytes() {
  Bytes bytes;
  const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& [x, y] : corners) append<float>(bytes, {x, y, 0, 0, 0, 1, x, 1 - y});
  append<std::uint16_t>(bytes, {0, 1, 2, 0, 2, 3});
  return bytes;
}

/// With more of the file's JSON, and other lists in place of these.
inline std::string gltf_text(const Bytes& buffer, const std::string& materials = "{}",
                             const std::string& nodes = R"({"mesh":0})", const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"name":"square","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},)"
         R"("indices":3,"material":0}]}],"materials":[)" +
         materials +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":0,"byteOffset":12,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":0,"byteOffset":24,"componentType":5126,"count":4,"type":"VEC2"},)"
         R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":128,"byteStride":32},{"buffer":0,"byteOffset":128,"byteLength":12}],)"
         R"("buffers":[{"byteLength":140,"uri":"data:application/octet-stream;base64,)" +
         base64(buffer) + R"("}])" + more + "}";
}

/// Files that lie beside a scene.
using Folder = std::map<std::string, Bytes>;

inline Scene read_bytes(const Bytes& bytes, const std::string& name, const Folder& folder = {}) {
  SceneInput input{name, bytes, nullptr};
  input.picture_bytes = std::uint64_t{64} << 20;
  input.open_beside = [&](const std::string& file) -> HeldBytes {
    const auto at = folder.find(file);
    if (at == folder.end()) throw Error(ErrorKind::not_found, file, "no such file");
    return {at->second, nullptr};
  };
  return read_scene(input);
}

/// The error that reading ends in; its kind, and its message in `message`.
inline ErrorKind fault_of(const Bytes& bytes, const std::string& name, std::string* message = nullptr,
                          const Folder& folder = {}) {
  try {
    read_bytes(bytes, name, folder);
  } catch (const Error& error) {
    if (message) *message = error.what();
    return error.kind();
  }
  if (message) *message = "nothing is wrong";
  return ErrorKind::bad_request;  // which readers never throw
}

/// Reads it damaged: cut off at every length or so, and with bytes changed. What comes out is a sound scene
/// or an Error; returns how many were refused.
inline int read_damaged(const Bytes& whole, const std::string& name, const Folder& folder = {}) {
  int refused = 0;
  const auto attempt = [&](const Bytes& bytes) {
    try {
      read_bytes(bytes, name, folder).check();
    } catch (const Error&) {
      ++refused;
    }
  };
  const std::size_t step = std::max<std::size_t>(1, whole.size() / 400);
  for (std::size_t size = 0; size < whole.size(); size += step)
    attempt(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525u + 1013904223u, state >> 8; };
  for (int i = 0; i < 600; ++i) {
    Bytes bytes = whole;
    for (std::uint32_t k = 0; k < 1 + next() % 3; ++k)
      bytes[next() % bytes.size()] = static_cast<std::byte>(next());
    attempt(bytes);
  }
  return refused;
}

inline void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's file has no " + from);
  text.replace(at, from.size(), to);
}

}  // namespace welkin::scene
