#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "welkin/image/image.h"
#include "welkin/io/declared.h"
#include "welkin/io/image_file.h"
#include "welkin/io/xmp.h"

namespace welkin::io {

/// How a gain map makes a picture of high dynamic range out of its base: in linear light of the base's
/// primaries, 1 being diffuse white, hdr = (sdr + base_offset)·2^gain − alternate_offset with gain = minimum
/// + (maximum − minimum)·stored^(1/gamma). Source: ISO 21496-1:2025; Adobe, "Gain Map Specification" 1.0,
/// equations 2 to 4, at its full weight of 1.
struct GainMapMetadata {
  std::array<double, 3> minimum{0, 0, 0};  ///< log₂
  std::array<double, 3> maximum{1, 1, 1};  ///< log₂
  std::array<double, 3> gamma{1, 1, 1};
  std::array<double, 3> base_offset{1.0 / 64, 1.0 / 64, 1.0 / 64};
  std::array<double, 3> alternate_offset{1.0 / 64, 1.0 / 64, 1.0 / 64};
  bool base_is_hdr = false;       ///< the gain map makes the picture of low dynamic range then
  bool base_colour_space = true;  ///< gains are of the base's primaries
};

/// Of XMP's namespace hdrgm; nothing where it isn't used. Throws Error (damaged) for numbers that can't be
/// meant.
std::optional<GainMapMetadata> gain_map_metadata(const Xmp& xmp);
/// Of ISO 21496-1's bytes, as a JPEG's marker holds them after its name; nothing where they name the version
/// alone, as in the base picture. Throws Error (damaged, unsupported).
std::optional<GainMapMetadata> gain_map_metadata(std::span<const std::byte> bytes);

/// A gain map with its picture, which is read at first use.
class GainMap {
 public:
  /// `reader` gives the picture as it is stored: 1 is the largest code.
  GainMap(const GainMapMetadata& metadata, std::unique_ptr<Reader> reader)
      : metadata_(metadata), reader_(std::move(reader)) {}

  const GainMapMetadata& metadata() const { return metadata_; }
  /// The largest factor, as log₂.
  double stops() const;
  /// Makes the base, linear, into the picture of high dynamic range. The gains are interpolated between their
  /// texels' centres. Channels `r`, `g`, `b` of the view; all the same of grey.
  void apply(ImageView<float> base, int r, int g, int b);

 private:
  const Image& picture();

  GainMapMetadata metadata_;
  std::unique_ptr<Reader> reader_;
  std::mutex mutex_;
  std::optional<Image> picture_;
};

/// Has the gain map applied when the file's picture is read, unless that is HDR without it; notes and warns
/// of what is left out.
void declare_gain_map(const GainMapMetadata& metadata, std::unique_ptr<Reader> reader, Declared& declared,
                      FileInfo& info);

}  // namespace welkin::io
