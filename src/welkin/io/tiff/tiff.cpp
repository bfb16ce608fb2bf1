#include "welkin/io/tiff/tiff.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <functional>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour/xyz.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/tiff/failure.h"
#include "welkin/io/tiff/file.h"
#include "welkin/io/tiff/page.h"
#include "welkin/io/unread_formats.h"

namespace welkin::io {
namespace {

bool matches(std::span<const std::byte> bytes) {
  if (bytes.size() < 8) return false;
  for (const char* magic : {"II*\0", "MM\0*", "II+\0", "MM\0+"}) {
    if (std::memcmp(bytes.data(), magic, 4) == 0) return true;
  }
  return false;
}

/// The bytes of a file as libtiff reads them.
struct Memory {
  std::span<const std::byte> bytes;
  std::uint64_t at = 0;

  static tmsize_t read(thandle_t handle, void* out, tmsize_t size) {
    auto& self = *static_cast<Memory*>(handle);
    const std::uint64_t held = self.bytes.size() - std::min<std::uint64_t>(self.at, self.bytes.size());
    const std::size_t count = std::min(static_cast<std::uint64_t>(std::max<tmsize_t>(size, 0)), held);
    if (count > 0) std::memcpy(out, self.bytes.data() + self.at, count);
    self.at += count;
    return static_cast<tmsize_t>(count);
  }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    auto& self = *static_cast<Memory*>(handle);
    if (whence == SEEK_SET) self.at = offset;
    if (whence == SEEK_CUR) self.at += offset;
    if (whence == SEEK_END) self.at = self.bytes.size() + offset;
    return self.at;
  }
  static toff_t size(thandle_t handle) { return static_cast<Memory*>(handle)->bytes.size(); }
  static int map(thandle_t handle, void** base, toff_t* size) {
    auto& self = *static_cast<Memory*>(handle);
    *base = const_cast<std::byte*>(self.bytes.data());
    *size = self.bytes.size();
    return 1;
  }
  TiffStream stream() {
    const auto refuse = [](thandle_t, void*, tmsize_t) { return tmsize_t{-1}; };
    return {this, read, refuse, seek, size, map};
  }
};

/// One strip or tile, decoded: its pixels start at (x, y) of the picture.
struct Block {
  std::byte* samples;
  std::size_t row_bytes;
  int x, y, width, height;
  int plane;
};

class TiffReader : public FormatReader {
 public:
  explicit TiffReader(const Source& source) : source_(source), memory_{source.bytes} {
    tiff_ = open_tiff_stream(memory_.stream(), "r", source.options.max_bytes, failure_);
    if (tiff_ == nullptr) fail("its first directory cannot be read");
    constexpr std::size_t kMaxPages = 65535;
    do {
      if (pages_.size() == kMaxPages) fail("more than " + std::to_string(kMaxPages) + " directories");
      failure_.clear();
      pages_.push_back(understand_tiff_page(tiff_.get(), source_));
    } while (TIFFLastDirectory(tiff_.get()) == 0 && next_directory());

    info_.format = "tiff";
    info_.bytes = source_.bytes.size();
    info_.attributes = pages_.front().attributes;
    const PixelType type = pages_.front().part.type;
    const bool integers = type == PixelType::uint8 || type == PixelType::uint16;
    info_.colour = source_.options.colour;
    if (info_.colour == Colour::automatic) info_.colour = integers ? Colour::srgb : Colour::linear;
    for (const TiffPage& page : pages_) {
      info_.parts.push_back(page.part);
      info_.notes.insert(info_.notes.end(), page.notes.begin(), page.notes.end());
      for (const std::string& warning : page.warnings) {
        if (std::count(info_.warnings.begin(), info_.warnings.end(), warning) == 0)
          info_.warnings.push_back(warning);
      }
    }
    declare();
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part < pages_.size());
    const TiffPage& page = pages_[part];
    assert(out.width == page.part.width && out.height == page.part.height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    failure_.clear();
    if (TIFFSetSubDirectory(tiff_.get(), page.directory) == 0) fail("a directory cannot be read again");
    choose_tiff_conversions(tiff_.get());
    const std::vector<bool> srgb = srgb_channels(page.part.channels, info_.colour);
    if (page.decoding == TiffDecoding::rgba) return read_rgba(page, srgb, channels, out);
    if (page.planar) {
      for (std::size_t k = 0; k < channels.size(); ++k) {
        const auto plane = static_cast<std::size_t>(channels[k]);
        ImageView<float> target = out;
        target.data += k;
        read_blocks(page, channels[k],
                    [&](const Block& block) { place(page, block, {srgb[plane]}, std::array{0}, target); });
      }
    } else {
      read_blocks(page, 0, [&](const Block& block) { place(page, block, srgb, channels, out); });
    }
  }

