#pragma once

#include "welkin/sphere/edge_reflection.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// HEALPix (Górski et al. 2005): 12 base pixels of equal area, every texel measures the same solid angle. The
/// polar axis is +Y, longitude counts from +Z toward +X as LatLong's, so the frame (x, y, z) of the paper is
/// our (z, x, y). Charts are numbered as there: 0–3 around the north pole, 4–7 around the equator with 4 at
/// +Z, 8–11 around the south pole.
///
/// With X the paper's coordinate from the south corner to the east one and Y to the west one, u = Y and v = 1
/// − X: north is the top right corner, west the bottom right, south the bottom left, east the top left; seen
/// from inside. Past an edge the chart continues by reflect_past_edge.
struct Healpix : WholeWorld {
  static constexpr const char* kName = "healpix";
  static constexpr int kCharts = 12;
  static constexpr Traits kTraits{
      .projection = Projection::lookup, .density_by_row = true, .grid_columns = 4};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return reflect_past_edge(u, v, [chart](T a, T b) { return inside(chart, a, b); });
  }

  /// Górski et al. 2005, §4 and §5, with the resolution parameter 1 and the fractions kept.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T one = constant<T>(1), half = constant<T>(0.5), four = constant<T>(4), eight = constant<T>(8);
    const Height<T> h = height_of(d);
    const T turn = constant<T>(2 / kPi) * longitude_of(d);
    const auto cap = abs(h.height) > constant<T>(2.0 / 3), south = d.y < constant<T>(0);

    // The equatorial belt: count the rising and the falling diagonals.
    const T rise = constant<T>(0.75) * h.height;
    const T rising = half + turn - rise, falling = half + turn + rise;
    // Neighbouring rows: in a corner of a chart, rounding may set one number to the next whole one too soon.
    const T floor_r = floor(rising), floor_f = floor(falling);
    const T row_r = min(floor_r, floor_f + one), row_f = min(floor_f, floor_r + one);
    const auto on_equator = row_r == row_f, over = row_r < row_f;
    const T belt_chart =
        select(on_equator, wrap(row_r) + four, select(over, wrap(row_r), wrap(row_f) + eight));

    // The caps: the distance from the pole, shared between the two sides of the quarter.
    const T quarter = floor(turn), part = turn - quarter;
    const T from_pole = min(sqrt(constant<T>(3) * h.depth), one);
    const T east = part * from_pole, west = from_pole - east;
    const T cap_chart = wrap(quarter) + select(south, eight, constant<T>(0));
    const T cap_x = select(south, east, one - west), cap_y = select(south, west, one - east);

    const T x = select(cap, cap_x, falling - row_f), y = select(cap, cap_y, row_r + one - rising);
    return {select(cap, cap_chart, belt_chart), y, one - x};
  }

  template <class T>
  T solid_angle_density(int, T, T) const {
    return constant<T>(kPi / 3);
  }

 private:
  /// Modulo 4, of a whole number.
  template <class T>
  static T wrap(T row) {
    return row - constant<T>(4) * floor(constant<T>(0.25) * row);
  }

  template <class T>
  static Vec3<T> inside(int chart, T u, T v) {
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
    const T x = one - v, y = u;
    // `ring` counts from the north pole, 0, to the south pole, 4; the belt is 1 … 3; `across` is the width of
    // a quarter.
    const int band = chart / 4;
    const T ring = constant<T>(band + 2) - (x + y);
    const T across = min(min(ring, constant<T>(4) - ring), one);
    const auto cap = across < one;
    const T below_pole = across * across * constant<T>(1.0 / 3);
    const T belt = constant<T>(2.0 / 3) * (two - ring);
    const T height = select(cap, select(ring < two, one - below_pole, below_pole - one), belt);
    const T distance = select(cap, across * sqrt((two - below_pole) * constant<T>(1.0 / 3)),
                              sqrt(max(one - belt * belt, zero)));
    // The longitude from the chart's middle, then turned to the middle's own eighth of a turn.
    const T angle = constant<T>(kPi / 4) * ((x - y) / max(across, constant<T>(1e-12)));
    const T sine = distance * sin(angle), cosine = distance * cos(angle);
    const int eighth = 2 * (chart % 4) + (band == 1 ? 0 : 1);
    const T middle_sine = constant<T>(kSine[eighth]), middle_cosine = constant<T>(kSine[(eighth + 2) % 8]);
    return {sine * middle_cosine + cosine * middle_sine, height, cosine * middle_cosine - sine * middle_sine};
  }

  static constexpr double kDiagonal = 0.70710678118654752;
  static constexpr double kSine[8] = {0, kDiagonal, 1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal};
};

}  // namespace welkin::sphere
