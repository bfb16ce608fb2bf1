#include "welkin/io/texels/picture_set.h"

#include <algorithm>
#include <bit>

#include "welkin/base/error.h"

namespace welkin::io::texels {

int TextureShape::width_of(int level) const {
  return std::max(1, width >> level);
}

int TextureShape::height_of(int level) const {
  return std::max(1, height >> level);
}

std::string picture_name(const TextureShape& shape, int level, int layer, int face) {
  std::string name;
  const auto append = [&](const std::string& word) { name += (name.empty() ? "" : " ") + word; };
  if (shape.levels > 1) append("level " + std::to_string(level));
  if (shape.layers > 0) append("layer " + std::to_string(layer));
  if (shape.faces == 6) append(kFaceNames[face]);
  return name;
}

void list_pictures(const TextureShape& shape, const std::vector<std::string>& channels, PixelType type,
                   const std::string& compression, FileInfo& info) {
  info.levels = shape.levels;
  info.layers = shape.layers;
  info.faces = shape.faces;
  for (int level = 0; level < shape.levels; ++level) {
    for (int layer = 0; layer < shape.layer_count(); ++layer) {
      for (int face = 0; face < shape.faces; ++face)
        info.parts.push_back({picture_name(shape, level, layer, face), shape.width_of(level),
                              shape.height_of(level), channels, type, compression, level, layer, face});
    }
  }
}

PictureSet::PictureSet(std::span<const WritePart> parts) {
  int levels = 0, layers = 0, faces = 0;
  for (const WritePart& part : parts) {
    if (part.level < 0 || part.layer < 0 || part.face < 0 || part.face > 5)
      throw Error(ErrorKind::bad_request, "level " + std::to_string(part.level) + ", layer " +
                                              std::to_string(part.layer) + ", face " +
                                              std::to_string(part.face) + " is no place in a texture");
    levels = std::max(levels, part.level + 1);
    layers = std::max(layers, part.layer + 1);
    faces = std::max(faces, part.face + 1);
  }
  shape_.faces = faces == 1 ? 1 : 6;
  shape_.layers = layers == 1 ? 0 : layers;
  shape_.levels = levels;
  const auto pictures = static_cast<std::uint64_t>(levels) * static_cast<std::uint64_t>(layers) *
                        static_cast<std::uint64_t>(shape_.faces);
  if (pictures > kMaxPictures)
    throw Error(ErrorKind::too_large,
                std::to_string(pictures) + " pictures, more than " + std::to_string(kMaxPictures));
  place(parts);
  shape_.width = parts_[0]->image.width;
  shape_.height = parts_[0]->image.height;
  check_sizes();
}

std::string PictureSet::name(int level, int picture) const {
  std::string text = "level " + std::to_string(level);
  if (shape_.layers > 0) text += " layer " + std::to_string(picture / shape_.faces);
  return shape_.faces == 6 ? text + " " + kFaceNames[picture % shape_.faces] : text;
}

void PictureSet::place(std::span<const WritePart> parts) {
  parts_.resize(static_cast<std::size_t>(shape_.levels) * static_cast<std::size_t>(of_level()));
  for (const WritePart& part : parts) {
    const int picture = part.layer * shape_.faces + part.face;
    const WritePart*& slot = parts_[static_cast<std::size_t>(part.level * of_level() + picture)];
    if (slot != nullptr) throw Error(ErrorKind::bad_request, "two pictures for " + name(part.level, picture));
    slot = &part;
  }
  const auto missing = std::find(parts_.begin(), parts_.end(), nullptr);
  if (missing == parts_.end()) return;
  const int index = static_cast<int>(missing - parts_.begin());
  throw Error(ErrorKind::bad_request, "no picture for " + name(index / of_level(), index % of_level()));
}

void PictureSet::check_sizes() const {
  const auto size_text = [](int width, int height) {
    return std::to_string(width) + "×" + std::to_string(height);
  };
  if (shape_.faces == 6 && shape_.width != shape_.height)
    throw Error(ErrorKind::unsupported,
                "the faces of a cube must be square, not " + size_text(shape_.width, shape_.height));
  const int maximum =
      static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(shape_.width, shape_.height))));
  if (shape_.levels > maximum)
    throw Error(ErrorKind::bad_request, std::to_string(shape_.levels) + " levels, of which " +
                                            size_text(shape_.width, shape_.height) + " has at most " +
                                            std::to_string(maximum));
  for (int level = 0; level < shape_.levels; ++level) {
    const int width = shape_.width_of(level), height = shape_.height_of(level);
    for (int i = 0; i < of_level(); ++i) {
      const ImageView<const float>& image = at(level, i).image;
      if (image.width == width && image.height == height) continue;
      throw Error(ErrorKind::bad_request, name(level, i) + " is " + size_text(image.width, image.height) +
                                              ", not " + size_text(width, height));
    }
  }
}

bool has_alpha(std::span<const WritePart> parts) {
  return std::any_of(parts.begin(), parts.end(), [](const WritePart& part) {
    return part.channels.size() > 1 && std::count(part.channels.begin(), part.channels.end(), "A") > 0;
  });
}

}  // namespace welkin::io::texels
