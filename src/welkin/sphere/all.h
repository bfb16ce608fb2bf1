#pragma once

#include "welkin/sphere/angular_map.h"
#include "welkin/sphere/cube.h"
#include "welkin/sphere/cylinder.h"
#include "welkin/sphere/eac.h"
#include "welkin/sphere/equal_area.h"
#include "welkin/sphere/fisheye.h"
#include "welkin/sphere/frame.h"
#include "welkin/sphere/half_cube.h"
#include "welkin/sphere/healpix.h"
#include "welkin/sphere/hemi_octahedral.h"
#include "welkin/sphere/latlong.h"
#include "welkin/sphere/latlong_window.h"
#include "welkin/sphere/mercator.h"
#include "welkin/sphere/mirror_ball.h"
#include "welkin/sphere/mitsuba.h"
#include "welkin/sphere/octahedral.h"
#include "welkin/sphere/octahedral_equal_area.h"
#include "welkin/sphere/octahedral_perspective.h"
#include "welkin/sphere/octahedral_rect.h"
#include "welkin/sphere/openexr.h"
#include "welkin/sphere/paraboloid.h"
#include "welkin/sphere/sky_latlong.h"
#include "welkin/sphere/sphere_map.h"

namespace welkin::sphere {

template <class... P>
struct TypeList {};

/// Every parameterization that Welkin knows. To add one, write its header and name it here. A second one of a
/// name is the first's WithParameters.
using AllParameterizations =
    TypeList<LatLong, EqualArea, SphereMap, MirrorBall, AngularMap, Cube, EquiAngularCube, DualParaboloid,
             Octahedral, OctahedralRect, OctahedralPerspective, OctahedralEqualArea, FisheyeEquidistant,
             FisheyeEquisolid, FisheyeOrthographic, FisheyeStereographic, HalfCube, HemiOctahedral,
             SkyLatLong, Vr180, Cylinder, Mercator, Healpix, OpenExrLatLong, OpenExrCube, MitsubaLatLong,
             Perspective, Pannini, Cylindrical, Stereographic, Equidistant, Equisolid, Orthographic,
             LatLongWindow>;

/// Calls visit(name, value, minimum, maximum, description) for each parameter of `p`, if it has any. `value`
/// is a double&, const when `p` is; a value that the visitor changes takes effect.
template <class P, class Visitor>
void visit_parameters(P& p, Visitor&& visit) {
  if constexpr (requires { p.visit_parameters(visit); }) p.visit_parameters(visit);
}

template <class... P>
constexpr bool all_are_parameterizations(TypeList<P...>) {
  return (Parameterization<P> && ...);
}
static_assert(all_are_parameterizations(AllParameterizations{}));

}  // namespace welkin::sphere
