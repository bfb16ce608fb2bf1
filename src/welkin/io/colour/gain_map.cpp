#include "welkin/io/colour/gain_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/io/byte_order.h"

namespace welkin::io {
namespace {

[[noreturn]] void fail_range() {
  throw Error(ErrorKind::damaged, "its gain map's numbers are out of range");
}

void check(const GainMapMetadata& metadata) {
  constexpr double kMostStops = 64;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool sound = std::fabs(metadata.minimum[c]) <= kMostStops &&
                       std::fabs(metadata.maximum[c]) <= kMostStops && metadata.gamma[c] > 0 &&
                       std::isfinite(metadata.gamma[c]) && std::fabs(metadata.base_offset[c]) <= 1 &&
                       std::fabs(metadata.alternate_offset[c]) <= 1;
    if (!sound) fail_range();
  }
}

/// Big-endian numbers one after the other.
class Numbers {
 public:
  explicit Numbers(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    if (bytes_.size() < sizeof(T)) throw Error(ErrorKind::damaged, "its gain map's metadata end early");
    const std::byte* const at = bytes_.data();
    bytes_ = bytes_.subspan(sizeof(T));
    if constexpr (sizeof(T) == 1) {
      return static_cast<T>(*at);
    } else {
      return static_cast<T>(load<std::make_unsigned_t<T>>(at, std::endian::big));
    }
  }

 private:
  std::span<const std::byte> bytes_;
};

/// An array of XMP with one value, or with one for each of R G B.
void take_numbers(const Xmp& xmp, const char* name, std::array<double, 3>& values) {
  const std::vector<std::string> texts = xmp.texts(kHdrGainMapSpace, name);
  if (texts.empty()) return;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto number = parse_number(texts[texts.size() == 3 ? c : 0]);
    if (!number) throw Error(ErrorKind::damaged, "its gain map's " + std::string(name) + " is no number");
    values[c] = *number;
  }
}

}  // namespace

std::optional<GainMapMetadata> gain_map_metadata(const Xmp& xmp) {
  if (!xmp.text(kHdrGainMapSpace, "GainMapMax")) return std::nullopt;
  GainMapMetadata metadata;
  take_numbers(xmp, "GainMapMin", metadata.minimum);
  take_numbers(xmp, "GainMapMax", metadata.maximum);
  take_numbers(xmp, "Gamma", metadata.gamma);
  take_numbers(xmp, "OffsetSDR", metadata.base_offset);
  take_numbers(xmp, "OffsetHDR", metadata.alternate_offset);
  metadata.base_is_hdr = xmp.text(kHdrGainMapSpace, "BaseRenditionIsHDR") == "True";
  check(metadata);
  return metadata;
}

std::optional<GainMapMetadata> gain_map_metadata(std::span<const std::byte> bytes) {
  constexpr std::size_t kVersionBytes = 4;
  constexpr unsigned kSeveralChannels = 0x80, kBaseColourSpace = 0x40, kCommonDenominator = 0x08;
  if (bytes.size() <= kVersionBytes) return std::nullopt;
  Numbers numbers(bytes);
  if (numbers.take<std::uint16_t>() != 0)
    throw Error(ErrorKind::unsupported, "its gain map is of a later version of ISO 21496-1");
  numbers.take<std::uint16_t>();
  const unsigned flags = numbers.take<std::uint8_t>();
  const double common = (flags & kCommonDenominator) != 0 ? numbers.take<std::uint32_t>() : 0;
  const auto fraction = [&]<class T>(T) {
    const auto numerator = static_cast<double>(numbers.take<T>());
    return numerator / ((flags & kCommonDenominator) != 0 ? common : numbers.take<std::uint32_t>());
  };
  const double base_headroom = fraction(std::uint32_t{}), alternate_headroom = fraction(std::uint32_t{});
  if (!std::isfinite(base_headroom) || !std::isfinite(alternate_headroom)) fail_range();
  GainMapMetadata metadata;
  for (std::size_t c = 0; c < ((flags & kSeveralChannels) != 0 ? 3 : 1); ++c) {
    metadata.minimum[c] = fraction(std::int32_t{});
    metadata.maximum[c] = fraction(std::int32_t{});
    metadata.gamma[c] = fraction(std::uint32_t{});
    metadata.base_offset[c] = fraction(std::int32_t{});
    metadata.alternate_offset[c] = fraction(std::int32_t{});
  }
  if ((flags & kSeveralChannels) == 0) {
    for (auto* values : {&metadata.minimum, &metadata.maximum, &metadata.gamma, &metadata.base_offset,
                         &metadata.alternate_offset})
      values->fill(values->front());
  }
  metadata.base_is_hdr = base_headroom > alternate_headroom;
  metadata.base_colour_space = (flags & kBaseColourSpace) != 0;
  check(metadata);
  return metadata;
}

void declare_gain_map(const GainMapMetadata& metadata, std::unique_ptr<Reader> reader, Declared& declared,
                      FileInfo& info) {
  if (metadata.base_is_hdr) {
    info.notes.push_back("its gain map makes a picture of lower range, and is left out");
    return;
  }
  if (!metadata.base_colour_space)
    info.warnings.push_back(
        "its gain map is of other primaries than its picture; it is applied all the same");
  declared.gain_map = std::make_shared<GainMap>(metadata, std::move(reader));
}

double GainMap::stops() const {
  return *std::max_element(metadata_.maximum.begin(), metadata_.maximum.end());
}

const Image& GainMap::picture() {
  const std::lock_guard lock(mutex_);
  if (!picture_) {
    const PartInfo& part = reader_->info().parts[0];
    std::vector<int> channels;
    for (std::size_t c = 0; c < part.channels.size(); ++c) channels.push_back(static_cast<int>(c));
    Image picture(part.width, part.height, static_cast<int>(channels.size()));
    reader_->read(0, channels, picture.view());
    picture_.emplace(std::move(picture));
  }
  return *picture_;
}

void GainMap::apply(ImageView<float> base, int r, int g, int b) {
  const Image& gains = picture();
  const int colours[3] = {r, g, b};
  const bool several = gains.channels() >= 3;
  /// A position among `count` texels, the two texels beside it and the second's weight.
  struct Place {
    int first, second;
    double weight;
  };
  const auto place = [](int i, int of, int count) {
    const double at = std::clamp((i + 0.5) * count / of - 0.5, 0.0, count - 1.0);
    const int first = static_cast<int>(at);
    return Place{first, std::min(first + 1, count - 1), at - first};
  };
  parallel_for(base.height, [&](int y) {
    const Place row = place(y, base.height, gains.height());
    for (int x = 0; x < base.width; ++x) {
      const Place column = place(x, base.width, gains.width());
      for (std::size_t c = 0; c < 3; ++c) {
        if (c > 0 && colours[c] == colours[0]) break;  // grey
        const auto at = [&](int i, int j) { return static_cast<double>(gains.at(i, j)[several ? c : 0]); };
        const double upper =
            std::lerp(at(column.first, row.first), at(column.second, row.first), column.weight);
        const double lower =
            std::lerp(at(column.first, row.second), at(column.second, row.second), column.weight);
        const double stored = std::lerp(upper, lower, row.weight);
        const double gain =
            std::lerp(metadata_.minimum[c], metadata_.maximum[c], std::pow(stored, 1 / metadata_.gamma[c]));
        float& value = base.at(x, y)[colours[c]];
        value = static_cast<float>(
            std::max(0.0, (static_cast<double>(value) + metadata_.base_offset[c]) * std::exp2(gain) -
                              metadata_.alternate_offset[c]));
      }
    }
  });
}

}  // namespace welkin::io
