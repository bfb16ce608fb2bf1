#pragma once

#include "welkin/sphere/cube.h"
#include "welkin/sphere/latlong.h"

namespace welkin::sphere {

/// A parameterization whose outermost texel centres, not their outer edges, lie on the edges of its charts,
/// as the OpenEXR `envmap` attribute declares (ImfEnvmap.h): the first and last column of such a lat-long
/// show the same meridian, its first and last row the poles. How far the edges are in depends on the size, so
/// that is a parameter. The outer halves of the outermost texels are not valid. Without `kColumns` only rows
/// lie so.
template <class P, bool kColumns = true>
struct EdgeCentred {
  static constexpr int kCharts = P::kCharts;
  P inner;
  double width = 1024;
  double height = 512;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    if constexpr (kColumns) visit("width", width, 2.0, 1048576.0, "texels across a chart");
    visit("height", height, 2.0, 1048576.0, "texels down a chart");
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    if constexpr (kColumns) visit("width", width, 2.0, 1048576.0, "texels across a chart");
    visit("height", height, 2.0, 1048576.0, "texels down a chart");
  }
  void update() {}

  double aspect() const { return inner.aspect(); }
  double coverage() const { return inner.coverage(); }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return inner.to_sphere(chart, inward_across(u), inward(v, height));
  }
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const ChartPoint<T> position = inner.from_sphere(d);
    return {position.chart, kColumns ? outward(position.u, width) : position.u, outward(position.v, height)};
  }
  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    return constant<T>((kColumns ? width / (width - 1) : 1) * (height / (height - 1))) *
           inner.solid_angle_density(chart, inward_across(u), inward(v, height));
  }
  template <class T>
  Mask<T> valid(int chart, T u, T v) const {
    const T low = constant<T>(-1e-6), high = constant<T>(1 + 1e-6);
    const T x = inward_across(u), y = inward(v, height);
    return inner.valid(chart, x, y) & (x > low) & (x < high) & (y > low) & (y < high);
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return inner.covers(d);
  }

 private:
  template <class T>
  T inward_across(const T& u) const {
    if constexpr (kColumns) {
      return inward(u, width);
    } else {
      return u;
    }
  }
  template <class T>
  static T inward(const T& u, double size) {
    return constant<T>(size / (size - 1)) * u - constant<T>(0.5 / (size - 1));
  }
  template <class T>
  static T outward(const T& u, double size) {
    return constant<T>((size - 1) / size) * u + constant<T>(0.5 / size);
  }
};

/// The lat-long of EXR files with `envmap = latlong`.
struct OpenExrLatLong : EdgeCentred<LatLong> {
  static constexpr const char* kName = "openexr-latlong";
  static constexpr Traits kTraits{
      .projection = Projection::panorama, .follows_size = true, .envmap = "latlong"};
};

/// The cube of EXR files with `envmap = cube`; its layout is `openexr`.
struct OpenExrCube : EdgeCentred<Cube> {
  static constexpr const char* kName = "openexr-cube";
  static constexpr Traits kTraits{.projection = Projection::lookup,
                                  .follows_size = true,
                                  .cube_faces = true,
                                  .layout = "openexr",
                                  .envmap = "cube"};
  OpenExrCube() { width = height = 512; }
};

}  // namespace welkin::sphere
