#include "welkin/assemble/ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/assemble/assemble.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// How far below the horizon a piece may reach and still end there, degrees.
constexpr double kSlack = 0.5;
/// Opacity of a row that can be stretched.
constexpr float kOpaque = 0.98f;
/// The narrowest window of a lat-long, degrees.
constexpr double kNarrowest = 0.1;

bool reaches_below_horizon(const Piece& piece) {
  for (int azimuth = 0; azimuth < 360; azimuth += 2) {
    for (double elevation = -kSlack; elevation > -90; elevation -= 2) {
      const Vec3d d = piece.map.orientation * direction_at(azimuth, elevation);
      bool inside = piece.map.parameterization.covers(d);
      for (const Cap& cap : piece.edges) inside = inside && cap.depth(d) > 0;
      if (inside) return true;
    }
  }
  return false;
}

Piece mirrored(const Piece& piece) {
  constexpr Matrix3 kUpsideDown{{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}};
  Piece image(piece.name + ", mirrored", piece.map.clone());
  image.map.orientation = piece.map.orientation * kUpsideDown;
  image.edges = piece.edges;
  image.feather = piece.feather;
  image.gain = piece.gain;
  return image;
}

/// The means of a row of texels on the horizon, in a window of a lat-long that reaches down from there.
Piece stretched(const std::vector<Piece>& pieces) {
  const auto latlong = sphere::AnyParameterization::make("latlong");
  int columns = 0;
  for (const Piece& piece : pieces) {
    if (piece.layer != kBackdrop) columns = std::max(columns, default_chart_size(piece.map, latlong).width);
  }
  const double height = std::max(360.0 / std::max(columns, 1), kNarrowest);
  const auto row = sphere::AnyParameterization::make("latlong,bottom=0,top=" + number_text(height));
  const Assembly seen = assemble(pieces, MapFrame(row, {columns, 1}), {.alpha = true});
  constexpr int kRows = 32;
  Map below(sphere::AnyParameterization::make("latlong,top=0,bottom=-90"), columns, kRows, 4);
  for (int x = 0; x < columns; ++x) {
    const float* texel = seen.map.level.chart(0).at(x, 0);
    if (texel[3] < kOpaque)
      throw Error(
          ErrorKind::unsupported,
          "the pictures don't show all of the horizon, so there is no row of texels to stretch below it");
    for (int y = 0; y < kRows; ++y) {
      float* to = below.level.chart(0).at(x, y);
      for (int c = 0; c < 4; ++c) to[c] = texel[c] / texel[3];
    }
  }
  fill_borders(below);
  return make_panel("the horizon, stretched", std::move(below));
}

}  // namespace

void add_ground(std::vector<Piece>& pieces, Ground how) {
  const std::size_t count = pieces.size();
  std::vector<int> layers;
  for (const Piece& piece : pieces) {
    if (piece.layer != kBackdrop) layers.push_back(piece.layer);
  }
  require(!layers.empty(), "a ground is made of a sky's pieces, and there are none");
  const int lowest = *std::min_element(layers.begin(), layers.end());
  const auto layer_beside = [&](const Piece& piece) {
    return reaches_below_horizon(piece) ? lowest - 1 : piece.layer;
  };
  if (how == Ground::stretched) {
    int layer = lowest;
    for (const Piece& piece : pieces) {
      if (piece.layer != kBackdrop) layer = std::min(layer, layer_beside(piece));
    }
    pieces.push_back(stretched(pieces));
    pieces.back().layer = layer;
    return;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (pieces[k].layer == kBackdrop) continue;
    const int layer = layer_beside(pieces[k]);
    pieces.push_back(mirrored(pieces[k]));
    pieces.back().layer = layer;
  }
}

}  // namespace welkin