 private:
  /// `cause`, and what libtiff says of it.
  [[noreturn]] void fail(const std::string& cause) const {
    const std::string detail = tiff_failure(failure_.text);
    throw Error(ErrorKind::damaged, source_.name, detail.empty() ? cause : cause + ": " + detail);
  }

  /// The first page's declarations, for all; alpha is that of the first page that has any.
  void declare() {
    declared_ = pages_.front().declared;
    info_.panorama = pages_.front().panorama;
    const auto with_alpha =
        std::find_if(pages_.begin(), pages_.end(), [](const TiffPage& page) { return page.associated; });
    std::optional<bool> associated;
    if (with_alpha != pages_.end()) associated = with_alpha->associated;
    if (associated) {
      const AlphaKind multiplied = info_.colour == Colour::srgb ? AlphaKind::encoded : AlphaKind::associated;
      declared_.alpha = *associated ? multiplied : AlphaKind::straight;
    }
    std::string differ;
    const auto note = [&](bool same, const std::string& what) {
      if (!same && differ.find(what) == std::string::npos) differ += (differ.empty() ? "" : " and ") + what;
    };
    for (const TiffPage& page : pages_) {
      note(page.declared.orientation == declared_.orientation, "orientation");
      note(!page.associated || page.associated == associated, "kind of alpha");
      note(page.declared.icc == declared_.icc, "ICC profile");
      note(page.declared.primaries == declared_.primaries, "primaries");
      note(page.panorama == info_.panorama, "what they are cut out of");
    }
    if (!differ.empty())
      info_.warnings.push_back("its pages differ in " + differ + "; all are read as the first of them says");
  }

  bool next_directory() {
    failure_.clear();
    if (TIFFReadDirectory(tiff_.get()) == 0)
      fail("its directory " + std::to_string(pages_.size() + 1) + " cannot be read");
    return true;
  }

  /// Decodes all blocks of a plane, one after the other, into one buffer.
  void read_blocks(const TiffPage& page, int plane, const std::function<void(const Block&)>& use) {
    const tmsize_t maximum = page.tiled ? TIFFTileSize(tiff_.get()) : TIFFStripSize(tiff_.get());
    const tmsize_t row = page.tiled ? TIFFTileRowSize(tiff_.get()) : TIFFScanlineSize(tiff_.get());
    const std::uint64_t row_bits = static_cast<std::uint64_t>(page.block_width) *
                                   static_cast<std::uint64_t>(page.planar ? 1 : page.stored_samples) *
                                   static_cast<std::uint64_t>(page.samples.bits);
    if (maximum <= 0 || row < static_cast<tmsize_t>((row_bits + 7) / 8) || row * page.block_height > maximum)
      fail("its strips or tiles are malformed");
    std::vector<std::byte> samples(static_cast<std::size_t>(maximum));
    for (int y = 0; y < page.part.height; y += page.block_height) {
      for (int x = 0; x < page.part.width; x += page.block_width) {
        const Block block{samples.data(),
                          static_cast<std::size_t>(row),
                          x,
                          y,
                          std::min(page.block_width, page.part.width - x),
                          std::min(page.block_height, page.part.height - y),
                          plane};
        read_block(page, plane, block, samples);
        use(block);
      }
    }
  }

  void read_block(const TiffPage& page, int plane, const Block& block, std::vector<std::byte>& samples) {
    const auto x = static_cast<std::uint32_t>(block.x);
    const auto y = static_cast<std::uint32_t>(block.y);
    const auto size = static_cast<tmsize_t>(samples.size());
    const auto sample = static_cast<std::uint16_t>(plane);
    tmsize_t got = 0;
    if (page.tiled) {
      got = TIFFReadEncodedTile(tiff_.get(), TIFFComputeTile(tiff_.get(), x, y, 0, sample), samples.data(),
                                size);
    } else {
      got = TIFFReadEncodedStrip(tiff_.get(), TIFFComputeStrip(tiff_.get(), y, sample), samples.data(), size);
    }
    const std::size_t needed = block.row_bytes * static_cast<std::size_t>(block.height);
    if (got < 0 || static_cast<std::size_t>(got) < needed) {
      const std::string name =
          "the " + std::string(page.tiled ? "tile" : "strip") + " at row " + std::to_string(block.y);
      if (failure_.text[0] != 0) fail(name + " cannot be decoded");
      fail(name + " ends early");
    }
  }

