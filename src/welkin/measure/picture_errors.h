#pragma once

#include <cstdint>
#include <optional>

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// The error between two pictures of one view: an approximation and the truth.
namespace welkin {

/// The error of a picture against the truth, over the pixels that count, all of whose channels count alike.
struct PictureErrors {
  double relative_rmse = 0;  ///< root of the mean of (a − t)² over that of t²; 0 when there is no error
  double mean_error = 0;     ///< mean of a − t over the mean of t: above 0, the approximation is too bright
  double maximum = 0;        ///< the largest |a − t|
  int maximum_x = 0;         ///< its column
  int maximum_y = 0;         ///< its row
  double truth_noise =
      0;  ///< the part of relative_rmse that the truth's standard error makes; 0 of an exact one
  std::uint64_t pixels = 0;   ///< that count
  std::uint64_t skipped = 0;  ///< that don't, for a value is NaN or infinite
};

/// What is compared.
struct PicturePair {
  ImageView<const float> approximation;  ///< one, three or four channels: the fourth, alpha, isn't compared
  ImageView<const float> truth;          ///< of the same size and channels
  /// Standard errors of the truth's values, of its size; none: it is exact.
  std::optional<ImageView<const float>> truth_error = {};
};

/// Over the pixels in which either of the alphas is above 0, or over all where there is none. Throws Error
/// (mismatch) where sizes or channels differ, (bad_request) for another number of channels.
WELKIN_API PictureErrors picture_errors(const PicturePair& pair);

/// R G B: the approximation, the truth, and their difference, side by side with a gap of white between. The
/// difference is a colour for the logarithm of a pixel's relative error, from dark violet at
/// kPictureErrorMinimum to light yellow at 1: the root mean square over channels of a − t by that of t, which
/// counts as at least a tenth of the picture's; grey where nothing counts. Throws as picture_errors.
WELKIN_API Image side_by_side(const PicturePair& pair);
/// The relative error at the dark end.
inline constexpr double kPictureErrorMinimum = 1e-3;

}  // namespace welkin
