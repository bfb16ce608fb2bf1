#pragma once

#include <memory>

#include "welkin/base/monitor.h"
#include "welkin/harmonics/harmonics.h"
#include "welkin/map/map.h"

/// The harmonics of maps whose texels are constant over their solid angle. Internal to harmonics.
namespace welkin::harmonics {

/// Integrals of spherical harmonics over the texels of maps of one frame, in axes of its own; the frame's
/// orientation is left to the caller.
class TexelHarmonics {
 public:
  virtual ~TexelHarmonics() = default;

  /// Σ over texels of their value times ∫ Y over them, for all channels. Values are added up in whatever
  /// precision keeps 1e-7 of the norm; where some aren't finite, neither is the sum.
  virtual SphericalHarmonics analyse(const Map& map, const Monitor& monitor) const = 0;

  /// The mean of a function over each texel, of as many channels as the map. Texels that are not valid become
  /// 0.
  virtual void write_means(const SphericalHarmonics& function, Map& map, const Monitor& monitor) const = 0;

  /// analyse(write_means(function)), in float64: symmetric, with eigenvalues from 0 to 1.
  virtual SphericalHarmonics through_texels(const SphericalHarmonics& function) const = 0;

  /// Keeps what takes time to find again, where it isn't too large. Before other threads use it.
  virtual void keep_points() {}

  /// From directions of the map to the axes of its harmonics.
  virtual Matrix3 axes() const { return {}; }
};

/// Along rows where those are latitudes and columns longitudes, by quadrature points for all others.
std::unique_ptr<TexelHarmonics> make_texel_harmonics(const MapFrame& frame, int degree);

/// None where rows are no latitudes.
std::unique_ptr<TexelHarmonics> make_longitude_harmonics(const MapFrame& frame, int degree);
std::unique_ptr<TexelHarmonics> make_point_harmonics(const MapFrame& frame, int degree);

}  // namespace welkin::harmonics
