#include "welkin/io/ktx2/writer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/ktx2/descriptor.h"
#include "welkin/io/ktx2/header.h"
#include "welkin/io/ktx2/keys.h"
#include "welkin/io/ktx2/supercompression.h"
#include "welkin/io/texels/picture.h"
#include "welkin/io/texels/picture_set.h"
#include "welkin/io/write_choices.h"

namespace welkin::io::ktx2 {

using namespace texels;

namespace {

class Writer {
 public:
  Writer(std::span<const WritePart> parts, const WriteOptions& options) : pictures_(parts) {
    const TextureShape& shape = pictures_.shape();
    header_.width = shape.width;
    header_.height = shape.height;
    header_.layers = shape.layers;
    header_.faces = shape.faces;
    header_.levels.resize(static_cast<std::size_t>(shape.levels));
    static constexpr std::array types{PixelType::float32,   PixelType::half, PixelType::rgb9e5,
                                      PixelType::r11g11b10, PixelType::bc6h, PixelType::uastc_hdr};
    static const std::array<std::string, 2> known{"none", "zstd"};
    const PixelType type = pixel_type(options, types, "KTX2");
    const bool two =
        !format_for(type).packed() &&
        std::all_of(parts.begin(), parts.end(), [](const WritePart& part) { return is_red_green(part); });
    header_.format = &format_for(type, two);
    // Loaders of UASTC HDR unpack it; some take it no other way.
    const bool packs = options.compression.empty() && type == PixelType::uastc_hdr;
    header_.scheme = packs || compression(options, known, "KTX2") == "zstd" ? Scheme::zstd : Scheme::none;
    const Colour colour = colour_for(type, options.colour);
    const bool packed = header_.format->packed();
    const std::string holder = packed ? "KTX2 of " + std::string(io::name_of(type)) : "KTX2";
    for (int level = 0; level < shape.levels; ++level) {
      for (int i = 0; i < pictures_.of_level(); ++i) {
        const WritePart& picture = pictures_.at(level, i);
        encoders_.emplace_back(type,
                               two ? red_green_order(picture)
                                   : channel_order(picture, packed ? Alpha::none : Alpha::allowed, holder),
                               colour, two, options.texture_quality);
      }
    }

    const std::vector<std::byte> descriptor = written_descriptor(*header_.format, colour, has_alpha(parts));
    const std::vector<std::byte> keys = written_keys(options.attributes);
    header_.descriptor = {header_bytes(header_.levels.size()), descriptor.size()};
    header_.keys = {header_.descriptor.offset + descriptor.size(), keys.size()};
    if (header_.keys.offset + header_.keys.bytes > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::too_large, "the attributes need more than 4 GiB");
    head_ = descriptor;
    head_.insert(head_.end(), keys.begin(), keys.end());
    for (std::size_t level = 0; level < header_.levels.size(); ++level)
      header_.levels[level].unpacked_bytes = header_.level_bytes(level);
  }

  WriteReport write(ByteSink& file) {
    return header_.scheme == Scheme::none ? write_plain(file) : write_packed(file);
  }

 private:
  /// Rows of a level, counted through all its pictures.
  WriteReport encode_rows(std::size_t level, std::size_t first, std::size_t end, std::byte* out) const {
    constexpr std::size_t kBytesOfTask = 1 << 16;
    const auto height = static_cast<std::size_t>(stored_rows(*header_.format, header_.height_of(level)));
    const std::size_t stride = row_bytes(level), grain = std::max<std::size_t>(1, kBytesOfTask / stride);
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(first, end, grain), WriteReport{},
        [&](const tbb::blocked_range<std::size_t>& rows, WriteReport report) {
          for (std::size_t row = rows.begin(); row < rows.end(); ++row) {
            const std::size_t picture = row / height;
            const ImageView<const float>& image =
                pictures_.at(static_cast<int>(level), static_cast<int>(picture)).image;
            const TexelEncoder& encoder =
                encoders_[level * static_cast<std::size_t>(pictures_.of_level()) + picture];
            const int y = static_cast<int>(row % height) * header_.format->block();
            const int texel_rows = std::min(header_.format->block(), image.height - y);
            encoder.encode(image.part(0, y, image.width, texel_rows), {out + (row - first) * stride, stride},
                           report);
          }
          return report;
        },
        [](const WriteReport& a, const WriteReport& b) { return a + b; }, tbb::simple_partitioner());
  }

