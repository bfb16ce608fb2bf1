#pragma once

#include <memory>

#include "welkin/io/byte_order.h"
#include "welkin/io/test_pictures.h"

/// What the tests of KTX2 share: textures of every kind, and files as other writers make them.
namespace welkin::io::test {

/// Pictures of noise for every level, layer and face.
class Texture {
 public:
  Texture(int width, int height, int levels, int layers, int faces, int channels) {
    unsigned seed = 1;
    for (int level = 0; level < levels; ++level) {
      for (int layer = 0; layer < layers; ++layer) {
        for (int face = 0; face < faces; ++face) {
          images_.push_back(std::make_unique<Image>(
              noise(std::max(1, width >> level), std::max(1, height >> level), channels, seed++)));
          parts_.push_back({"", images_.back()->view(), names_of(channels), level, layer, face});
        }
      }
    }
  }
  const std::vector<WritePart>& parts() const { return parts_; }
  Bytes encoded(const WriteOptions& options = {}) const;

 private:
  std::vector<std::unique_ptr<const Image>> images_;
  std::vector<WritePart> parts_;
};

/// What textures there are.
struct Kind {
  std::string name;
  int width, height, levels, layers, faces;
};

inline const std::vector<Kind> kKinds = {
    {"picture", 5, 3, 1, 1, 1}, {"mips", 13, 6, 4, 1, 1},          {"array", 4, 2, 1, 3, 1},
    {"cube", 8, 8, 1, 1, 6},    {"cube with mips", 8, 8, 4, 1, 6}, {"array of cubes", 4, 4, 2, 2, 6}};

inline Bytes encoded_parts(std::span<const WritePart> parts, const WriteOptions& options = {}) {
  const TemporaryFolder folder;
  write(folder / "texture.ktx2", parts, options);
  return file_bytes(folder / "texture.ktx2");
}

inline Bytes Texture::encoded(const WriteOptions& options) const {
  return encoded_parts(parts_, options);
}

inline std::uint32_t word(const Bytes& bytes, std::size_t at) {
  return load_native<std::uint32_t>(&bytes.at(at));
}
inline std::uint64_t long_word(const Bytes& bytes, std::size_t at) {
  return load_native<std::uint64_t>(&bytes.at(at));
}

template <class T>
void append(Bytes& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(&bytes[at], &value, sizeof value);
}

/// One entry of key/value data, padded.
inline Bytes key(const std::string& name, const std::string& value) {
  Bytes bytes;
  append(bytes, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
  const Bytes text = bytes_of(name + '\0' + value);
  bytes.insert(bytes.end(), text.begin(), text.end());
  while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
  return bytes;
}

/// A file of one level, field by field.
struct OtherFile {
  std::uint32_t format = 9, type_size = 1;
  std::size_t texel_bytes = 1;
  std::uint32_t width = 1, height = 1, depth = 0, layers = 0, faces = 1, levels = 1, scheme = 0;
  std::uint32_t transfer = 1, primaries = 1, model = 1;
  std::uint32_t block = 0;  ///< its sides less one
  std::uint32_t flags = 1;  ///< alpha is multiplied in, so texels are read as they are
  Bytes keys = {};
  std::uint64_t unpacked = 0;  ///< 0: as many bytes as are stored
};

inline Bytes file_of(const OtherFile& file, const Bytes& texels) {
  constexpr std::uint32_t kDescriptorBytes = 28, kDescriptorAt = 104;
  Bytes bytes = bytes_of("\xabKTX 20\xbb\r\n\x1a\n");
  for (const std::uint32_t field : {file.format, file.type_size, file.width, file.height, file.depth,
                                    file.layers, file.faces, file.levels, file.scheme})
    append(bytes, field);
  const auto key_bytes = static_cast<std::uint32_t>(file.keys.size());
  for (const std::uint32_t field :
       {kDescriptorAt, kDescriptorBytes, key_bytes == 0 ? 0 : kDescriptorAt + kDescriptorBytes, key_bytes})
    append(bytes, field);
  append(bytes, std::uint64_t{0});
  append(bytes, std::uint64_t{0});
  append(bytes, std::uint64_t{kDescriptorAt} + kDescriptorBytes + key_bytes);
  append(bytes, std::uint64_t{texels.size()});
  append(bytes, file.unpacked == 0 ? std::uint64_t{texels.size()} : file.unpacked);
  for (const std::uint32_t field : {kDescriptorBytes, 0u, 2u | 24u << 16,
                                    file.model | file.primaries << 8 | file.transfer << 16 | file.flags << 24,
                                    file.block, static_cast<std::uint32_t>(file.texel_bytes), 0u})
    append(bytes, field);
  bytes.insert(bytes.end(), file.keys.begin(), file.keys.end());
  bytes.insert(bytes.end(), texels.begin(), texels.end());
  return bytes;
}

}  // namespace welkin::io::test
