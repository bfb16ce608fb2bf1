#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/io/colour/xyz.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/hdr/header.h"
#include "welkin/io/hdr/lines.h"
#include "welkin/io/hdr/rgbe.h"
#include "welkin/io/hdr/writer.h"

namespace welkin::io {
namespace {

/// Where a scan line is stored.
struct StoredLine {
  std::size_t at = 0;
  HdrCoding coding = HdrCoding::flat;
};

class HdrReader : public FormatReader {
 public:
  explicit HdrReader(const Source& source) : source_(source), header_(parse_hdr_header(source)) {
    const std::size_t held = source.bytes.size() - header_.pixels_at;
    const std::uint64_t minimum =
        static_cast<std::uint64_t>(header_.lines()) * min_hdr_line_bytes(header_.line_length());
    if (held < minimum) {
      throw Error(ErrorKind::damaged, source.name,
                  "ends early (byte " + std::to_string(source.bytes.size()) +
                      "): " + std::to_string(header_.lines()) + " scan lines need at least " +
                      std::to_string(minimum) + " bytes");
    }
    try {
      body_ = hdr_body(source.bytes, header_.pixels_at, header_.lines(), header_.line_length());
    } catch (const Error& error) {
      throw in_file(source.name, error);
    }
    HdrCoding coding;
    line_end(0, header_.pixels_at, coding);

    info_.format = "hdr";
    info_.bytes = source.bytes.size();
    info_.colour = source.options.colour == Colour::srgb ? Colour::srgb : Colour::linear;
    info_.attributes = header_.attributes;
    info_.notes = header_.notes;
    info_.warnings = header_.warnings;
    declared_.primaries = header_.primaries;
    if (header_.gamma != 1) {
      declared_.curve = Curve::gamma;
      declared_.gamma = header_.gamma;
    }
    if (body_.following > 0) {
      info_.warnings.push_back(std::to_string(body_.following) + " bytes follow the pixels and are not read");
    }
    info_.notes.push_back("RGBE: 8-bit mantissas with a shared exponent");
    if (header_.xyze) {
      info_.notes.push_back(
          "XYZE, converted to linear RGB of sRGB primaries and white; Y=1 is kept as white of 1");
    }
    // The divisor divides linear values, so before the power it is the root.
    for (int k = 0; k < 3; ++k)
      divisor_[k] = static_cast<float>(std::pow(header_.divisor[k], 1 / header_.gamma));
    divided_ = std::any_of(divisor_, divisor_ + 3, [](float d) { return d != 1; });
    if (divided_) info_.notes.push_back("divided by the EXPOSURE and COLORCORR of its header");
    info_.parts.push_back({"",
                           header_.width,
                           header_.height,
                           {"R", "G", "B"},
                           PixelType::float32,
                           coding == HdrCoding::flat ? "none" : "rle"});
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override;

 private:
  std::size_t line_end(int line, std::size_t at, HdrCoding& coding) const {
    if (body_.flat) {
      coding = HdrCoding::flat;
      return at + 4 * static_cast<std::size_t>(header_.line_length());
    }
    try {
      return hdr_line_end(source_.bytes, at, line, header_.line_length(), coding);
    } catch (const Error& error) {
      throw in_file(source_.name, error);
    }
  }
  void decode_line(const StoredLine& stored, int line, HdrPlanes& planes, float* rgb,
                   const PixelDecoder& decoder, std::span<const int> channels, ImageView<float> out) const;

  Source source_;
  HdrHeader header_;
  HdrBody body_;
  float divisor_[3] = {1, 1, 1};
  bool divided_ = false;
};

/// One scan line to where it belongs in `out`. The common one, an upright row of R G B, goes there directly.
void HdrReader::decode_line(const StoredLine& stored, int line, HdrPlanes& planes, float* rgb,
                            const PixelDecoder& decoder, std::span<const int> channels,
                            ImageView<float> out) const {
  const int length = header_.line_length();
  decode_hdr_line(source_.bytes.data() + stored.at, stored.coding, planes);

  int x = header_.columns ? line : 0;
  int y = header_.columns ? 0 : line;
  if (header_.from_right) x = header_.width - 1 - x;
  if (header_.from_bottom) y = header_.height - 1 - y;
  std::ptrdiff_t step = header_.columns ? out.row_stride : out.channels;
  if (header_.columns ? header_.from_bottom : header_.from_right) step = -step;
  float* const first = out.at(x, y);

  const bool all = channels.size() == 3 && channels[0] == 0 && channels[1] == 1 && channels[2] == 2;
  const bool plain = !header_.xyze && !divided_ && info_.colour == Colour::linear;
  if (all && plain && step == 3) {
    decode_rgbe(planes[0], planes[1], planes[2], planes[3], length, first);
    return;
  }
  decode_rgbe(planes[0], planes[1], planes[2], planes[3], length, rgb);
  for (int i = 0; i < length && !plain; ++i) {
    for (int k = 0; k < 3; ++k) rgb[3 * i + k] /= divisor_[k];
    if (header_.xyze) xyz_to_rgb(rgb + 3 * i);
  }
  decoder.decode(rgb, channels, length, first, step);
}

void HdrReader::decode(std::size_t part, std::span<const int> channels, ImageView<float> out) {
  assert(part == 0 && out.width == header_.width && out.height == header_.height);
  assert(channels.size() == static_cast<std::size_t>(out.channels));
  static_cast<void>(part);
  const PixelDecoder decoder(PixelType::float32, srgb_channels(info_.parts[0].channels, info_.colour));

  // One stage walks over the run codes to find where scan lines start; behind it all threads decode.
  constexpr int kPixelsOfBatch = 1 << 15;
  const int length = header_.line_length();
  const int lines_of_batch = std::max(1, kPixelsOfBatch / length);
  std::size_t at = header_.pixels_at;
  std::vector<StoredLine> lines(static_cast<std::size_t>(header_.lines()));
  int next = 0;
  // What travels between the stages owns nothing: TBB may forget it where another line throws.
  const auto find_lines = [&](tbb::flow_control& control) {
    const int first = next, end = std::min(next + lines_of_batch, header_.lines());
    for (; next < end; ++next) {
      StoredLine& line = lines[static_cast<std::size_t>(next)];
      line.at = at;
      at = line_end(next, at, line.coding);
    }
    if (first == end) control.stop();
    return first;
  };
  const auto decode_lines = [&](int first) {
    const int end = std::min(first + lines_of_batch, header_.lines());
    HdrPlanes planes(length);
    std::vector<float> rgb(3 * static_cast<std::size_t>(length));
    for (int line = first; line < end; ++line)
      decode_line(lines[static_cast<std::size_t>(line)], line, planes, rgb.data(), decoder, channels, out);
  };
  tbb::parallel_pipeline(static_cast<std::size_t>(4 * tbb::this_task_arena::max_concurrency()),
                         tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, find_lines) &
                             tbb::make_filter<int, void>(tbb::filter_mode::parallel, decode_lines));
}

std::unique_ptr<FormatReader> open_hdr(const Source& source) {
  return std::make_unique<HdrReader>(source);
}

}  // namespace

Format hdr_format() {
  return {{.format = "hdr",
           .title = "HDR",
           .extensions = {"hdr"},
           .types = {PixelType::float32},
           .compressions = {"rle", "none"},
           .lossless = false,
           .hdr = true,
           .attributes = true},
          is_hdr,
          open_hdr,
          write_hdr,
          true};
}

}  // namespace welkin::io
