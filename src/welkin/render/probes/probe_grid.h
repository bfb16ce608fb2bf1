#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/math/rotation.h"
#include "welkin/render/project/project.h"
#include "welkin/scene/scene.h"

/// @file
/// Grids of probes: the light at many places of a scene, each an octahedral map, all in one atlas.
namespace welkin::scene {

/// Where probes stand: a box cut into cells, one in the middle of each.
struct WELKIN_API ProbeBox {
  Bounds box;                            ///< in the world; of some size along axes with several probes
  std::array<int, 3> counts{{1, 1, 1}};  ///< along x, y, z; each 1 or more

  /// How many there are.
  int count() const { return counts[0] * counts[1] * counts[2]; }
  /// From a probe to its neighbours.
  Vec3d spacing() const;
  /// Of the probe at (x, y, z).
  Vec3d position(int x, int y, int z) const;
  /// The number of the probe at (x, y, z): x + counts[0]·(z + counts[2]·y), as in the tiles of an atlas.
  int index(int x, int y, int z) const { return x + counts[0] * (z + counts[2] * y); }
};

/// Probes all over a scene. Throws Error (bad_request) of a scene without triangles.
WELKIN_API ProbeBox probes_in(const Scene& scene, const std::array<int, 3>& counts);

/// What is made of each probe.
struct ProbeGridOptions {
  int size = 32;           ///< of what is projected, texels along a side without the border, 4 … 1024
  bool radiance = true;    ///< keep what is projected
  int diffuse_size = 8;    ///< of the diffuse light, along a side; 0: none
  int depth_size = 16;     ///< of the distances' moments; 0: none
  int border = 1;          ///< texels around each tile, 1 … kBorder, so that it is read without a seam
  int samples = 4;         ///< samples² rays for each texel of the projection, 1 … 64
  bool shade_once = true;  ///< as ProjectOptions::shade_once
  /// Roughness of the levels of GGX, each over the one before, in tiles of `size`; none where this is empty.
  std::vector<double> roughness = {};
  /// Distances are filtered with the cosine to this power.
  double depth_exponent = 50;
  /// Distances count as this at most. None: one and a half diagonals of a cell, as RTXGI's.
  std::optional<double> farthest = {};
  /// Of the octahedra, as Map::orientation: identity, whose centre is +Y, or rtxgi_orientation.
  Matrix3 orientation = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// The tiles of all probes. That of the probe at (x, y, z) is in column x and row z + counts[2]·y: one plane
/// of probes below the other, so that each plane is a slice of a texture array as it lies in memory.
struct WELKIN_API ProbeAtlas {
  std::string name;                   ///< `radiance`, `diffuse`, `specular-0.25`, `depth`
  std::string lobe;                   ///< that it is filtered with, as lobe::AnyLobe::make takes it; `mirror`
  std::vector<std::string> channels;  ///< R G B, or Z Z2: the mean distance, and that of its square
  int size = 0;                       ///< of a tile, texels along a side, without the border
  int border = 0;                     ///< texels around it
  Image image;                        ///< all of them

  /// From a tile to the next, texels.
  int pitch() const { return size + 2 * border; }
};

/// The light at the places of a grid.
struct WELKIN_API ProbeGrid {
  ProbeBox probes;                  ///< where they are
  Matrix3 orientation;              ///< of the octahedra
  double farthest = 0;              ///< that distances count as at most
  std::vector<ProbeAtlas> atlases;  ///< radiance, diffuse, specular, depth: those that were asked for
  /// Of each probe, by ProbeBox::index: the share of what it sees all around that is the back of a triangle
  /// whose material isn't two-sided.
  std::vector<float> behind;

  /// Whether a probe is taken to be inside a body: over a quarter of it sees backs.
  bool inside(int index) const;
  /// How many are.
  int inside_count() const;
  /// The atlas of that name; none where there is none.
  const ProbeAtlas* atlas(std::string_view name) const;
};

/// Share of a probe's sphere from which on it is taken to be inside a body.
inline constexpr double kInsideShare = 0.25;

/// What a grid of these options needs, bytes: all atlases.
WELKIN_API double probe_grid_bytes(const ProbeBox& probes, const ProbeGridOptions& options);

/// Projects the scene at every probe, and filters that, with one plan for all. Diffuse light and GGX are
/// means (LobeScale::average): a constant world stays what it is, and irradiance is π times `diffuse`. The
/// same bits for any number of threads. Besides the atlases, memory is needed for a probe of each thread.
/// Throws Error (bad_request): options out of range, a box whose sides are not finite or have no size;
/// (too_large) for over 2²⁴ probes, atlases over 8 GiB altogether, or sides over 2²⁰ texels; Cancelled.
WELKIN_API ProbeGrid project_grid(const ShadedScene& seen, const ProbeBox& probes,
                                  const ProbeGridOptions& options = {});

/// The grid in words for programs that load it: JSON of the box, counts, spacing, atlases and their tiles,
/// and the probes that are inside bodies. `files` names the file of each atlas.
WELKIN_API std::string probe_grid_json(const ProbeGrid& grid, const std::vector<std::string>& files);

}  // namespace welkin::scene
