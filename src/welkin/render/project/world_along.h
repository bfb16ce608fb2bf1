#pragma once

#include <functional>
#include <map>

#include "welkin/base/export.h"
#include "welkin/render/project/project.h"

/// @file
/// What a moving object sees of its scene: projected every few frames, and interpolated between (Greene
/// 1986).
namespace welkin::scene {

/// How often, and how finely.
struct WorldAlongOptions {
  int every = 10;              ///< frames from one projection to the next, 1 … 100000
  ChartSize size = {128, 64};  ///< of the lat-long that is projected
  int samples = 2;             ///< ProjectOptions::samples
};

/// The worlds of an object that moves through a scene. Filtering is linear, so what is interpolated between
/// two projections and then filtered with a cosine is what is interpolated between two diffuse maps. One
/// thread at a time.
class WELKIN_API WorldAlong {
 public:
  /// `seen`: the scene without the object (TracedScene::moved), which must outlive this. `place`: where the
  /// object's centre is at a frame. Throws Error (bad_request) for options out of range.
  WorldAlong(const ShadedScene& seen, std::function<Vec3d(double frame)> place,
             const WorldAlongOptions& options = {});

  /// The map at a frame: of one that is a multiple of `every` as projected, of others between the two beside
  /// it. Two projections are kept. Throws as project does.
  Map at(int frame, const Monitor& monitor = {});

  /// How many projections were made.
  int made() const { return made_; }

 private:
  const Map& key(int frame, const Monitor& monitor);

  ShadedScene seen_;
  std::function<Vec3d(double frame)> place_;
  WorldAlongOptions options_;
  std::map<int, Map> keys_;
  int made_ = 0;
};

}  // namespace welkin::scene
