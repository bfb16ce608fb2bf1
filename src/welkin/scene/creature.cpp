#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/scene_parts.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

/// A limb's piece: balls of radii that run from `first` to `last`, their middles from `from` to `to`.
struct Piece {
  Vec3d from, to;
  double first, last;

  // Over the steepest change of the plain difference, so that it is at most 1.
  double distance(const Vec3d& p) const {
    const Vec3d way = to - from;
    const double square = dot(way, way);
    const double f = square > 0 ? std::clamp(dot(p - from, way) / square, 0.0, 1.0) : 0;
    const double slope = square > 0 ? (last - first) / std::sqrt(square) : 0;
    return (length(p - (from + f * way)) - (first + f * (last - first))) / std::sqrt(1 + slope * slope);
  }
};

/// Pieces, and a ball about them all.
struct Limb {
  std::vector<Piece> pieces;
  Vec3d middle{0, 0, 0};
  double radius = 0;
};

using Body = std::vector<Limb>;

void add_limb(Body& body, std::vector<Piece> pieces) {
  Limb limb{std::move(pieces)};
  for (const Piece& piece : limb.pieces)
    limb.middle = limb.middle + (0.5 / static_cast<double>(limb.pieces.size())) * (piece.from + piece.to);
  for (const Piece& piece : limb.pieces)
    limb.radius = std::max({limb.radius, length(piece.from - limb.middle) + piece.first,
                            length(piece.to - limb.middle) + piece.last});
  body.push_back(std::move(limb));
}

/// Pieces along a curve.
void add_limb(Body& body, const std::vector<Vec3d>& points, double first, double last, int pieces) {
  const auto curve = curve_through(points);
  std::vector<Piece> limb;
  for (int i = 0; i < pieces; ++i) {
    const double a = static_cast<double>(i) / pieces, b = static_cast<double>(i + 1) / pieces;
    limb.push_back({curve(a), curve(b), first + a * (last - first), first + b * (last - first)});
  }
  add_limb(body, std::move(limb));
}

Body body_of_creature() {
  Body body;
  add_limb(body, {{0, 1.05, -1.0}, {0, 1.15, -0.2}, {0, 1.2, 0.5}, {0, 1.3, 0.95}}, 0.36, 0.4, 4);
  add_limb(body, {{{0, 1.05, -0.45}, {0, 1.08, 0.2}, 0.44, 0.46}});                 // belly
  add_limb(body, {{0, 1.35, 0.95}, {0, 1.75, 1.25}, {0, 2.1, 1.4}}, 0.26, 0.2, 3);  // neck
  add_limb(body, {{{0, 2.2, 1.42}, {0, 2.12, 1.85}, 0.29, 0.17}});                  // head
  add_limb(body,
           {{0, 1.05, -1.2},
            {0, 0.85, -1.8},
            {0.1, 1.1, -2.4},
            {0.35, 1.7, -2.6},
            {0.6, 1.95, -2.25},
            {0.6, 1.75, -2.0}},
           0.26, 0.06, 10);  // tail
  for (const double side : {-1.0, 1.0}) {
    for (const double z : {0.75, -0.1, -0.95}) {
      const double reach = 0.35 * (z + 0.1);
      add_limb(body,
               {{side * 0.25, 1.05, z},
                {side * 0.75, 1.28, z + 0.3 * reach},
                {side * 1.08, 0.85, z + 0.8 * reach},
                {side * 1.15, 0.16, z + reach}},
               0.2, 0.1, 6);
      add_limb(body, {{{side * 1.15, 0.13, z + reach}, {side * 1.2, 0.1, z + reach + 0.22}, 0.13, 0.1}});
    }
    add_limb(body, {{side * 0.14, 2.4, 1.35}, {side * 0.3, 2.75, 1.2}, {side * 0.5, 2.95, 1.3}}, 0.075, 0.045,
             4);
    const Vec3d tip{side * 0.52, 2.97, 1.32};
    add_limb(body, {{tip, tip, 0.1, 0.1}});
  }
  std::vector<Piece> comb;  // along the back
  for (int i = 0; i < 6; ++i) {
    const double z = -1.0 + 0.32 * i, y = 1.42 + 0.05 * std::sin(1.3 * i);
    comb.push_back({{0, y, z}, {0, y + 0.24, z - 0.12}, 0.11, 0.06});
  }
  add_limb(body, std::move(comb));
  return body;
}

