#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/image_file.h"

/// The pictures of a texture that is written: its levels, layers and faces.
namespace welkin::io::texels {

/// What a texture has.
struct TextureShape {
  int width = 0, height = 0;  ///< of level 0
  int levels = 1;
  int layers = 0;  ///< 0 when it is no array
  int faces = 1;   ///< 1 or 6

  int layer_count() const { return layers == 0 ? 1 : layers; }
  int width_of(int level) const;
  int height_of(int level) const;
};

inline constexpr const char* kFaceNames[6] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

/// More pictures in a file, over all levels, layers and faces, are refused.
inline constexpr std::uint64_t kMaxPictures = 1 << 16;

/// `level 2 layer 1 +X`, of which only what the texture has.
std::string picture_name(const TextureShape& shape, int level, int layer, int face);

/// PartInfo of every picture: level by level, layer by layer, face by face.
void list_pictures(const TextureShape& shape, const std::vector<std::string>& channels, PixelType type,
                   const std::string& compression, FileInfo& info);

/// The parts in that order, and the shape that they make. Throws Error (bad_request, unsupported, too_large)
/// for places that don't exist, are taken twice or have no picture, faces that aren't square, too many
/// levels, and sizes that aren't level 0's halved.
class PictureSet {
 public:
  explicit PictureSet(std::span<const WritePart> parts);

  const TextureShape& shape() const { return shape_; }
  /// `picture`: layer·faces + face.
  const WritePart& at(int level, int picture) const {
    return *parts_[static_cast<std::size_t>(level * of_level() + picture)];
  }
  int of_level() const { return shape_.layer_count() * shape_.faces; }

 private:
  void place(std::span<const WritePart> parts);
  void check_sizes() const;
  std::string name(int level, int picture) const;

  TextureShape shape_;
  std::vector<const WritePart*> parts_;
};

/// Whether a map has alpha of its own: its colours are multiplied by it, as they are in memory.
bool has_alpha(std::span<const WritePart> parts);

}  // namespace welkin::io::texels
