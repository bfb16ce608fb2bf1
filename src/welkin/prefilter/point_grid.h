#pragma once

#include <optional>
#include <span>
#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/map/map.h"
#include "welkin/prefilter/buffer.h"

/// What a map's texels stand for, as weighted points on a lat-long grid.
///
/// A texel is its radiance L, constant over the solid angle that it covers. Every convolution of the map is
/// thus a sum of L ∫_texel w dω. For a lobe that is smooth at the scale of a grid, each of these integrals is
/// a weighted sum of the lobe's values at grid points around the texel: the integral of a polynomial through
/// them. So the map can be replaced by weights at the grid's points, once for all lobes: texels are *spread*
/// onto the grid, as a type-1 non-uniform transform does ("anterpolation": the transpose of interpolating).
/// The weights that a texel adds sum to L times its solid angle exactly: energy is kept. The derivation:
/// docs/prefiltering-derivation.md.
namespace welkin::prefilter {

/// Weighted points, sr · radiance: rows at colatitudes (j + ½)π/height, columns at u = (i + ½)/width, in the
/// source's own frame. Stored for transforms along rows: `lanes`[pack][channel][column][16]: eight northern
/// rows 8·pack + 0…7, then their mirror images about the equator. Lanes past the equator are 0.
struct PointGrid {
  PointGrid(int width, int height, int channels);

  int width, height, channels;
  int packs;
  Buffer lanes;
  /// Points are boxes as wide as a column: their orders need the factor sin x / x, x = πm/width.
  bool boxes = false;

  float* at(int pack, int channel) {
    return lanes.data() + (static_cast<std::ptrdiff_t>(pack) * channels + channel) * width * 16;
  }
  const float* at(int pack, int channel) const {
    return lanes.data() + (static_cast<std::ptrdiff_t>(pack) * channels + channel) * width * 16;
  }
};

/// How the rows of a lat-long picture spread onto rows of points, as many as one likes: through the six grid
/// rows about each position, the lobe taken to be a polynomial of degree five between them.
struct RowSpread {
  /// Weight of radiance 1 in a row of the picture; past a pole, of the opposite meridian's.
  struct Tap {
    int row;
    bool opposite;
    float weight;
  };
  RowSpread(int columns, int picture_rows, int rows);

  std::vector<int> first;  ///< of each row of points in `taps`, and where the last one ends
  std::vector<Tap> taps;
  int rows() const { return static_cast<int>(first.size()) - 1; }
};

/// What a row of a picture holds.
struct RowValues {
  static constexpr int kMostChannels = 4;
  double squares[kMostChannels] = {};  ///< Σ value², not finite where a value isn't
  float largest = 0, smallest = 0;     ///< of all channels, and 0
};

/// How texels spread along a row onto columns of points, a whole number of texels to a column.
struct ColumnSpread {
  /// `columns` texels to a column: through the four columns about each position. 1: a texel as wide as the
  /// column goes to three, 1/24, 22/24 and 1/24.
  explicit ColumnSpread(int columns);
  /// Texels are kept: boxes as wide as a column.
  static ColumnSpread boxes();
  int columns;
  int reach;                 ///< texels before a column's own first one
  std::vector<float> along;  ///< weights of the texels from there on
};

/// How a map becomes weighted points: rows and columns of the grid, and the way there.
struct PointGridPlan {
  enum class Way {
    spread_points,  ///< lat-long: down the rows, then along them
    spread_boxes,   ///< lat-long with columns too wide for points: PointGrid::boxes
    spread_texels,  ///< any map, texel by texel (spreading.h)
  };
  /// What else a grid's rows are for.
  enum class Rows {
    locate_suns,  ///< bright points are the grid's own
    few,          ///< no more than the degree needs
  };
  /// For harmonics up to this degree.
  PointGridPlan(const sphere::AnyParameterization& source, ChartSize size, int degree,
                Rows use = Rows::locate_suns);
  /// With this many rows, for NearField; columns as wide as the picture's while there aren't three to a row.
  static PointGridPlan with_rows(const sphere::AnyParameterization& source, ChartSize size, int rows);

  Way way = Way::spread_texels;
  int width = 0, height = 0;
  std::optional<RowSpread> rows;        ///< of lat-longs, as is `columns`
  std::optional<ColumnSpread> columns;  ///< likewise

 private:
  PointGridPlan() = default;
};

/// The weighted points of a map of the plan's shape. Throws Cancelled.
PointGrid make_point_grid(const Map& map, const PointGridPlan& plan, const Monitor& monitor);
/// The same of a lat-long, and what its rows hold: as many `values` as it has rows.
PointGrid make_point_grid(const Map& map, const PointGridPlan& plan, std::span<RowValues> values,
                          const Monitor& monitor);

}  // namespace welkin::prefilter