/// The union of bodies at those distances, its creases rounded: −k·log Σ exp(−d/k). Those over reach·k beyond
/// the nearest add less than 1e-6.
constexpr double kReach = 14;
double rounded_union(const std::vector<double>& distances, double nearest, double rounding) {
  double sum = 0;
  for (const double d : distances)
    if (d - nearest < kReach * rounding) sum += std::exp((nearest - d) / rounding);
  return nearest - rounding * std::log(sum);
}

double distance_to(const Limb& limb, const Vec3d& p) {
  constexpr double kRounding = 0.014;  // little, or each piece's end would bulge
  thread_local std::vector<double> distances;
  distances.clear();
  double nearest = 1e30;
  for (const Piece& piece : limb.pieces) {
    distances.push_back(piece.distance(p));
    nearest = std::min(nearest, distances.back());
  }
  return rounded_union(distances, nearest, kRounding);
}

double distance_to(const Body& body, const Vec3d& p) {
  constexpr double kRounding = 0.05;
  thread_local std::vector<double> distances;
  distances.clear();
  double nearest = 1e30;
  for (const Limb& limb : body) {
    // No limb is nearer than its ball. Piece::distance is less than the distance by 5 % at most, and rounding
    // takes off less than 0.04.
    const double ball = length(p - limb.middle) - limb.radius;
    if (0.95 * ball - 0.04 > nearest + kReach * kRounding) continue;
    distances.push_back(distance_to(limb, p));
    nearest = std::min(nearest, distances.back());
  }
  return rounded_union(distances, nearest, kRounding);
}

Mesh creature_mesh(int triangles) {
  const Body body = body_of_creature();
  Bounds box{body[0].middle, body[0].middle};
  for (const Limb& limb : body) {
    for (const Piece& piece : limb.pieces) {
      for (const auto& [at, radius] : {std::pair{piece.from, piece.first}, std::pair{piece.to, piece.last}}) {
        const Vec3d reach{radius, radius, radius}, low = at - reach, high = at + reach;
        box.least = {std::min(box.least.x, low.x), std::min(box.least.y, low.y),
                     std::min(box.least.z, low.z)};
        box.most = {std::max(box.most.x, high.x), std::max(box.most.y, high.y), std::max(box.most.z, high.z)};
      }
    }
  }
  // Rounding adds a little, and the surface keeps a cell away from the box.
  constexpr int kFewest = 28;
  const double margin = 0.12 + (box.most.z - box.least.z) / kFewest;
  box.least = box.least - Vec3d{margin, margin, margin};
  box.most = box.most + Vec3d{margin, margin, margin};
  const auto distance = [&](const Vec3d& p) { return distance_to(body, p); };
  // Triangles grow with the square of the cells: a coarse mesh tells how many there are.
  constexpr int kTrial = 64;
  const auto trial = static_cast<double>(implicit_mesh(distance, box, kTrial).triangles.size());
  const int cells = static_cast<int>(std::lround(kTrial * std::sqrt(triangles / trial)));
  return implicit_mesh(distance, box, std::clamp(cells, kFewest, 2048));
}

}  // namespace

Scene make_creature(int triangles) {
  Scene scene;
  const int mirror = add_material(scene, metal("mirror", {0.95f, 0.95f, 0.95f}, 0));
  Material black = paint("eye", {0.01f, 0.01f, 0.01f}, 0.05f);
  const int eye = add_material(scene, std::move(black));
  const int all = triangles > 0 ? triangles : 100'000;
  add_object(scene, creature_mesh(static_cast<int>(0.96 * all)), "creature", mirror);
  const int ball = add_mesh(scene, sphere_mesh(rows_for(0.02 * all, 2, 6)), "eye", eye);
  for (const double side : {-1.0, 1.0})
    add_instance(scene, side < 0 ? "right eye" : "left eye", ball,
                 placed({side * 0.215, 2.3, 1.58}, {0.095, 0.095, 0.095}));
  scene.cameras.push_back(camera_seeing(*bounds_of(scene), {1, 0.35, 0.9}, 35, 4.0 / 3));
  return scene;
}

}  // namespace welkin::scene
