#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "welkin/map/luminance.h"
#include "welkin/map/map.h"
#include "welkin/measure/energy.h"

/// Energy of rows of texels. Internal to measure.
namespace welkin {

/// A weight of directions about an axis: 1 within `inner` radians, 0 beyond `outer`, smooth between.
struct Cone {
  Vec3d axis;
  double inner, outer;

  double weight(const Vec3d& direction) const;
};

/// The longest side of the texel that shows a direction of the frame's own, radians; 0 where none does.
double texel_side(const MapFrame& frame, const Vec3d& direction);

/// The cone of a light, about `axis`, for texels of that size.
Cone cone_of(const Light& light, const Vec3d& axis, double texel);

/// Sums over texels times their solid angle.
struct EnergySum {
  std::vector<double> values;      ///< one for each channel, and last luminance
  std::vector<double> magnitudes;  ///< of |value|

  void resize(std::size_t count);
  void add(const EnergySum& other);
};

struct RowSums {
  double solid_angle = 0;           ///< of the row's valid texels
  double common = 0;                ///< of what the other map shows too
  std::uint64_t skipped = 0;        ///< texels that aren't finite
  EnergySum whole;                  ///< of what the other map shows too
  std::vector<EnergySum> in_cones;  ///< the same in each cone

  void add(const RowSums& other);
};

/// What the texels of a map are measured by.
struct EnergyFrame {
  MapFrame frame;
  std::vector<int> channels;  ///< that are measured
  TexelLuminance luminance;
  std::vector<Cone> cones;  ///< in the frame's own directions
  double margin = 0;        ///< radians; no texel near a cone is longer
  /// Another map, of which only what it shows counts, and the way from the frame's directions to its own.
  struct Other {
    sphere::AnyParameterization parameterization;
    Matrix3 turn;
  };
  std::optional<Other> other;  ///< none where that is all

  /// Sums of a row of texels of `texel_channels` values; nothing in cones yet. `maxima`, if given, gets the
  /// largest value of each segment of the row, no smaller than any luminance in it; ∞ where one isn't finite.
  RowSums whole(int chart, int y, const float* texels, int texel_channels, float* maxima = nullptr) const;
  /// Adds the sums in cones. Skips segments that are far from all.
  void add_cones(int chart, int y, const float* texels, int texel_channels, RowSums& sums) const;

 private:
  std::vector<float> weights(int chart, int y, bool exact) const;
  void add_texel(EnergySum& sum, const float* texel, double weight) const;
};

/// Texels of a row that are summed up together.
inline constexpr int kSegment = 64;
inline int segments_of(int width) {
  return (width + kSegment - 1) / kSegment;
}

/// The rows of a map one after another: all their sums. Solid angles of the whole add up to the coverage.
RowSums total_of(const std::vector<RowSums>& rows, double coverage);

}  // namespace welkin
