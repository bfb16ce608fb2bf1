#include "welkin/io/texels/picture.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/write_choices.h"
#include "welkin/texture/astc_hdr.h"
#include "welkin/texture/bc6h.h"

namespace welkin::io::texels {
namespace {

constexpr std::size_t kBytesOfTask = 1 << 16;

std::size_t grain_of(std::size_t row) {
  return std::max<std::size_t>(1, kBytesOfTask / std::max<std::size_t>(row, 1));
}

void decode_blocks(const TexelFormat& format, std::span<const std::byte> blocks, ImageView<float> out) {
  format.type == PixelType::bc6h ? decode_bc6h(blocks, format.is_signed, out) : decode_astc_hdr(blocks, out);
}

}  // namespace

int stored_rows(const TexelFormat& format, int height) {
  return (height + format.block() - 1) / format.block();
}

std::uint64_t row_bytes(const TexelFormat& format, int width) {
  return static_cast<std::uint64_t>((width + format.block() - 1) / format.block()) * format.bytes();
}

std::uint64_t picture_bytes(const TexelFormat& format, int width, int height) {
  return row_bytes(format, width) * static_cast<std::uint64_t>(stored_rows(format, height));
}

void read_picture(const StoredPicture& picture, std::span<const int> channels, ImageView<float> out) {
  const TexelFormat& format = *picture.format;
  std::vector<std::string> names;
  for (const char name : format.channels) names.emplace_back(1, name);
  std::vector<int> stored;
  std::vector<std::pair<int, float>> constants;
  for (const int channel : channels) {
    if (channel < 0) constants.emplace_back(static_cast<int>(stored.size()), channel == kOne ? 1.0f : 0.0f);
    stored.push_back(std::max(channel, 0));
  }
  const PixelDecoder decoder(format.plain() ? format.type : PixelType::float32,
                             srgb_channels(names, picture.colour));
  // All of a texel, or all but A, in order.
  const bool in_order = stored == std::vector<int>{0, 1, 2} || stored == std::vector<int>{0, 1, 2, 3};
  const DecodeHalfTexels decode_halves = in_order && constants.empty() && names.size() == 4 &&
                                                 format.plain() && format.type == PixelType::half &&
                                                 picture.colour == Colour::linear && !picture.from_right &&
                                                 out.channels == static_cast<int>(stored.size())
                                             ? decode_half_texels()
                                             : nullptr;
  const int block = format.block(), width = out.width;
  const auto bytes = static_cast<std::size_t>(row_bytes(format, width));
  const std::size_t row_values = format.channels.size() * static_cast<std::size_t>(width);
  const auto read_row = [&](int row, std::vector<float>& floats) {
    const std::span<const std::byte> texels(
        picture.bytes + static_cast<std::size_t>(row) * picture.row_stride, bytes);
    const int height = std::min(block, out.height - row * block);
    if (format.coding == Coding::blocks) {
      decode_blocks(format, texels,
                    {floats.data(), width, height, static_cast<int>(format.channels.size()),
                     static_cast<std::ptrdiff_t>(row_values)});
    } else if (!format.plain()) {
      decode_values(format, texels.data(), width, floats.data());
    }
    for (int i = 0; i < height; ++i) {
      const int y = picture.from_bottom ? out.height - 1 - (row * block + i) : row * block + i;
      if (decode_halves != nullptr) {
        decode_halves(texels.data(), width, out.row(y), out.channels);
        continue;
      }
      const void* const values = format.plain() ? static_cast<const void*>(texels.data())
                                                : floats.data() + static_cast<std::size_t>(i) * row_values;
      float* const to = picture.from_right ? out.at(width - 1, y) : out.row(y);
      decoder.decode(values, stored, width, to, picture.from_right ? -out.channels : out.channels);
      for (const auto& [k, value] : constants) {
        for (int x = 0; x < width; ++x) out.at(x, y)[k] = value;
      }
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<int>(0, stored_rows(format, out.height), grain_of(bytes)),
      [&](const tbb::blocked_range<int>& rows) {
        std::vector<float> floats(format.plain() ? 0 : row_values * static_cast<std::size_t>(block));
        for (int row = rows.begin(); row < rows.end(); ++row) read_row(row, floats);
      });
}

WriteReport write_picture(const TexelEncoder& encoder, const TexelFormat& format,
                          ImageView<const float> picture, std::span<std::byte> out) {
  const auto stride = static_cast<std::size_t>(row_bytes(format, picture.width));
  const int block = format.block();
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, stored_rows(format, picture.height), grain_of(stride)), WriteReport{},
      [&](const tbb::blocked_range<int>& rows, WriteReport report) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
          const int y = row * block, height = std::min(block, picture.height - y);
          encoder.encode(picture.part(0, y, picture.width, height),
                         out.subspan(static_cast<std::size_t>(row) * stride, stride), report);
        }
        return report;
      },
      [](const WriteReport& a, const WriteReport& b) { return a + b; }, tbb::simple_partitioner());
}

PictureWriter::PictureWriter(const WriteOptions& options, std::string_view title)
    : type_(pixel_type(options, kTypes, title)),
      format_(&format_for(type_)),
      colour_(colour_for(type_, options.colour)),
      quality_(options.texture_quality),
      holder_(title) {
  if (colour_ == Colour::srgb)
    throw Error(ErrorKind::unsupported,
                holder_ + " of floats cannot say that its values are sRGB-encoded: write it linear");
  if (is_packed(type_)) holder_ += " of " + std::string(name_of(type_));
}

WriteReport PictureWriter::write(ByteSink& file, const WritePart& part) {
  const TexelEncoder encoder(type_,
                             channel_order(part, is_packed(type_) ? Alpha::none : Alpha::allowed, holder_),
                             colour_, false, quality_);
  // Bands that stay in the cache between encoding and the system's copy.
  constexpr std::size_t kBandBytes = std::size_t{1} << 20;
  const auto stride = static_cast<std::size_t>(row_bytes(*format_, part.image.width));
  const int block = format_->block();
  const int band = block * static_cast<int>(std::max<std::size_t>(1, kBandBytes / stride));
  WriteReport report;
  for (int y = 0; y < part.image.height; y += band) {
    const int height = std::min(band, part.image.height - y);
    bytes_.resize(static_cast<std::size_t>(stored_rows(*format_, height)) * stride);
    report =
        report + write_picture(encoder, *format_, part.image.part(0, y, part.image.width, height), bytes_);
    file.write(bytes_);
  }
  return report;
}

}  // namespace welkin::io::texels
