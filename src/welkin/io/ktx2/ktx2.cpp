#include <algorithm>
#include <array>
#include <cassert>
#include <mutex>

#include "welkin/base/error.h"
#include "welkin/io/channel_names.h"
#include "welkin/io/format.h"
#include "welkin/io/ktx2/descriptor.h"
#include "welkin/io/ktx2/header.h"
#include "welkin/io/ktx2/keys.h"
#include "welkin/io/ktx2/supercompression.h"
#include "welkin/io/ktx2/writer.h"
#include "welkin/io/texels/picture.h"

namespace welkin::io {
namespace ktx2 {

using namespace texels;

namespace {

class Ktx2Reader final : public FormatReader {
 public:
  explicit Ktx2Reader(const Source& source) : source_(source), header_(parse_header(source)) {
    info_.format = "ktx2";
    info_.bytes = source.bytes.size();
    try {
      read_descriptor();
      read_keys();
    } catch (const Error& error) {
      throw in_file(source.name, error);
    }
    if (header_.one_dimensional) info_.notes.push_back("a texture of one dimension");
    if (header_.asks_for_levels) info_.notes.push_back("its other levels are to be made from level 0");
    list_parts();
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override;

 private:
  std::span<const std::byte> section(const Section& section) const {
    return source_.bytes.subspan(section.offset, section.bytes);
  }

  void read_descriptor() {
    Descriptor descriptor =
        parse_descriptor(section(header_.descriptor), header_.descriptor.offset, *header_.format);
    info_.colour = source_.options.colour == Colour::automatic ? descriptor.colour : source_.options.colour;
    info_.warnings = std::move(descriptor.warnings);
    declared_.curve = descriptor.curve;
    declared_.gamma = descriptor.gamma;
    declared_.primaries = descriptor.primaries;
    premultiplied_ = descriptor.premultiplied;
  }

  void read_keys() {
    Keys keys = parse_keys(section(header_.keys), header_.keys.offset);
    info_.attributes = std::move(keys.texts);
    info_.notes.insert(info_.notes.end(), keys.notes.begin(), keys.notes.end());
    info_.warnings.insert(info_.warnings.end(), keys.warnings.begin(), keys.warnings.end());
    const auto orientation = info_.attributes.find("KTXorientation");
    if (orientation != info_.attributes.end()) turn(orientation->second);
    const auto swizzle = info_.attributes.find("KTXswizzle");
    choose_channels(swizzle == info_.attributes.end() ? std::string() : swizzle->second);
  }

  /// The channels that are given: those that are stored, or what `swizzle`, four of `rgba01`, makes of them.
  /// Grey is given once, and alpha of 1 not at all.
  void choose_channels(const std::string& swizzle) {
    constexpr std::string_view kNames = "RGBA", kLetters = "rgba";
    const std::string_view stored = header_.format->channels;
    std::array<int, 4> own{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t found = stored.find(kNames[k]);
      own[k] = found != std::string_view::npos ? static_cast<int>(found) : k == 3 ? kOne : kZero;
      if (own[k] >= 0) channels_.push_back({std::string(1, kNames[k]), own[k]});
    }
    if (swizzle.empty()) return;
    if (swizzle.size() != 4 || swizzle.find_first_not_of("rgba01") != std::string::npos) {
      info_.warnings.push_back("KTXswizzle is '" + swizzle + "', not four of rgba01, and is not applied");
      return;
    }
    std::array<int, 4> asked{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t letter = kLetters.find(swizzle[k]);
      asked[k] = letter != std::string_view::npos ? own[letter] : swizzle[k] == '0' ? kZero : kOne;
    }
    if (asked == own) return;
    const bool grey = asked[0] >= 0 && asked[0] == asked[1] && asked[0] == asked[2];
    if (grey) channels_ = {{"Y", asked[0]}};
    if (!grey) channels_ = {{"R", asked[0]}, {"G", asked[1]}, {"B", asked[2]}};
    if (asked[3] != kOne) channels_.push_back({"A", asked[3]});
    check_size(source_, static_cast<std::uint64_t>(header_.width), static_cast<std::uint64_t>(header_.height),
               channels_.size());
    info_.notes.push_back("its channels are rearranged as KTXswizzle says: " + swizzle);
  }

  /// Which way texels and rows run, `rd` being the way of images here.
  void turn(const std::string& orientation) {
    const std::size_t axes = header_.one_dimensional ? 1 : 2;
    const bool known = orientation.size() == axes && (orientation[0] == 'r' || orientation[0] == 'l') &&
                       (axes == 1 || orientation[1] == 'd' || orientation[1] == 'u');
    if (!known)
      throw Error(ErrorKind::damaged, "KTXorientation is '" + orientation + "', which is not an orientation");
    from_right_ = orientation[0] == 'l';
    from_bottom_ = axes == 2 && orientation[1] == 'u';
    if (!from_right_ && !from_bottom_) return;
    if (header_.faces == 6)
      throw Error(ErrorKind::damaged,
                  "KTXorientation of a cube is '" + orientation + "', where the format demands rd");
    info_.notes.push_back("stored in the orientation " + orientation + "; turned upright");
  }

  void list_parts() {
    std::vector<std::string> names;
    for (const Channel& channel : channels_) names.push_back(channel.name);
    if (channels_.back().name == "A" && !is_alpha_added(info_.attributes))
      declared_.alpha = premultiplied_ ? AlphaKind::associated : AlphaKind::straight;
    list_pictures(header_.shape(), names, header_.format->type, std::string(name_of(header_.scheme)), info_);
  }

  /// Unpacked. The level that was read last is kept, since its pictures are read one after the other.
  std::shared_ptr<const Buffer> unpacked(std::size_t level) {
    const std::lock_guard lock(mutex_);
    if (kept_ != nullptr && kept_level_ == level) return kept_;
    kept_.reset();
    auto buffer = std::make_shared<Buffer>(header_.levels[level].unpacked_bytes);
    try {
      unpack(header_.scheme, section(header_.levels[level].stored), buffer->bytes());
    } catch (const Error& error) {
      throw Error(error.kind(), source_.name,
                  "level " + std::to_string(level) + ": " + error.what() + " (byte " +
                      std::to_string(header_.levels[level].stored.offset) + ")");
    }
    kept_ = buffer;
    kept_level_ = level;
    return buffer;
  }

  struct Channel {
    std::string name;
    int stored;  ///< index into TexelFormat::channels, kZero or kOne
  };

  Source source_;
  Header header_;
  std::vector<Channel> channels_;
  bool premultiplied_ = false;
  bool from_right_ = false, from_bottom_ = false;
  std::mutex mutex_;
  std::shared_ptr<const Buffer> kept_;
  std::size_t kept_level_ = 0;
};

void Ktx2Reader::decode(std::size_t part_index, std::span<const int> channels, ImageView<float> out) {
  const PartInfo& part = info_.parts[part_index];
  assert(out.width == part.width && out.height == part.height);
  assert(channels.size() == static_cast<std::size_t>(out.channels));
  const auto level = static_cast<std::size_t>(part.level);
  std::shared_ptr<const Buffer> buffer;
  std::span<const std::byte> bytes = section(header_.levels[level].stored);
  if (header_.scheme != Scheme::none) {
    buffer = unpacked(level);
    bytes = buffer->bytes();
  }
  const std::size_t picture = part_index % (info_.parts.size() / header_.levels.size());
  const std::size_t picture_bytes = header_.picture_bytes(level);
  const std::byte* const first = bytes.subspan(picture * picture_bytes, picture_bytes).data();

  std::vector<int> stored;
  for (const int channel : channels) stored.push_back(channels_[static_cast<std::size_t>(channel)].stored);
  StoredPicture stored_picture{header_.format, first};
  stored_picture.row_stride = static_cast<std::size_t>(row_bytes(*header_.format, part.width));
  stored_picture.colour = info_.colour;
  stored_picture.from_right = from_right_;
  stored_picture.from_bottom = from_bottom_;
  read_picture(stored_picture, stored, out);
}

std::unique_ptr<FormatReader> open_ktx2(const Source& source) {
  return std::make_unique<Ktx2Reader>(source);
}

}  // namespace
}  // namespace ktx2

Format ktx2_format() {
  return {{.format = "ktx2",
           .title = "KTX2",
           .extensions = {"ktx2"},
           .types = {PixelType::float32, PixelType::half, PixelType::rgb9e5, PixelType::r11g11b10,
                     PixelType::bc6h, PixelType::uastc_hdr},
           .compressions = {"none", "zstd"},
           .channels = Channels::rg_or_rgba,
           .pictures = true,
           .levels = true,
           .texture = true,
           .hdr = true,
           .negative = true,
           .attributes = true},
          ktx2::is_ktx2,
          ktx2::open_ktx2,
          ktx2::write_ktx2};
}

}  // namespace welkin::io
