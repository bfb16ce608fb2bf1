// What is lost between a lat-long and a cube and back.

#include <algorithm>
#include <cmath>

#include "harness.h"
#include "pictures.h"
#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

struct Loss {
  double psnr = 0;        ///< dB, peak 1
  double psnr_edges = 0;  ///< the same, within two face texels of a cube's edge
  double relative = 0;    ///< root of Σ(difference²) / Σ(original²)
};

/// The picture as a display would show it: values in 0…1.
Map clipped(const Map& map) {
  Map copy(map.parameterization, map.width(), map.height(), 3);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        copy.level.chart(0).at(x, y)[c] = std::clamp(map.level.chart(0).at(x, y)[c], 0.0f, 1.0f);
    }
  }
  fill_borders(copy);
  return copy;
}

Map round_trip(const Map& original, int face, Filter filter) {
  ResampleOptions options;
  options.filter = filter;
  Map cube(sphere::AnyParameterization::make("cube"), face, face, 3);
  resample(original, cube, options);
  fill_borders(cube);
  Map back(original.parameterization, original.width(), original.height(), 3);
  resample(cube, back, options);
  return back;
}

Loss loss_of(const Map& original, const Map& back, int face) {
  const auto cube = sphere::AnyParameterization::make("cube");
  const auto& p = original.parameterization;
  double square = 0, square_edges = 0, power = 0, weight_all = 0, weight_edges = 0;
  std::vector<float> solid_angles(static_cast<std::size_t>(original.width()));
  for (int y = 0; y < original.height(); ++y) {
    texel_solid_angles(p, original.width(), original.height(), 0, y, solid_angles.data());
    for (int x = 0; x < original.width(); ++x) {
      const double weight = static_cast<double>(solid_angles[static_cast<std::size_t>(x)]);
      const auto position =
          cube.from_sphere(p.to_sphere(0, (x + 0.5) / original.width(), (y + 0.5) / original.height()));
      const double inside = std::min({position.u, 1 - position.u, position.v, 1 - position.v}) * face;
      const float *a = original.level.chart(0).at(x, y), *b = back.level.chart(0).at(x, y);
      for (int c = 0; c < 3; ++c) {
        const double was = static_cast<double>(a[c]),
                     part = weight * std::pow(static_cast<double>(b[c]) - was, 2);
        square += part;
        if (inside < 2) square_edges += part;
        power += weight * was * was;
      }
      weight_all += 3 * weight;
      if (inside < 2) weight_edges += 3 * weight;
    }
  }
  return {-10 * std::log10(square / weight_all), -10 * std::log10(square_edges / weight_edges),
          std::sqrt(square / power)};
}

/// The targets were set for one map and `auto`.
std::string verdict(const Loss& loss, int face) {
  return face == 256 ? met(loss.psnr > 28.0 && loss.psnr_edges > 35.6 && loss.relative < 0.057)
                     : met(loss.psnr >= 40);
}

}  // namespace

int main() {
  const Threads threads;
  const HighDynamicRange picture = high_dynamic_range();
  const Map shown = clipped(picture.map);
  heading("Round trip: lat-long, cube, lat-long");
  paragraph(
      "Of " + picture.name + " (" + std::to_string(picture.map.width()) + "×" +
      std::to_string(picture.map.height()) +
      "). PSNR (peak 1, weighted by solid angle) is of the picture clipped to 0…1 before the trip; "
      "*near edges* is within two face "
      "texels of a face's edge. The relative RMSE is of the radiance, not clipped. Near its poles a lat-long "
      "has more columns than a face of 512 has texels; what they hold is lost." +
      (picture.is_forest ? ""
                         : " The targets are for another picture, forest.exr of Debian's blender-data."));
  const Table table({"face", "filter", "PSNR, dB", "near edges, dB", "relative RMSE", "target", "met"});
  for (const int face : {256, 512}) {
    for (const Filter filter : {Filter::bilinear, Filter::bicubic, Filter::lanczos, Filter::automatic}) {
      Loss loss = loss_of(shown, round_trip(shown, face, filter), face);
      loss.relative = loss_of(picture.map, round_trip(picture.map, face, filter), face).relative;
      const bool judged = picture.is_forest && filter == Filter::automatic;
      const char* target = face == 256 ? "> 28.0 dB, > 35.6 dB, < 0.057" : "≥ 40 dB";
      table.row({std::to_string(face), std::string(name_of(filter)), fixed(loss.psnr, 2),
                 fixed(loss.psnr_edges, 2), fixed(loss.relative, 4), judged ? target : "",
                 judged ? verdict(loss, face) : ""});
    }
  }
}
