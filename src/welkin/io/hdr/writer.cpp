#include "welkin/io/hdr/writer.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/hdr/lines.h"
#include "welkin/io/hdr/rgbe.h"
#include "welkin/io/part_rows.h"
#include "welkin/io/text_attributes.h"
#include "welkin/io/write_choices.h"

namespace welkin::io {
namespace {

/// x clamped to [0, kLargestRgbe]; counts what is lost.
float to_rgbe_range(float x, WriteReport& report) {
  if (x >= 0 && x <= kLargestRgbe) [[likely]] {
    return x;
  }
  if (!std::isfinite(x)) {
    ++report.not_finite;
    return x > 0 ? kLargestRgbe : 0.0f;
  }
  ++(x < 0 ? report.below : report.above);
  return x < 0 ? 0.0f : kLargestRgbe;
}

struct EncodedRows {
  std::vector<std::byte> bytes;
  WriteReport report;
};

class RowEncoder {
 public:
  RowEncoder(const WritePart& part, HdrCoding coding, bool srgb)
      : part_(part), order_(channel_order(part, Alpha::none, "HDR")), coding_(coding), srgb_(srgb) {}

  void encode(int first, int end, EncodedRows& rows) const {
    rows.bytes.clear();
    rows.report = {};
    PartRows source(part_);
    const ImageView<const float> image = source.rows(first, end - first);
    HdrPlanes planes(image.width);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        float rgb[3] = {};
        for (std::size_t k = 0; k < order_.size(); ++k) {
          const float value = image.at(x, y)[order_[k]];
          rgb[k] = to_rgbe_range(srgb_ ? static_cast<float>(linear_to_srgb(value)) : value, rows.report);
        }
        if (order_.size() == 1) rgb[1] = rgb[2] = rgb[0];
        std::uint8_t pixel[4];
        encode_rgbe(rgb[0], rgb[1], rgb[2], pixel);
        for (int k = 0; k < 4; ++k) planes[k][x] = pixel[k];
      }
      encode_hdr_line(planes, coding_, rows.bytes);
    }
  }

 private:
  const WritePart& part_;
  std::vector<int> order_;
  HdrCoding coding_;
  bool srgb_;
};

}  // namespace

WriteReport write_hdr(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"rle", "none"};
  static constexpr PixelType types[] = {PixelType::float32};
  const WritePart& part = only_part(parts, "HDR");
  pixel_type(options, types, "HDR");
  const HdrCoding coding =
      compression(options, known, "HDR") == "none" ? HdrCoding::flat : HdrCoding::components;
  const RowEncoder encoder(part, coding, options.colour == Colour::srgb);

  auto attributes = options.attributes;
  for (const char* of_the_pixels : {"EXPOSURE", "COLORCORR", "FORMAT", "GAMMA", "PIXASPECT", "PRIMARIES"})
    attributes.erase(of_the_pixels);
  const std::string header = "#?RADIANCE\n" + attribute_lines(attributes, "history") +
                             "FORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(part.image.height) + " +X " +
                             std::to_string(part.image.width) + "\n";
  file.write(header.data(), header.size());

  constexpr int kPixelsOfBatch = 1 << 15;
  const int rows_of_batch = std::max(1, kPixelsOfBatch / part.image.width);
  // They are written in order, so that with this many at work none is overwritten before it is written. What
  // travels between the stages owns nothing: TBB may forget it where another stage throws.
  std::vector<EncodedRows> encoded(static_cast<std::size_t>(4 * tbb::this_task_arena::max_concurrency()));
  WriteReport report;
  int next = 0;
  const auto choose_rows = [&](tbb::flow_control& control) {
    const int first = next;
    next = std::min(next + rows_of_batch, part.image.height);
    if (first == next) control.stop();
    return first;
  };
  const auto encode = [&](int first) {
    EncodedRows& rows = encoded[static_cast<std::size_t>(first / rows_of_batch) % encoded.size()];
    encoder.encode(first, std::min(first + rows_of_batch, part.image.height), rows);
    return &rows;
  };
  const auto write = [&](const EncodedRows* rows) {
    file.write(rows->bytes);
    report = report + rows->report;
  };
  tbb::parallel_pipeline(encoded.size(),
                         tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, choose_rows) &
                             tbb::make_filter<int, EncodedRows*>(tbb::filter_mode::parallel, encode) &
                             tbb::make_filter<EncodedRows*, void>(tbb::filter_mode::serial_in_order, write));
  return report;
}

}  // namespace welkin::io
