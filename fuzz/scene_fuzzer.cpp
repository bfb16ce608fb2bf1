#include <cstddef>
#include <cstdint>
#include <span>

#include "welkin/base/error.h"
#include "welkin/scene/scene_input.h"

/// Reads the bytes as glTF or, where they don't begin as that, as OBJ. Every file that a scene names is the
/// scene itself: materials and pictures of the same bytes. Only Error may come out; what is read is sound.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  scene::SceneInput input{"fuzz.obj", bytes, nullptr};
  input.picture_bytes = std::uint64_t{16} << 20;
  input.open_beside = [&](const std::string&) -> scene::HeldBytes { return {bytes, nullptr}; };
  try {
    scene::read_scene(input).check();
  } catch (const Error& error) {
    // check() alone finds bad requests, and nothing that a reader lets through is one.
    if (error.kind() == ErrorKind::bad_request) throw;
  }
  return 0;
}
