#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/math/vec_precision.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

constexpr int kSide = 8;             // cells along a block
constexpr int kSamples = kSide + 1;  // corners of cells along it
constexpr std::int32_t kNone = -1;
constexpr const char* kOutside = "an implicit surface lies inside its box";

using Cell = std::array<int, 3>;
using Distance = std::function<double(const Vec3d& p)>;

/// An edge of the lattice that the surface crosses: from the corner of a cell along an axis.
struct Crossing {
  Cell corner;
  int axis;
  bool outwards;  // the function grows along it
};

/// What a block of cells holds.
struct Block {
  std::vector<Vec3d> points, normals;  // one for each cell that the surface crosses
  std::vector<Crossing> crossings;
  std::array<std::int32_t, kSide * kSide * kSide> of_cell;  // index into points
  std::uint32_t first = 0;                                  // of the block's vertices in the mesh
};

/// The lattice: blocks of cubes that cover the box.
struct Lattice {
  Vec3d origin;
  double size = 0;  // of a cell
  Cell blocks = {};

  Vec3d corner(const Cell& at) const { return origin + Vec3d{size * at[0], size * at[1], size * at[2]}; }
  int block_index(const Cell& block) const {
    return (block[2] * blocks[1] + block[1]) * blocks[0] + block[0];
  }
};

double component(const Vec3d& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3d gradient_at(const Distance& f, const Vec3d& p, double step) {
  const Vec3d x{step, 0, 0}, y{0, step, 0}, z{0, 0, step};
  return {f(p + x) - f(p - x), f(p + y) - f(p - y), f(p + z) - f(p - z)};
}

/// Moves a point near the surface onto it, by Newton's steps along the gradient, by half a cell at most.
void settle(const Distance& f, double cell, Vec3d& point, Vec3d& normal) {
  const double step = 1e-3 * cell;
  Vec3d at = point;
  for (int i = 0; i < 4; ++i) {
    const double value = f(at);
    if (std::abs(value) < 1e-7 * cell) break;
    const Vec3d slope = (0.5 / step) * gradient_at(f, at, step);
    const double steep = dot(slope, slope);
    if (!(steep > 1e-12)) break;
    at = at - (value / steep) * slope;
    if (length(at - point) > 0.5 * cell) break;
  }
  if (length(at - point) <= 0.5 * cell) point = at;
  const Vec3d slope = gradient_at(f, point, step);
  normal = length(slope) > 0 ? normalize(slope) : Vec3d{0, 1, 0};
}

/// Nothing where the surface doesn't reach the block.
std::unique_ptr<Block> make_block(const Distance& f, const Lattice& lattice, const Cell& block) {
  const Cell first{block[0] * kSide, block[1] * kSide, block[2] * kSide};
  const double half = 0.5 * kSide * lattice.size;
  const double middle = f(lattice.corner(first) + Vec3d{half, half, half});
  require(std::isfinite(middle), "an implicit surface's function is finite");
  if (std::abs(middle) > 1.001 * std::sqrt(3.0) * half) return nullptr;

  std::array<double, kSamples * kSamples * kSamples> value;
  const auto sample = [](int x, int y, int z) {
    return static_cast<std::size_t>((z * kSamples + y) * kSamples + x);
  };
  for (int z = 0; z < kSamples; ++z)
    for (int y = 0; y < kSamples; ++y)
      for (int x = 0; x < kSamples; ++x)
        value[sample(x, y, z)] = f(lattice.corner({first[0] + x, first[1] + y, first[2] + z}));

  auto made = std::make_unique<Block>();
  made->of_cell.fill(kNone);
  for (int cell = 0; cell < kSide * kSide * kSide; ++cell) {
    const Cell at{cell % kSide, cell / kSide % kSide, cell / (kSide * kSide)};
    Vec3d sum{0, 0, 0};
    int count = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The four edges along this axis.
      for (int edge = 0; edge < 4; ++edge) {
        Cell low = at;
        low[(axis + 1) % 3] += edge & 1;
        low[(axis + 2) % 3] += edge >> 1;
        Cell high = low;
        ++high[axis];
        const double a = value[sample(low[0], low[1], low[2])], b = value[sample(high[0], high[1], high[2])];
        if ((a < 0) == (b < 0)) continue;
        for (const std::size_t side : {(axis + 1) % 3, (axis + 2) % 3})
          require(first[side] + low[side] < lattice.blocks[side] * kSide, kOutside);
        Vec3d place{static_cast<double>(low[0]), static_cast<double>(low[1]), static_cast<double>(low[2])};
        (axis == 0 ? place.x : axis == 1 ? place.y : place.z) += a / (a - b);
        sum = sum + place;
        ++count;
        if (edge == 0)
          made->crossings.push_back(
              {{first[0] + at[0], first[1] + at[1], first[2] + at[2]}, static_cast<int>(axis), b > a});
      }
    }
    if (count == 0) continue;
    Vec3d point = lattice.corner(first) + (lattice.size / count) * sum, normal;
    settle(f, lattice.size, point, normal);
    made->of_cell[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(made->points.size());
    made->points.push_back(point);
    made->normals.push_back(normal);
  }
  if (made->points.empty()) return nullptr;
  return made;
}

Lattice lattice_over(const Bounds& box, int cells) {
  const Vec3d sides = box.most - box.least;
  const double longest = std::max({sides.x, sides.y, sides.z});
  require(std::min({sides.x, sides.y, sides.z}) > 0 && std::isfinite(longest), "a box has three sides");
  Lattice lattice{box.least, longest / cells, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    lattice.blocks[axis] =
        static_cast<int>(std::ceil(component(sides, axis) / (lattice.size * kSide) - 1e-9));
  return lattice;
}

/// The vertex of the cell that lies at `corner`, less one step along each of the axes named.
std::uint32_t vertex_of(const Lattice& lattice, const std::vector<std::unique_ptr<Block>>& blocks,
                        Cell cell) {
  Cell block{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require(cell[axis] >= 0, kOutside);
    block[axis] = cell[axis] / kSide;
    cell[axis] %= kSide;
  }
  const Block* holder = blocks[static_cast<std::size_t>(lattice.block_index(block))].get();
  const std::int32_t index =
      holder ? holder->of_cell[static_cast<std::size_t>((cell[2] * kSide + cell[1]) * kSide + cell[0])]
             : kNone;
  require(index != kNone, "an implicit surface's function changes by no more than position does");
  return holder->first + static_cast<std::uint32_t>(index);
}

void add_quadrilateral(Mesh& mesh, const std::array<std::uint32_t, 4>& q) {
  const auto& p = mesh.positions;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (length(cross(p[b] - p[a], p[c] - p[a])) > 0) mesh.triangles.push_back({a, b, c});
  };
  if (length(p[q[0]] - p[q[2]]) <= length(p[q[1]] - p[q[3]])) {
    add(q[0], q[1], q[2]);
    add(q[0], q[2], q[3]);
  } else {
    add(q[1], q[2], q[3]);
    add(q[1], q[3], q[0]);
  }
}

}  // namespace

