#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// How a polygon overlaps the texels of a chart. Internal to resample.
namespace welkin {

/// Integrals over a polygon's part in one texel: of 1, x, y, x² − 1/12, x·y and y² − 1/12, with x and y
/// −½…½ from the texel's centre.
struct OverlapMoments {
  double area, x, y, xx, xy, yy;
};

/// Adds up a closed polygon's overlaps edge by edge, by Green's theorem: an edge counts for what lies to its
/// right in its row. So polygons that share an edge divide texels exactly: what one has, the other hasn't.
/// Positions are in texels; the winding decides the sign.
class PolygonOverlap {
 public:
  /// Rows are stretched where a texel's solid angle is not even from its top to its bottom: `bend[row]`,
  /// −1…1, is the share by which it grows to the bottom from the row's mean. Without, rows are as they are.
  explicit PolygonOverlap(const std::vector<float>* bend = nullptr) : bend_(bend) {}

  /// A new polygon, within these texels.
  void start(int x, int y, int width, int height);
  void add_edge(double from_x, double from_y, double to_x, double to_y);

  /// Calls visit(x, y, count, moments) for every run of texels that it overlaps; moments are those of each of
  /// `count` texels, which is 1 where a texel is not covered whole.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int row = 0; row < height_; ++row) {
      const Rows& r = rows_[static_cast<std::size_t>(row)];
      double area = 0, y = 0, yy = 0;
      for (int i = r.first; i <= r.last;) {
        const std::size_t k = index(i, row);
        if (touched_[k] != 0) {
          const Cell& cell = cells_[k];
          OverlapMoments m = cell.own;
          m.area += area;
          m.y += y;
          m.xx += area / 12;
          m.yy += yy;
          m.xx -= m.area / 12;
          m.yy -= m.area / 12;
          visit(x_ + i, y_ + row, 1, m);
          area += cell.right_area;
          y += cell.right_y;
          yy += cell.right_yy;
          ++i;
          continue;
        }
        int end = i + 1;
        while (end <= r.last && touched_[index(end, row)] == 0) ++end;
        if (area != 0) visit(x_ + i, y_ + row, end - i, OverlapMoments{area, 0, y, 0, 0, yy - area / 12});
        i = end;
      }
    }
  }

 private:
  struct Cell {
    OverlapMoments own;  ///< of x² and y² as they are, until for_each
    double right_area, right_y, right_yy;
  };
  struct Rows {
    int first, last;
  };

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  double stretched(int row, double within) const;
  void add_row(int row, double from_x, double from_y, double to_x, double to_y);
  void add_cell(int column, int row, double from_x, double from_y, double to_x, double to_y);

  const std::vector<float>* bend_;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> touched_;
  std::vector<Rows> rows_;
};

}  // namespace welkin
