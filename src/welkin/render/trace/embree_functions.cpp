#include "welkin/render/trace/embree_functions.h"

#include "welkin/base/late_library.h"

namespace welkin::scene {
namespace {

EmbreeFunctions found() {
  const LateLibrary library("libembree3.so.3", "libembree3-3", "traces rays");
  EmbreeFunctions f{};
  library.find("rtcNewDevice", f.new_device);
  library.find("rtcReleaseDevice", f.release_device);
  library.find("rtcGetDeviceError", f.get_device_error);
  library.find("rtcNewScene", f.new_scene);
  library.find("rtcReleaseScene", f.release_scene);
  library.find("rtcSetSceneFlags", f.set_scene_flags);
  library.find("rtcSetSceneBuildQuality", f.set_scene_build_quality);
  library.find("rtcCommitScene", f.commit_scene);
  library.find("rtcNewGeometry", f.new_geometry);
  library.find("rtcReleaseGeometry", f.release_geometry);
  library.find("rtcSetSharedGeometryBuffer", f.set_shared_geometry_buffer);
  library.find("rtcCommitGeometry", f.commit_geometry);
  library.find("rtcAttachGeometryByID", f.attach_geometry_by_id);
  library.find("rtcIntersect1", f.intersect_1);
  library.find("rtcIntersect1M", f.intersect_1m);
  library.find("rtcOccluded1", f.occluded_1);
  library.find("rtcOccluded1M", f.occluded_1m);
  return f;
}

}  // namespace

const EmbreeFunctions& embree() {
  static const EmbreeFunctions functions = found();
  return functions;
}

}  // namespace welkin::scene
