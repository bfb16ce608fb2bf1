#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "welkin/base/error.h"
#include "welkin/io/boxes.h"
#include "welkin/io/colour/code_points.h"
#include "welkin/io/heif/planes.h"

/// AVIF and HEIF (ISO/IEC 23008-12), by libheif.
namespace welkin::io {
namespace {

/// The emptiest pictures that AV1's and HEVC's encoders write have a quarter of this.
constexpr std::uint64_t kMostPixelsOfByte = 1 << 18;

/// The brands of a file's first box: `avif`, `mif1`…, the major one first.
std::vector<std::string_view> brands_of(std::span<const std::byte> bytes) {
  constexpr std::size_t kBrands = 64, kBrand = 4;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 8 + kBrand * kBrands));
  if (text.size() < 12 || text.substr(4, 4) != "ftyp") return {};
  std::size_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(text[i]);
  std::vector<std::string_view> brands = {text.substr(8, kBrand)};
  // Four bytes of version lie between.
  for (std::size_t at = 16; at + kBrand <= std::min(size, text.size()); at += kBrand)
    brands.push_back(text.substr(at, kBrand));
  return brands;
}

bool has_one_of(const std::vector<std::string_view>& brands, std::initializer_list<std::string_view> wanted) {
  return std::find_first_of(brands.begin(), brands.end(), wanted.begin(), wanted.end()) != brands.end();
}

bool matches_avif(std::span<const std::byte> bytes) {
  return has_one_of(brands_of(bytes), {"avif", "avis"});
}

bool matches_heif(std::span<const std::byte> bytes) {
  return has_one_of(brands_of(bytes), {"heic", "heix", "heim", "heis", "hevc", "hevx", "hevm", "hevs", "mif1",
                                       "mif2", "msf1", "miaf"});
}

class HeifReader : public FormatReader {
 public:
  HeifReader(const Source& source, const char* format) : source_(source) {
    info_.format = format;
    info_.bytes = source_.bytes.size();
    read_boxes();
    decode_planes();
    const heif::Planes& planes = *planes_;
    std::vector<std::string> channels = {"Y"};
    if (!planes.grey()) channels = {"R", "G", "B"};
    if (planes.alpha()) channels.push_back("A");
    check_size(source_, static_cast<std::uint64_t>(planes.width()),
               static_cast<std::uint64_t>(planes.height()), channels.size());
    const auto brands = brands_of(source_.bytes);
    const bool hevc = has_one_of(brands, {"heic", "heix", "hevc", "hevx"});
    info_.parts.push_back({"", planes.width(), planes.height(), std::move(channels),
                           planes.depth() > 8 ? PixelType::uint16 : PixelType::uint8,
                           info_.format == "avif" ? "av1"
                           : hevc                 ? "hevc"
                                                  : "heif"});
    if (planes.depth() != 8 && planes.depth() != 16)
      info_.notes.push_back("values of " + std::to_string(planes.depth()) + " bits");
    declare();
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    if (!planes_) decode_planes();
    planes_->set_colour(info_.colour);
    tbb::parallel_for(tbb::blocked_range<int>(0, out.height, 8), [&](const tbb::blocked_range<int>& rows) {
      for (int y = rows.begin(); y < rows.end(); ++y)
        planes_->read_row(y, channels, out.row(y), out.channels);
    });
    // Most pictures are read once.
    planes_.reset();
    picture_.reset();
  }

 private:
  void read_boxes() {
    Boxes boxes(source_, source_.bytes);
    bool still = false, moving = false;
    while (const std::optional<Box> box = boxes.next()) {
      still = still || box->type == "meta";
      moving = moving || box->type == "moov";
    }
    if (moving && !still)
      throw Error(ErrorKind::unsupported, source_.name, "an image sequence, not a picture");
    if (moving) info_.warnings.push_back("an image sequence: its primary picture is read, and no other");
    if (has_one_of(brands_of(source_.bytes), {"tmap"}))
      info_.warnings.push_back("its gain map is not applied: what is read is the picture without it");
  }