Mesh implicit_mesh(const Distance& distance, const Bounds& box, int cells) {
  require(cells >= 4 && cells <= 2048, "an implicit surface has 4 to 2048 cells along its box");
  const Lattice lattice = lattice_over(box, cells);
  const auto [columns, rows, slices] = lattice.blocks;
  std::vector<std::unique_ptr<Block>> blocks(static_cast<std::size_t>(columns * rows * slices));
  parallel_for(slices * rows, [&, columns = columns, rows = rows](int row) {
    for (int column = 0; column < columns; ++column) {
      const Cell block{column, row % rows, row / rows};
      blocks[static_cast<std::size_t>(lattice.block_index(block))] = make_block(distance, lattice, block);
    }
  });

  Mesh mesh;
  mesh.name = "implicit surface";
  for (const auto& block : blocks) {
    if (!block) continue;
    block->first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3d& point : block->points) mesh.positions.push_back(to_float(point));
    for (const Vec3d& normal : block->normals) mesh.normals.push_back(to_float(normal));
  }
  for (const auto& block : blocks) {
    if (!block) continue;
    for (const Crossing& crossing : block->crossings) {
      // The four cells around the edge, counterclockwise about it.
      const auto b = static_cast<std::size_t>((crossing.axis + 1) % 3),
                 c = static_cast<std::size_t>((crossing.axis + 2) % 3);
      std::array<std::uint32_t, 4> around{};
      constexpr int kSteps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (std::size_t i = 0; i < 4; ++i) {
        Cell cell = crossing.corner;
        cell[b] -= kSteps[i][0];
        cell[c] -= kSteps[i][1];
        around[i] = vertex_of(lattice, blocks, cell);
      }
      if (!crossing.outwards) std::swap(around[1], around[3]);
      add_quadrilateral(mesh, around);
    }
  }
  return mesh;
}

}  // namespace welkin::scene
