#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// @file
/// How much light there is: in a map, in its brightest lights, and before and after a conversion.
///
/// Each texel is its radiance, constant over its solid angle; on the rim of a disc also those whose centre
/// lies outside, which hold what is beside them (fill_borders). Values of texels in which a channel is NaN or
/// infinite count as 0. The same numbers whatever the number of threads.
namespace welkin {

/// Light of the sphere, or of a part of it.
struct Energy {
  /// ∫ L dω, radiance·sr, of each channel but A, unless there is no other.
  std::vector<double> channels;
  /// ∫ of luminance; as in LuminanceStatistics.
  double luminance = 0;
};

/// A light of a map: a texel of at least kLightContrast times the map's mean luminance that is the brightest
/// within kLightReach, and the texels with at least half its luminance that lie within kLightReach of it.
struct Light {
  Vec3d direction{0, 0, 1};  ///< its centroid, in the world, weighted by luminance·solid angle
  double peak = 0;           ///< luminance of its brightest texel
  double solid_angle = 0;    ///< of its texels, sr
  double radius = 0;         ///< radians from its direction to the far side of the farthest of them
};
/// How many times the mean luminance of a map a light's brightest texel has.
inline constexpr double kLightContrast = 2;

/// A light's energy: ∫ w L dω over a cone about its direction. The weight w is 1 up to Light::radius and two
/// texels more, and falls smoothly to 0 over another two: a light that other texels share differently is in
/// it as a whole all the same, and no light beside it comes or goes with a texel on its edge. What lies
/// behind and around the light counts too, in both maps of a comparison alike; the texels are those of the
/// coarser.
struct LightEnergy {
  Light light;       ///< which
  Energy energy;     ///< of the cone
  double share = 0;  ///< of the luminance of the whole
};

/// What measure_energy found.
struct MapEnergy {
  std::vector<std::string> channels;  ///< names of those that are measured
  Energy whole;                       ///< of all that the map shows
  std::vector<LightEnergy> lights;    ///< the brightest first; none where nothing stands out
  std::uint64_t skipped = 0;          ///< texels with values that aren't finite
};

/// How energy is measured.
struct EnergyOptions {
  int lights = 3;  ///< how many at most, of the brightest
  /// Between the maps that are compared: what was seen along d is seen along rotation·d afterwards
  /// (ResampleOptions::rotation).
  Matrix3 rotation = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// The energy of a map and of its brightest lights. Reads the charts, not their borders. Throws Cancelled.
WELKIN_API MapEnergy measure_energy(const Map& map, const EnergyOptions& options = {});

/// Energy of the same part of the sphere in two maps, and their ratios: 1 + (after − before) / ∫ |before|,
/// which is after / before where nothing is negative; 1 where both are 0, and infinite where only `before`
/// is.
struct EnergyChange {
  Energy before;               ///< in the first map
  Energy after;                ///< in the second
  std::vector<double> ratios;  ///< of each channel
  double ratio = 1;            ///< of luminance
};

/// The same of a light.
struct LightChange {
  Light light;          ///< of the first map, and in its world
  EnergyChange change;  ///< in one cone of the world
};

/// What compare_energy found.
struct EnergyComparison {
  /// Channels that both maps have, but A, by name; where no name agrees and both have as many, by position.
  std::vector<std::string> channels;
  EnergyChange whole;               ///< of what both maps show
  std::vector<LightChange> lights;  ///< of the first map, the brightest first
  double solid_angle = 0;           ///< that both show, sr
  std::uint64_t skipped = 0;        ///< texels with values that aren't finite, of both

  /// The largest |ratio − 1| of the whole: of its channels and of luminance.
  WELKIN_API double change_of_whole() const;
  /// The largest |ratio − 1| of a light's luminance; 0 without lights.
  WELKIN_API double change_of_lights() const;
};

/// Compares what two maps hold of the light that both show: as a whole, and in a cone of the world about each
/// of the brightest lights of the first. Each is measured by its own texels, nothing is interpolated: of maps
/// that show the whole sphere the ratios are exact to 1e-5, to 1e-3 of charts below 32 texels; where one
/// shows a part, the texels on its rim count by an 8×8 grid. Throws Error (mismatch) for maps without common
/// channels; Cancelled.
WELKIN_API EnergyComparison compare_energy(const Map& before, const Map& after,
                                           const EnergyOptions& options = {});

/// compare_energy of a map that is made row by row and never in memory as a whole.
class WELKIN_API EnergyMeter {
 public:
  /// Measures the first map, which may go afterwards. `channels` are the names of the second's. Throws as
  /// compare_energy.
  EnergyMeter(const Map& before, const MapFrame& after, const std::vector<std::string>& channels,
              const EnergyOptions& options = {});
  ~EnergyMeter();
  EnergyMeter(EnergyMeter&&) noexcept;             ///< leaves nothing behind
  EnergyMeter& operator=(EnergyMeter&&) noexcept;  ///< leaves nothing behind

  /// Whole rows of a chart of the second map, from row y on. From several threads at once, in any order; a
  /// row that comes again is passed over. Throws Error (bad_request) for rows that the map doesn't have.
  void add(int chart, int y, ImageView<const float> rows);

  /// When all rows have come; Error (bad_request) before.
  EnergyComparison comparison() const;

 private:
  friend EnergyComparison compare_energy(const Map& before, const Map& after, const EnergyOptions& options);
  class Model;
  std::unique_ptr<Model> model_;
};

}  // namespace welkin