  /// That a picture is grey, and how many bits it has, stands in the coded picture, so that it is decoded
  /// when the file opens.
  void decode_planes() {
    const heif::Context context(heif::libheif().heif_context_alloc());
    if (context == nullptr) throw std::bad_alloc();
    handle_ = heif::primary_picture(context, source_);
    // The size is that after rotation and cropping, the number of channels not yet known. libheif refuses
    // sides over 32768 itself.
    const int width = heif::libheif().heif_image_handle_get_width(handle_.get());
    const int height = heif::libheif().heif_image_handle_get_height(handle_.get());
    check_size(source_, static_cast<std::uint64_t>(std::max(width, 0)),
               static_cast<std::uint64_t>(std::max(height, 0)), 1);
    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) / kMostPixelsOfByte >
        source_.bytes.size()) {
      throw Error(ErrorKind::damaged, source_.name,
                  std::to_string(source_.bytes.size()) + " bytes cannot hold " + std::to_string(width) + "×" +
                      std::to_string(height) + " pixels");
    }
    picture_ = heif::decode(handle_, source_);
    code_points_ = heif::code_points(handle_, doubt_);
    planes_.emplace(picture_, code_points_.get(), source_);
  }

  void declare() {
    declared_.icc = heif::icc_profile(handle_, source_);
    declared_.xmp = heif::xmp(handle_, source_);
    // Exif is not read: its orientation gives way to the boxes irot and imir (ISO/IEC 23008-12, A.2.4), which
    // libheif has applied.
    if (!declared_.icc.empty()) {
      info_.colour = Colour::srgb;  // should the profile turn out to be damaged
    } else if (code_points_ != nullptr) {
      declare_code_points(code_points_->color_primaries, code_points_->transfer_characteristics, declared_,
                          info_);
    } else {
      info_.colour = Colour::srgb;
      info_.warnings.push_back(
          doubt_.empty()
              ? "no box says what its colours mean; sRGB, coded by BT.601 in full range, is assumed"
              : "libheif does not know what its colours mean (" + doubt_ + "); sRGB is assumed");
    }
    if (planes_->alpha()) {
      const bool linear =
          declared_.icc.empty() && info_.colour == Colour::linear && declared_.curve == Curve::none;
      const bool premultiplied = heif::libheif().heif_image_handle_is_premultiplied_alpha(handle_.get()) != 0;
      declared_.alpha = !premultiplied ? AlphaKind::straight
                        : linear       ? AlphaKind::associated
                                       : AlphaKind::encoded;
    }
    if (source_.options.colour != Colour::automatic) info_.colour = source_.options.colour;
    for (const std::string& type : heif::auxiliary_types(handle_)) {
      if (type.find("gainmap") != std::string::npos) {
        info_.warnings.push_back("its gain map is not applied: what is read is the picture without it");
      } else {
        info_.notes.push_back("comes with " + type);
      }
    }
  }

  Source source_;
  heif::Handle handle_;
  heif::Picture picture_;
  heif::CodePoints code_points_;
  std::string doubt_;                   ///< of the code points
  std::optional<heif::Planes> planes_;  ///< until they are read
};

std::unique_ptr<FormatReader> open_avif(const Source& source) {
  return std::make_unique<HeifReader>(source, "avif");
}

std::unique_ptr<FormatReader> open_heif(const Source& source) {
  return std::make_unique<HeifReader>(source, "heif");
}

}  // namespace

Format avif_format() {
  return {{.format = "avif",
           .title = "AVIF",
           .extensions = {"avif"},
           .types = {PixelType::uint8, PixelType::uint16},
           .compressions = {"av1"},
           .channels = Channels::rgba,
           .lossless = false,
           .writable = false},
          matches_avif,
          open_avif,
          nullptr};
}

Format heif_format() {
  return {{.format = "heif",
           .title = "HEIF",
           .extensions = {"heif", "heic"},
           .types = {PixelType::uint8, PixelType::uint16},
           .compressions = {"hevc"},
           .channels = Channels::rgba,
           .lossless = false,
           .writable = false},
          matches_heif,
          open_heif,
          nullptr};
}

}  // namespace welkin::io
