#pragma once

#include <embree3/rtcore.h>

namespace welkin::scene {

/// The functions of Embree 3 that are used here. The library takes a millisecond to load, so only what traces
/// rays loads it.
struct EmbreeFunctions {
  decltype(&rtcNewDevice) new_device;
  decltype(&rtcReleaseDevice) release_device;
  decltype(&rtcGetDeviceError) get_device_error;
  decltype(&rtcNewScene) new_scene;
  decltype(&rtcReleaseScene) release_scene;
  decltype(&rtcSetSceneFlags) set_scene_flags;
  decltype(&rtcSetSceneBuildQuality) set_scene_build_quality;
  decltype(&rtcCommitScene) commit_scene;
  decltype(&rtcNewGeometry) new_geometry;
  decltype(&rtcReleaseGeometry) release_geometry;
  decltype(&rtcSetSharedGeometryBuffer) set_shared_geometry_buffer;
  decltype(&rtcCommitGeometry) commit_geometry;
  decltype(&rtcAttachGeometryByID) attach_geometry_by_id;
  decltype(&rtcIntersect1) intersect_1;
  decltype(&rtcIntersect1M) intersect_1m;
  decltype(&rtcOccluded1) occluded_1;
  decltype(&rtcOccluded1M) occluded_1m;
};

/// Throws Error (unsupported) where the library isn't installed.
const EmbreeFunctions& embree();

}  // namespace welkin::scene
