#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/format.h"
#include "welkin/io/part_rows.h"
#include "welkin/io/write_choices.h"

/// Portable float maps: `PF` (R G B), `Pf` (grey) or `PF4` (R G B A), width, height, a scale factor, one
/// white space, then rows of floats from the bottom to the top. A negative scale means little-endian.
/// Comments, `#` to the end of a line, are skipped where a word could begin, as in Netpbm's other formats.
///
/// The scale's absolute value states the unit of the samples (pfm(5) of Netpbm: with a separately known unit
/// it gives them a physical meaning); it is not a multiplier of the picture, and most writers put an
/// arbitrary 1 there. So it is kept as the attribute `pfm:scale`, and pixels are what the file holds.
namespace welkin::io {
namespace {

const std::string kScaleName = "pfm:scale";

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool matches(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 4));
  for (const std::string_view magic : {"PF", "Pf", "PF4"}) {
    if (text.size() > magic.size() && text.starts_with(magic) && is_space(text[magic.size()])) return true;
  }
  return false;
}

/// The number that `text` is; nothing when it is none, or 0, or infinite.
std::optional<double> scale_from(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double scale = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, scale);
  if (parsed.ec != std::errc{} || parsed.ptr != end || scale == 0 || !std::isfinite(scale)) return {};
  return scale;
}

class PfmReader : public FormatReader {
 public:
  explicit PfmReader(const Source& source) : source_(source) {
    const std::string identifier = next_word();
    const std::uint64_t width = next_size("width");
    const std::uint64_t height = next_size("height");
    const std::string scale_text = next_word();
    const std::optional<double> scale = scale_from(scale_text);
    if (!scale)
      fail("the scale '" + scale_text +
           "', whose sign tells the order of bytes, is not a number other than 0");
    order_ = *scale < 0 ? std::endian::little : std::endian::big;

    std::vector<std::string> channels = {"Y"};
    if (identifier == "PF") channels = {"R", "G", "B"};
    if (identifier == "PF4") channels = {"R", "G", "B", "A"};
    check_size(source, width, height, channels.size());
    row_bytes_ = static_cast<std::size_t>(width) * channels.size() * sizeof(float);
    const std::uint64_t needed = row_bytes_ * height;
    skip_space_before(needed);
    const std::uint64_t held = source.bytes.size() - at_;
    if (held < needed) {
      fail("ends early (byte " + std::to_string(source.bytes.size()) + "): the pixels end at byte " +
           std::to_string(at_ + needed));
    }

    info_.format = "pfm";
    info_.bytes = source.bytes.size();
    info_.colour = source.options.colour == Colour::srgb ? Colour::srgb : Colour::linear;
    if (std::fabs(*scale) != 1) {
      info_.attributes[kScaleName] = scale_text.substr(scale_text.find_first_not_of("+-"));
      info_.warnings.push_back("its scale of " + info_.attributes[kScaleName] +
                               " is a unit and multiplies no pixel");
    }
    if (order_ == std::endian::big) info_.notes.push_back("big-endian");
    if (held > needed)
      info_.warnings.push_back(std::to_string(held - needed) + " bytes follow the pixels and are not read");
    info_.parts.push_back(
        {"", static_cast<int>(width), static_cast<int>(height), channels, PixelType::float32, "none"});
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    const PixelDecoder decoder(PixelType::float32, srgb_channels(info_.parts[0].channels, info_.colour));
    const bool whole = channels.size() == info_.parts[0].channels.size() && info_.colour == Colour::linear &&
                       std::is_sorted(channels.begin(), channels.end()) &&
                       channels.back() + 1 == out.channels;
    tbb::parallel_for(tbb::blocked_range<int>(0, out.height, 16), [&](const tbb::blocked_range<int>& rows) {
      std::vector<std::uint32_t> swapped(order_ == std::endian::native ? 0 : row_bytes_ / sizeof(float));
      for (int y = rows.begin(); y < rows.end(); ++y) {
        const void* row =
            source_.bytes.data() + at_ + static_cast<std::size_t>(out.height - 1 - y) * row_bytes_;
        if (order_ != std::endian::native) {
          std::memcpy(swapped.data(), row, row_bytes_);
          for (std::uint32_t& value : swapped) value = swap_bytes(value);
          row = swapped.data();
        }
        if (whole) {
          std::memcpy(out.row(y), row, row_bytes_);
        } else {
          decoder.decode(row, channels, out.width, out.row(y), out.channels);
        }
      }
    });
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw Error(ErrorKind::damaged, source_.name, cause);
  }