  std::size_t row_bytes(std::size_t level) const {
    return static_cast<std::size_t>(texels::row_bytes(*header_.format, header_.width_of(level)));
  }
  std::size_t rows(std::size_t level) const {
    return static_cast<std::size_t>(stored_rows(*header_.format, header_.height_of(level))) *
           static_cast<std::size_t>(pictures_.of_level());
  }

  /// Gives the levels, whose stored sizes are known, their offsets, and writes what precedes them.
  void write_head(ByteSink& file) {
    const std::uint64_t alignment = level_alignment(header_);
    std::uint64_t offset = header_.keys.offset + header_.keys.bytes;
    for (std::size_t level = header_.levels.size(); level-- > 0;) {
      Section& stored = header_.levels[level].stored;
      stored.offset = (offset + alignment - 1) / alignment * alignment;
      offset = stored.offset + stored.bytes;
    }
    std::vector<std::byte> bytes = written_header(header_);
    bytes.insert(bytes.end(), head_.begin(), head_.end());
    file.write(bytes);
  }

  /// Levels have sizes that are multiples of their alignment, so only the first needs bytes before it.
  static void pad_to(ByteSink& file, std::uint64_t offset) {
    static constexpr std::array<std::byte, 16> kZeros{};
    file.write(std::span(kZeros).first(offset - file.tell()));
  }

  WriteReport write_plain(ByteSink& file) {
    for (Level& level : header_.levels) level.stored.bytes = level.unpacked_bytes;
    write_head(file);
    constexpr std::size_t kBatchBytes = std::size_t{1} << 20;
    const std::size_t largest_row = row_bytes(0);
    const std::size_t whole =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBatchBytes, header_.levels[0].unpacked_bytes));
    Buffer batch(std::max(largest_row, whole));
    WriteReport report;
    for (std::size_t level = header_.levels.size(); level-- > 0;) {
      pad_to(file, header_.levels[level].stored.offset);
      const std::size_t count = rows(level),
                        at_once = std::max<std::size_t>(1, batch.bytes().size() / row_bytes(level));
      for (std::size_t first = 0; first < count; first += at_once) {
        const std::size_t end = std::min(count, first + at_once);
        report = report + encode_rows(level, first, end, batch.bytes().data());
        file.write(batch.bytes().first((end - first) * row_bytes(level)));
      }
    }
    return report;
  }

  WriteReport write_packed(ByteSink& file) {
    std::vector<Buffer> packed(header_.levels.size());
    std::vector<WriteReport> reports(header_.levels.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, packed.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& levels) {
          for (std::size_t level = levels.begin(); level < levels.end(); ++level) {
            Buffer texels(header_.levels[level].unpacked_bytes);
            reports[level] = encode_rows(level, 0, rows(level), texels.bytes().data());
            packed[level] = pack_zstd(texels.bytes());
          }
        },
        tbb::simple_partitioner());
    WriteReport report;
    for (std::size_t level = 0; level < packed.size(); ++level) {
      header_.levels[level].stored.bytes = packed[level].bytes().size();
      report = report + reports[level];
    }
    write_head(file);
    for (std::size_t level = packed.size(); level-- > 0;) file.write(packed[level].bytes());
    return report;
  }

  Header header_;
  PictureSet pictures_;
  std::vector<TexelEncoder> encoders_;  ///< one for each picture
  std::vector<std::byte> head_;         ///< descriptor and keys
};

}  // namespace

WriteReport write_ktx2(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  return Writer(parts, options).write(file);
}

}  // namespace welkin::io::ktx2
