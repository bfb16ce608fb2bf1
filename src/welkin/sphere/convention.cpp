#include "welkin/sphere/convention.h"

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin {
namespace {

constexpr Vec3d kPlusX{1, 0, 0}, kMinusX{-1, 0, 0}, kPlusY{0, 1, 0}, kPlusZ{0, 0, 1}, kMinusZ{0, 0, -1};

/// Adding 0 keeps −0 out of what files record.
Matrix3 from_rows(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return {{{{a.x + 0, a.y + 0, a.z + 0}, {b.x + 0, b.y + 0, b.z + 0}, {c.x + 0, c.y + 0, c.z + 0}}}};
}

/// The native direction `centre` moves to +Z, the centre of native panoramas, and up stays.
Matrix3 centred_on(const Vec3d& centre) {
  return from_rows(cross(kPlusY, centre), kPlusY, centre);
}

/// Coordinates of a program whose axes are these native directions.
Matrix3 axes(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
  return from_rows(x, y, z);
}

std::vector<Convention> make_conventions() {
  const Matrix3 identity;
  const Matrix3 x_reversed = axes(kMinusX, kPlusY, kPlusZ);
  return {
      {"native", "right-handed, +Y up; +Z at the centre of a lat-long, +X a quarter to its left", identity,
       identity, identity, identity, "docs/conventions.md"},
      {"openexr", "OpenEXR envmap attribute; as native", identity, identity, identity, identity,
       "OpenEXR, ImfEnvmap.h, \"Latitude-Longitude Map\""},
      {"usd", "USD DomeLight; as native", identity, identity, identity, identity,
       "OpenUSD, UsdLuxDomeLight, which quotes OpenEXR"},
      {"mitsuba", "Mitsuba 3 envmap; as native, a lat-long as mitsuba-latlong", identity, identity, identity,
       identity, "Mitsuba 3, src/emitters/envmap.cpp, direction_to_uv and eval_spectrum", "mitsuba-latlong"},
      {"godot", "Godot 4 PanoramaSkyMaterial and cube maps; as native", identity, identity, identity,
       identity, "Godot, servers/rendering/renderer_rd/shaders/environment/sky.glsl, panorama_coords"},
      {"filament", "Filament and cmgen; as native", identity, identity, identity, identity,
       "Filament, Skybox.h and libs/ibl/src/CubemapUtils.cpp, equirectangularToCubemap and mirrorCubemap"},
      {"three.js", "three.js equirectangular and CubeTexture, whose look-up reverses x", centred_on(kPlusX),
       x_reversed, identity, identity,
       "three.js, ShaderChunk/common.glsl.js, equirectUv; ShaderChunk/envmap_fragment.glsl.js, flipEnvMap; "
       "CubeTextureLoader documentation"},
      {"blender", "Blender environment texture (right-handed, +Z up)", centred_on(kPlusX), identity, identity,
       axes(kPlusX, kMinusZ, kPlusY),
       "Blender Cycles, kernel/camera/projection.h, direction_to_equirectangular and "
       "direction_to_mirrorball"},
      {"unity", "Unity panoramic skybox and cube maps (left-handed, +Y up, our +X is its −X)",
       centred_on(kMinusX), x_reversed, identity, x_reversed,
       "Unity built-in shaders, Skybox-Panoramic.shader, ToRadialCoords, and Skybox-Cubed.shader; UnityGLTF, "
       "SchemaExtensions.cs, CoordinateSpaceConversionScale"},
      {"unreal", "Unreal long-lat import and cube maps (left-handed, +Z up, our +Z is its +Y)",
       centred_on(kMinusZ), axes(kPlusX, kPlusZ, kPlusY), identity, axes(kPlusX, kPlusZ, kPlusY),
       "Unreal Engine, TextureCompressorModule.cpp, LookupLongLat and TransformSideToWorldSpace; GLTFCore, "
       "ConversionUtilities.h, ConvertVec3"},
      {"pbrt",
       "pbrt-v4 equal-area octahedra, and lat-longs for its imgtool (left-handed, +Z up, our +Z is its +Y)",
       centred_on(kMinusX), identity, identity, axes(kPlusX, kPlusZ, kPlusY),
       "pbrt-v4, src/pbrt/cmd/imgtool.cpp, makeequiarea, and src/pbrt/util/math.cpp, "
       "EqualAreaSquareToSphere; "
       "Pharr, Jakob & Humphreys 2023, §3.1.1"},
      {"debevec", "Debevec's light probes: lat-longs and angular maps with −Z at the centre",
       centred_on(kMinusZ), identity, centred_on(kMinusZ), identity,
       "Debevec, debevec.org/Probes (angular) and gl.ict.usc.edu/Data/HighResProbes (panoramic)"},
      {"left-handed", "a left-handed world, +Y up, our −Z is its +Z; its +Z at the centre of a lat-long",
       centred_on(kMinusZ), axes(kPlusX, kPlusY, kMinusZ), identity, axes(kPlusX, kPlusY, kMinusZ),
       "docs/conventions.md"},
      {"babylon",
       "Babylon.js in its default left-handed scene (+Y up, our +X is its −X): lat-longs, cube maps, .env",
       identity, x_reversed, identity, x_reversed,
       "Babylon.js, Misc/HighDynamicRange/panoramaToCubemap.ts, CalcProjectionSpherical; ShadersInclude/"
       "reflectionFunction.fx, computeCubicCoords; glTF loader, coordinate system AUTO"},
      {"babylon-right-handed", "Babylon.js with scene.useRightHandedSystem: lat-longs, cube maps, .env",
       centred_on(kMinusZ), axes(kPlusX, kPlusY, kMinusZ), identity, identity,
       "as babylon; reflectionFunction.fx's REFLECTIONMAP_OPPOSITEZ reverses z"},
      {"playcanvas", "PlayCanvas lat-longs and atlases, and cube maps, whose look-up reverses x", identity,
       x_reversed, identity, identity,
       "PlayCanvas, shader-lib/glsl/chunks, reflectionEnv.js, reflectionCube.js and spherical.js"},
      {"cesium", "Cesium cube maps of a model's own frame (right-handed, +Z up, our +Z is its +X)", identity,
       axes(kPlusZ, kPlusY, kMinusX), identity, axes(kPlusZ, kPlusX, kPlusY),
       "Cesium, Scene/Model/Model.js, iblReferenceFrameMatrix; Scene/Axis.js, Z_UP_TO_X_UP and Y_UP_TO_Z_UP"},
      {"bevy", "Bevy cube maps (right-handed, +Y up), whose look-up reverses z", identity,
       axes(kPlusX, kPlusY, kMinusZ), identity, identity,
       "Bevy, crates/bevy_pbr/src/light_probe/environment_map.wesl, compute_radiances"},
  };
}

}  // namespace

const std::vector<Convention>& conventions() {
  static const std::vector<Convention> list = make_conventions();
  return list;
}

const Convention& convention_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const Convention& each : conventions()) {
    if (each.name == name) return each;
    names.push_back(each.name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("convention", name, names));
}

Matrix3 orientation_for(const Convention& convention, const sphere::AnyParameterization& parameterization) {
  switch (parameterization.traits().projection) {
    case sphere::Projection::panorama:
      return convention.latlong;
    case sphere::Projection::lookup:
      return convention.lookup;
    case sphere::Projection::disc:
      return convention.disc;
    case sphere::Projection::unturned:
      break;
  }
  return {};
}

sphere::AnyParameterization parameterization_for(const Convention& convention,
                                                 const sphere::AnyParameterization& parameterization) {
  if (parameterization.spec() != "latlong" || convention.latlong_as == "latlong") return parameterization;
  return sphere::AnyParameterization::make(convention.latlong_as);
}

}  // namespace welkin
