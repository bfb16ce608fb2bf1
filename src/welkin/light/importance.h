#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/filter/filter.h"
#include "welkin/map/map.h"

/// @file
/// Directions drawn where a map is bright, for Monte Carlo integration of its light
/// (docs/importance-sampling.md).
namespace welkin {

/// How a texel is drawn.
enum class ImportanceMethod {
  cdf,    ///< a row by the marginal distribution, a column by the row's: neighbouring numbers give
          ///< neighbouring directions, so that stratified numbers give stratified directions
  alias,  ///< Walker's alias table: one look-up in memory for each draw
};

/// `cdf`, `alias`. Throws Error (bad_request) for another name.
WELKIN_API ImportanceMethod importance_method_from_name(std::string_view name);
/// The name that importance_method_from_name takes.
WELKIN_API std::string_view name_of(ImportanceMethod method);

/// What is drawn.
struct ImportanceOptions {
  ImportanceMethod method = ImportanceMethod::cdf;  ///< how
  /// For multiple importance sampling with a technique that is good at everything else, as sampling the BSDF:
  /// the map's mean over the sphere is subtracted, and what is darker is never drawn (Karlík, Šik, Vévoda,
  /// Skřivan & Křivánek 2019, "MIS Compensation", §6.1). Alone it would lose the light of those parts.
  bool compensate = false;
  /// How the integrand reads the map's radiance. `nearest`: a texel's weight is its own luminance.
  /// `bilinear`: the mean of bilinear interpolation over the texel, which is above 0 wherever interpolated
  /// radiance is; a black texel beside a bright one would otherwise never be drawn though it has light.
  Filter look_up = Filter::nearest;
};

/// What a draw gives.
struct ImportanceDraw {
  Vec3d direction{0, 0, 1};  ///< in the world, of unit length
  double pdf = 0;            ///< probability per solid angle at the direction, 1/sr; as pdf(direction)
  int chart = 0;             ///< of the texel that it lies in
  int x = 0;                 ///< its column
  int y = 0;                 ///< its row
};

/// Draws directions with a density that is proportional to a map's luminance, in any parameterization.
///
/// A texel is drawn in proportion to luminance (as in LuminanceStatistics) × solid angle of its valid part;
/// within it, the density per solid angle is constant to within 25 %, for a texel is drawn evenly over (u, v)
/// where the parameterization's density changes by less than that, and by an 8×8 grid of its parts elsewhere,
/// as at poles and rims. That is the aim; **`pdf` is the density of what is drawn, exactly**, for it counts
/// the tables as they are stored and the parameterization's density at the very direction:
/// `draw(…).pdf` equals `pdf(draw(…).direction)` to 1e-6 (where rounding leaves the direction in its texel:
/// one draw in 10⁹ may not), ∫ pdf dω = 1, and the mean of f/pdf over draws is ∫ f where pdf is 0 nowhere
/// that f isn't.
///
/// **Where pdf is 0**: texels of no luminance, what the map doesn't show, and at rims slivers thinner than
/// 1e-4 of a texel. No such direction is drawn. Of a map without any light (all black, or all of one
/// radiance when compensated), every texel has the same density per solid angle: `is_uniform`.
///
/// It is a class of its own, beside Sampler, because it holds tables of its own and none of the map's pixels,
/// and outlives the map.
///
/// Never changes after it is made; draws are safe from many threads. Cheap to copy: copies share the tables,
/// 16 bytes for each texel by `alias`, 12 to 16 by `cdf`.
class WELKIN_API ImportanceSampler {
 public:
  /// Reads the charts, and for `look_up` bilinear their borders. Throws Error: (bad_value) for luminance that
  /// is NaN or infinite, with the number of such texels; (bad_request) for a look_up other than nearest and
  /// bilinear; (too_large) for 2³¹ texels or more; as Map::check; Cancelled. Negative luminance counts as 0,
  /// and is told by negative_texels.
  explicit ImportanceSampler(const Map& map, const ImportanceOptions& options = {},
                             const Monitor& monitor = {});

  /// A direction from two numbers in [0, 1), independent and uniform, or stratified; others are clamped. In
  /// double, or with at least 40 random bits: their leading bits choose the texel, the rest the place in it.
  ImportanceDraw draw(double u1, double u2) const;
  /// The same of many pairs of numbers: the same bits, sooner in large maps, for look-ups in the tables
  /// overlap. In the calling thread. Throws Error (bad_request) when the lengths differ.
  void draw(std::span<const double> u1, std::span<const double> u2, std::span<ImportanceDraw> draws) const;

  /// Probability per solid angle, 1/sr, of drawing a direction of any length > 0 in the world; 0 where the
  /// map shows nothing, and for zero and what isn't finite.
  double pdf(const Vec3d& direction) const;

  const ImportanceOptions& options() const;  ///< as given
  const MapFrame& frame() const;             ///< the map's
  /// Whether there was no light to draw by.
  bool is_uniform() const;
  /// Texels whose luminance was below 0.
  std::uint64_t negative_texels() const;
  /// Mean luminance over the solid angle that the map shows: what compensation subtracts.
  double mean_luminance() const;
  /// ∫ luminance dω, of luminance as it is drawn by: clamped and interpolated, not compensated.
  double integral() const;

  /// The probability that a draw lies in a texel. Throws Error (bad_request) for one that there isn't.
  double probability(int chart, int x, int y) const;

  /// The tables as other programs' renderers read them, row by row; row r is chart r / height, row r %
  /// height. Throws Error (bad_request) for the table of the other method, or a row that there isn't.
  /// @{
  /// Probability of row 0, of rows 0 and 1…: charts × height values, the last 1. Of `cdf`.
  std::vector<double> marginal_cdf() const;
  /// The same of the columns of a row, 0 in a row that is never drawn. Of `cdf`.
  std::vector<double> conditional_cdf(int row) const;
  /// An entry of the alias table: of the texel with its index, column + width · row, the numbers below
  /// `threshold` are the texel's own, the others belong to the texel `alias`.
  struct Alias {
    float threshold = 1;      ///< 0…1
    std::uint32_t alias = 0;  ///< index of a texel
  };
  /// Of a row's texels. Of `alias`.
  std::vector<Alias> alias_row(int row) const;
  /// Area of the part of each texel of a row that is valid, in parts of a texel: 1 but at rims, 0 outside.
  std::vector<double> valid_areas(int row) const;
  /// @}

  class State;

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace welkin
