// What is lost between a lat-long and a cube and back.

#include <algorithm>
#include <cmath>

#include "harness.h"
#include "pictures.h"
#include "welkin/map/borders.h"
#include "welkin/map/resample.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

struct Loss {
  double psnr = 0;        ///< dB, both clipped to 0…1
  double psnr_edges = 0;  ///< the same, within two face texels of a cube's edge
  double relative = 0;    ///< root of Σ(difference²) / Σ(original²), not clipped
};

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
  double clipped = 0, clipped_edges = 0, weight_all = 0, weight_edges = 0, square = 0, power = 0;
  std::vector<float> solid_angles(static_cast<std::size_t>(original.width()));
  for (int y = 0; y < original.height(); ++y) {
    texel_solid_angles(p, original.width(), original.height(), 0, y, solid_angles.data());
    for (int x = 0; x < original.width(); ++x) {
      const double weight = static_cast<double>(solid_angles[static_cast<std::size_t>(x)]);
      const auto place =
          cube.from_sphere(p.to_sphere(0, (x + 0.5) / original.width(), (y + 0.5) / original.height()));
      const double inside = std::min({place.u, 1 - place.u, place.v, 1 - place.v}) * face;
      const float *a = original.level.chart(0).at(x, y), *b = back.level.chart(0).at(x, y);
      double difference = 0;
      for (int c = 0; c < 3; ++c) {
        const double was = static_cast<double>(a[c]), is = static_cast<double>(b[c]);
        difference += std::pow(std::clamp(is, 0.0, 1.0) - std::clamp(was, 0.0, 1.0), 2);
        square += weight * (is - was) * (is - was);
        power += weight * was * was;
      }
      clipped += weight * difference;
      weight_all += 3 * weight;
      if (inside < 2) {
        clipped_edges += weight * difference;
        weight_edges += 3 * weight;
      }
    }
  }
  return {-10 * std::log10(clipped / weight_all), -10 * std::log10(clipped_edges / weight_edges),
          std::sqrt(square / power)};
}

/// The targets were set for one map and `auto`.
std::string verdict(const Loss& loss, int face) {
  return face == 256 ? met(loss.psnr > 28.0 && loss.psnr_edges > 35.6 && loss.relative < 0.057)
                     : met(loss.psnr >= 37.8);
}

}  // namespace

int main() {
  const Threads threads;
  const HighDynamicRange picture = high_dynamic_range();
  heading("There and back: lat-long, cube, lat-long");
  paragraph("Of " + picture.name + " (" + std::to_string(picture.map.width()) + "×" +
            std::to_string(picture.map.height()) +
            "). PSNR has peak 1, both pictures clipped to 0…1, weighted by solid angle; *near edges* is "
            "within two face texels of a "
            "face's edge. The relative RMSE is of the unclipped radiance." +
            (picture.is_forest
                 ? ""
                 : " The targets are for another picture, forest.exr of Debian's blender-data."));
  const Table table({"face", "filter", "PSNR, dB", "near edges, dB", "relative RMSE", "target", "met"});
  for (const int face : {256, 512}) {
    for (const Filter filter : {Filter::bilinear, Filter::bicubic, Filter::lanczos, Filter::automatic}) {
      const Loss loss = loss_of(picture.map, round_trip(picture.map, face, filter), face);
      const bool judged = picture.is_forest && filter == Filter::automatic;
      const char* target = face == 256 ? "> 28.0 dB, > 35.6 dB, < 0.057" : "≥ 37.8 dB";
      table.row({std::to_string(face), std::string(name_of(filter)), fixed(loss.psnr, 2),
                 fixed(loss.psnr_edges, 2), fixed(loss.relative, 4), judged ? target : "",
                 judged ? verdict(loss, face) : ""});
    }
  }
}
