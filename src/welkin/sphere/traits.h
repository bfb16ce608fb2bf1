#pragma once

#include <string_view>

/// @file
/// What code that knows no parameterization by name needs to know of it.
namespace welkin::sphere {

/// How a map of the parameterization lies in a world: which of a convention's orientations it takes
/// (convention.h).
enum class Projection {
  unturned,  ///< no program has a convention for it: photographs of balls, half worlds
  panorama,  ///< u is longitude: up stays up, and the picture is turned about +Y
  lookup,    ///< looked up by coordinates, as cubes and octahedra are
  disc,      ///< a disc seen from inside, +Z at its centre
};

/// What code that does not know a parameterization by name needs to know of it. Defaults are for one that
/// nothing special is known of.
struct Traits {
  Projection projection = Projection::unturned;  ///< which orientation a convention gives it
  bool density_by_row = false;   ///< the density depends on v alone: all texels of a row have one solid angle
  bool filled_to_edges = false;  ///< pictures go on outside the valid domain, as a paraboloid's corners do
  bool free_aspect = false;      ///< texels are never square, so charts may have any aspect
  bool latlong_grid = false;     ///< rows at even steps of colatitude, columns of longitude, all of it
  bool follows_size = false;     ///< its parameters `width` and `height` are the size of the chart in texels
  bool follows_aspect =
      false;                ///< its parameter `aspect`, where it is 0, becomes that of the chart in texels
  bool cube_faces = false;  ///< six charts, the faces +X −X +Y −Y +Z −Z of a cube: crosses and strips exist
  bool cube_texture = false;     ///< its charts are the faces of a cube map as GPUs sample it
  int grid_columns = 0;          ///< charts across the grid of a picture; 0: all in one row
  std::string_view layout = {};  ///< the default layout; empty: the first that there is
  std::string_view envmap = {};  ///< the value of OpenEXR's attribute `envmap` that declares it
};

}  // namespace welkin::sphere
