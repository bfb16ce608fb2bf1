#include <cassert>

#include "welkin/base/error.h"
#include "welkin/io/dds/header.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/format.h"
#include "welkin/io/texels/picture.h"

/// DirectDraw surfaces, the textures of Direct3D: pictures, arrays and cubes with their levels. They carry no
/// text, so a map's shape and what its levels hold are not in the file.
namespace welkin::io {
namespace dds {

using namespace texels;

namespace {

class DdsReader final : public FormatReader {
 public:
  explicit DdsReader(const Source& source) : source_(source), header_(parse_header(source)) {
    info_.format = "dds";
    info_.bytes = source.bytes.size();
    const bool integers =
        header_.format->type == PixelType::uint8 || header_.format->type == PixelType::uint16;
    info_.colour = source.options.colour != Colour::automatic ? source.options.colour
                   : header_.srgb || integers                 ? Colour::srgb
                                                              : Colour::linear;
    choose_channels();
    std::vector<std::string> names;
    for (const Channel& channel : channels_) names.push_back(channel.name);
    list_pictures(header_.shape, names, header_.format->type, "none", info_);
    info_.notes.push_back(header_.modern ? "with the header of Direct3D 10"
                                         : "with the header of Direct3D 9");
    if (names.back() == "A")
      declared_.alpha = header_.alpha == Alpha::premultiplied ? AlphaKind::associated : AlphaKind::straight;
    if (const std::uint64_t more = source.bytes.size() - header_.end(); more > 0)
      info_.warnings.push_back(std::to_string(more) + " bytes follow the pictures and are not read");
  }

  void decode(std::size_t part_index, std::span<const int> channels, ImageView<float> out) override {
    const PartInfo& part = info_.parts[part_index];
    std::vector<int> stored;
    for (const int channel : channels) stored.push_back(channels_[static_cast<std::size_t>(channel)].stored);
    StoredPicture picture{header_.format,
                          source_.bytes.data() + header_.offset(part.level, part.layer, part.face)};
    picture.row_stride = static_cast<std::size_t>(row_bytes(*header_.format, part.width));
    picture.colour = info_.colour;
    read_picture(picture, stored, out);
  }

 private:
  void choose_channels() {
    constexpr std::string_view kNames = "RGBA";
    const std::string_view stored = header_.format->channels;
    for (const char name : kNames) {
      const std::size_t found = stored.find(name);
      if (found == std::string_view::npos || (name == 'A' && header_.alpha == Alpha::none)) continue;
      channels_.push_back({header_.grey ? "Y" : std::string(1, name), static_cast<int>(found)});
    }
  }

  struct Channel {
    std::string name;
    int stored;
  };
  Source source_;
  Header header_;
  std::vector<Channel> channels_;
};

std::unique_ptr<FormatReader> open_dds(const Source& source) {
  return std::make_unique<DdsReader>(source);
}

WriteReport write_dds(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  const PictureSet pictures(parts);
  PictureWriter writer(options, "DDS");
  file.write(written_header(pictures.shape(), writer.type(), has_alpha(parts)));
  WriteReport report;
  for (int picture = 0; picture < pictures.of_level(); ++picture) {
    for (int level = 0; level < pictures.shape().levels; ++level)
      report = report + writer.write(file, pictures.at(level, picture));
  }
  return report;
}

}  // namespace
}  // namespace dds

Format dds_format() {
  return {{.format = "dds",
           .title = "DDS",
           .extensions = {"dds"},
           .types = {std::begin(texels::PictureWriter::kTypes), std::end(texels::PictureWriter::kTypes)},
           .compressions = {"none"},
           .channels = Channels::rgba,
           .pictures = true,
           .levels = true,
           .texture = true,
           .hdr = true,
           .negative = true},
          dds::is_dds,
          dds::open_dds,
          dds::write_dds};
}

}  // namespace welkin::io
