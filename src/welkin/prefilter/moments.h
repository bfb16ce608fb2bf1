#pragma once

#include <optional>
#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/map/map.h"
#include "welkin/prefilter/buffer.h"

/// What a map's texels stand for, as point masses on a lat-long grid.
///
/// A texel is its radiance L, constant over the solid angle that it covers. Every convolution of the map is
/// thus a sum of L ∫_texel w dω. For a lobe that is smooth at the scale of a grid, each of these integrals is
/// a weighted sum of the lobe's values at grid points around the texel: the integral of a polynomial through
/// them. So the map can be replaced by masses at the grid's points, once for all lobes ("anterpolation": the
/// transpose of interpolating). The masses of a texel add up to L times its solid angle exactly: energy is
/// kept.
namespace welkin::prefilter {

/// A grid of masses: rows at colatitudes (j + ½)π/height, columns at u = (i + ½)/width, in the source's own
/// frame. Stored for transforms along rows: `lanes`[pack][channel][column][16]: eight northern rows 8·pack +
/// 0…7, then their mirror images about the equator. Lanes past the equator are 0.
struct Moments {
  Moments(int width, int height, int channels);

  int width, height, channels;
  int packs;
  Buffer lanes;
  /// Masses are boxes as wide as a column, not points: their orders need the factor sin x / x, x = πm/width.
  bool boxes = false;
  /// The map averaged over boxes of its texels, one to a mass; borders not filled. Where asked for.
  std::optional<Map> reduced;

  float* at(int pack, int channel) {
    return lanes.data() + (static_cast<std::ptrdiff_t>(pack) * channels + channel) * width * 16;
  }
  const float* at(int pack, int channel) const {
    return lanes.data() + (static_cast<std::ptrdiff_t>(pack) * channels + channel) * width * 16;
  }
};

/// How the rows of a lat-long picture spread onto rows of masses, as many as one likes: through the six grid
/// rows about each place, the lobe taken to be a polynomial of degree five between them.
struct RowSpread {
  /// Mass for radiance 1 in a row of the picture; past a pole, from half a turn on.
  struct Tap {
    int row;
    bool opposite;
    float weight;
  };
  RowSpread(int columns, int picture_rows, int rows);

  std::vector<int> first;  ///< of each row of masses in `taps`, and where the last one ends
  std::vector<Tap> taps;
};

/// How texels spread along a row onto columns of masses, a whole number of texels to a column.
struct ColumnSpread {
  /// `columns` texels to a column: through the four columns about each place. 1: a texel as wide as the
  /// column goes to three, 1/24, 22/24 and 1/24.
  explicit ColumnSpread(int columns);
  /// Texels stay what they are: boxes as wide as a column.
  static ColumnSpread boxes();
  int columns;
  int reach;                 ///< texels before a column's own first one
  std::vector<float> along;  ///< weights of the texels from there on
};

/// How the masses of a map are made: rows and columns of the grid, and the way there.
struct MomentPlan {
  enum class Way {
    spread_points,  ///< lat-long: down the rows, then along them
    spread_boxes,   ///< lat-long with columns too wide for points: Moments::boxes
    scatter,        ///< any map, texel by texel
  };
  /// For harmonics up to this degree.
  MomentPlan(const sphere::AnyParameterization& source, ChartSize size, int degree);
  /// With this many rows, for NearField; columns as wide as the picture's while there aren't three to a row.
  static MomentPlan with_rows(const sphere::AnyParameterization& source, ChartSize size, int rows);

  Way way = Way::scatter;
  int width = 0, height = 0;
  /// Whether masses stand for whole numbers of rows and columns, several, so that `reduced` can be had.
  bool reduces() const { return way != Way::scatter && (rows_per_mass > 1 || columns[0].columns > 1); }

  bool reduced = false;               ///< make Moments::reduced; only where it reduces()
  int rows_per_mass = 0;              ///< 0 when it isn't a whole number
  std::vector<RowSpread> rows;        ///< none or one
  std::vector<ColumnSpread> columns;  ///< none or one

 private:
  MomentPlan() = default;
};

/// The masses of a map of the plan's shape. Throws Cancelled.
Moments moments_of(const Map& map, const MomentPlan& plan, const Monitor& monitor);

}  // namespace welkin::prefilter
