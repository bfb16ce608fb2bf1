#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/map_file.h"

/// @file
/// What storing changed.
namespace welkin {

/// The difference between texels that were stored and those that are read again, each texel counted alike, as
/// textures are judged; over all channels. Errors over the sphere: compare (measure/compare.h).
struct WELKIN_API StoredError {
  double squared_error = 0;      ///< sum of (stored − given)²
  double squared = 0;            ///< sum of given²
  double squared_log_error = 0;  ///< sum of (ln(1 + stored) − ln(1 + given))², negative values counted as 0
  std::uint64_t values = 0;      ///< how many

  double relative_rmse()
      const;  ///< root of the mean of (stored − given)² over that of given²; 0 where both are 0
  double rmsle() const;  ///< root of the mean of the squared difference of logarithms

  /// The error over both.
  StoredError& operator+=(const StoredError& other);
};

/// Of two maps, or pictures, of one size. Throws Error (mismatch) for other sizes or channels.
/// @{
WELKIN_API StoredError stored_error(const Map& given, const Map& stored);
WELKIN_API StoredError stored_error(ImageView<const float> given, ImageView<const float> stored);
/// @}

/// Of each level of a chain. Throws Error (mismatch) for another number of levels, and as stored_error.
WELKIN_API std::vector<StoredError> stored_errors(const Chain& given, const Chain& stored);

/// How a chain is read again from a file of this shape (parse_map_shape) that it was written to: in the world
/// that it has, whatever the file can say of it.
WELKIN_API ReadMapOptions as_written(const Chain& given, const std::string& shape);

}  // namespace welkin