  std::string next_word() {
    const auto* text = reinterpret_cast<const char*>(source_.bytes.data());
    const std::size_t size = source_.bytes.size();
    constexpr std::size_t kLongestWord = 64;
    while (at_ < size && (is_space(text[at_]) || text[at_] == '#')) {
      if (text[at_] != '#') {
        ++at_;
      } else {
        while (at_ < size && text[at_] != '\n') ++at_;
      }
    }
    const std::size_t first = at_;
    while (at_ < size && !is_space(text[at_]) && at_ - first < kLongestWord) ++at_;
    if (at_ == size || !is_space(text[at_]))
      fail("the header is malformed (byte " + std::to_string(at_) + ")");
    return {text + first, text + at_};
  }

  std::uint64_t next_size(const std::string& what) {
    const std::string word = next_word();
    std::uint64_t value = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size()) {
      fail("the " + what + " '" + word + "' is not a number");
    }
    return value;
  }

  /// The white space before the pixels, which next_word has seen: one, or the two of a DOS line end, unless
  /// the second is a byte of the first pixel.
  void skip_space_before(std::uint64_t pixel_bytes) {
    const auto* text = reinterpret_cast<const char*>(source_.bytes.data());
    const std::size_t held = source_.bytes.size() - at_;
    const bool dos_header = std::string_view(text, at_).find("\r\n") != std::string_view::npos;
    const bool dos =
        held >= 2 && text[at_] == '\r' && text[at_ + 1] == '\n' && (dos_header || held - 1 != pixel_bytes);
    at_ += dos ? 2 : 1;
  }

  Source source_;
  std::size_t at_ = 0;  ///< byte offset, of the first pixel after construction
  std::size_t row_bytes_ = 0;
  std::endian order_ = std::endian::little;
};

std::unique_ptr<FormatReader> open_pfm(const Source& source) {
  return std::make_unique<PfmReader>(source);
}

/// The scale that the picture was read with, if it is still a number, for the unit it states.
std::string scale_of(const WriteOptions& options) {
  const auto found = options.attributes.find(kScaleName);
  if (found == options.attributes.end()) return "1.0";
  const double scale = std::strtod(found->second.c_str(), nullptr);
  const bool plain = found->second.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (!plain || !std::isfinite(scale) || scale <= 0 || found->second.front() == '+') {
    throw Error(ErrorKind::damaged,
                "the attribute " + kScaleName + "=" + found->second + " is not a positive number");
  }
  return found->second;
}

WriteReport write_pfm(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"none"};
  static constexpr PixelType types[] = {PixelType::float32};
  const WritePart& part = only_part(parts, "PFM");
  compression(options, known, "PFM");
  pixel_type(options, types, "PFM");
  const std::vector<int> order = channel_order(part, Alpha::none, "PFM");
  const ImageView<const float> image = part.image;

  const std::string header = std::string(order.size() == 1 ? "Pf" : "PF") + "\n" +
                             std::to_string(image.width) + " " + std::to_string(image.height) + "\n-" +
                             scale_of(options) + "\n";
  file.write(header.data(), header.size());

  const PixelEncoder encoder(PixelType::float32, order,
                             std::vector<bool>(order.size(), options.colour == Colour::srgb));
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * encoder.pixel_bytes();
  constexpr std::size_t kBatchBytes = std::size_t{1} << 20;
  int rows_of_batch = static_cast<int>(std::max<std::size_t>(1, kBatchBytes / row_bytes));
  if (part.draw) {
    // Enough to draw for every thread.
    const int all = 2 * tbb::this_task_arena::max_concurrency() * part.rows_at_once;
    rows_of_batch = (rows_of_batch + all - 1) / all * all;
  }
  std::vector<std::byte> batch;
  Image drawn;
  WriteReport report;
  for (int bottom = image.height, top = 0; bottom > 0; bottom = top) {
    top = (bottom - 1) / rows_of_batch * rows_of_batch;
    batch.resize(static_cast<std::size_t>(bottom - top) * row_bytes);
    const ImageView<const float> rows = draw_rows(part, top, bottom - top, drawn);
    for (int y = top; y < bottom; ++y) {
      std::byte* row = batch.data() + static_cast<std::size_t>(bottom - 1 - y) * row_bytes;
      encoder.encode(rows.row(y - top), image.channels, image.width, row, report);
    }
    if constexpr (std::endian::native == std::endian::big) {
      for (std::size_t i = 0; i < batch.size(); i += 4) std::reverse(&batch[i], &batch[i] + 4);
    }
    file.write(batch);
  }
  return report;
}

}  // namespace

Format pfm_format() {
  return {{.format = "pfm",
           .title = "PFM",
           .extensions = {"pfm"},
           .types = {PixelType::float32},
           .compressions = {"none"},
           .hdr = true,
           .negative = true},
          matches,
          open_pfm,
          write_pfm,
          true};
}

}  // namespace welkin::io