  /// Copies a block's rows into the picture; pixels have srgb.size() samples.
  static void place(const TiffPage& page, const Block& block, std::vector<bool> srgb,
                    std::span<const int> channels, ImageView<float> out) {
    const std::size_t values = static_cast<std::size_t>(block.width) * srgb.size();
    const bool plain = page.decoding == TiffDecoding::samples;
    const std::size_t inverted_step = page.inverted && block.plane == 0 ? srgb.size() : 0;
    const PixelDecoder decoder(plain ? page.part.type : PixelType::float32, std::move(srgb));
    const auto place_row = [&](int y, std::vector<float>& floats) {
      std::byte* row = block.samples + static_cast<std::size_t>(y) * block.row_bytes;
      if (plain && page.inverted)
        std::transform(row, row + block.row_bytes, row, [](std::byte byte) { return ~byte; });
      if (!plain) {
        floats.resize(values);
        unpack_tiff_samples(page.samples, inverted_step, row, values, floats.data());
        if (page.decoding == TiffDecoding::xyz) {
          for (std::size_t i = 0; i < values; i += 3) xyz_to_rgb(&floats[i]);
        }
        row = reinterpret_cast<std::byte*>(floats.data());
      }
      float* first = out.at(block.x, block.y + y);
      decoder.decode(row, channels, block.width, first, out.channels);
    };
    // Starting a thread pays from tens of thousands of values on.
    constexpr std::size_t kValuesOfTask = 1 << 15;
    const std::size_t grain = kValuesOfTask / values + 1;
    tbb::parallel_for(tbb::blocked_range<int>(0, block.height, grain),
                      [&](const tbb::blocked_range<int>& rows) {
                        std::vector<float> floats;
                        for (int y = rows.begin(); y < rows.end(); ++y) place_row(y, floats);
                      });
  }

  void read_rgba(const TiffPage& page, std::vector<bool> srgb, std::span<const int> channels,
                 ImageView<float> out) {
    // libtiff packs R in the lowest byte. Asking for the file's own orientation leaves rows and columns as
    // stored.
    std::vector<std::uint32_t> raster(static_cast<std::size_t>(out.width) *
                                      static_cast<std::size_t>(out.height));
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_ORIENTATION, &orientation);
    if (TIFFReadRGBAImageOriented(tiff_.get(), static_cast<std::uint32_t>(out.width),
                                  static_cast<std::uint32_t>(out.height), raster.data(), orientation,
                                  1) == 0) {
      fail("the picture cannot be decoded");
    }
    if constexpr (std::endian::native == std::endian::big) {
      for (std::uint32_t& pixel : raster) pixel = swap_bytes(pixel);
    }
    srgb.resize(4, false);
    PixelDecoder(page.part.type, std::move(srgb))
        .decode_rows(reinterpret_cast<const std::byte*>(raster.data()),
                     static_cast<std::size_t>(out.width) * 4, channels, out);
  }

  Source source_;
  Memory memory_;
  TiffFailure failure_;
  TiffHandle tiff_;
  std::vector<TiffPage> pages_;
};

}  // namespace

std::unique_ptr<FormatReader> open_tiff(const Source& source) {
  if (const auto raw = camera_raw(source.bytes)) throw Error(ErrorKind::unsupported, source.name, *raw);
  return std::make_unique<TiffReader>(source);
}

Format tiff_format() {
  return {
      {.format = "tiff",
       .title = "TIFF",
       .extensions = {"tif", "tiff"},
       .types = {PixelType::float32, PixelType::half, PixelType::uint8, PixelType::uint16, PixelType::uint32},
       .compressions = {"zip", "none", "lzw"},
       .channels = Channels::any,
       .pictures = true,
       .hdr = true,
       .negative = true,
       .attributes = true},
      matches,
      open_tiff,
      write_tiff};
}

}  // namespace welkin::io
