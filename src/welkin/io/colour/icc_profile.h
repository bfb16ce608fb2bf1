#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "welkin/image/image.h"
#include "welkin/math/rotation.h"

namespace welkin::io {

/// An ICC profile of pictures of grey or R G B, read by Little CMS.
class IccProfile {
 public:
  /// Throws Error (unsupported, damaged, too_large) with a cause that says what the profile is instead.
  explicit IccProfile(std::span<const std::byte> bytes);
  ~IccProfile();
  IccProfile(IccProfile&&) noexcept;

  int channels() const;             ///< 1 for grey, 3 for R G B
  const std::string& name() const;  ///< its description
  /// Whether it says within 1e-3 what sRGB says, so that the exact formula can be used.
  bool is_srgb() const;
  /// Colour primaries, transfer function, matrix, range of ITU-T H.273, where a tag `cicp` gives them: they
  /// say of HDR what a profile cannot.
  struct CodePoints {
    int primaries, transfer;
  };
  std::optional<CodePoints> code_points() const;

  /// Replaces stored values, 1 being the largest code, by linear light: BT.709's R G B, or with
  /// `keep_primaries` the profile's own, where it is a matrix and curves (else BT.709's too). Channels `r`,
  /// `g`, `b` of the view; all the same of grey. Relative colorimetric: white stays white, and NaN
  /// NaN. Rows in parallel.
  void to_linear(ImageView<float> pixels, int r, int g, int b, bool keep_primaries) const;
  /// Whether keep_primaries can be met.
  bool has_primaries() const;
  /// Linear R G B of its own primaries, where it has them, to BT.709's.
  Matrix3 to_bt709() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace welkin::io
