#pragma once

#include <optional>
#include <string>

#include "command.h"
#include "render_worlds.h"
#include "scene_flags.h"
#include "welkin/render/render.h"
#include "welkin/render/world_along.h"
#include "welkin/sequence/frame_names.h"

namespace welkin::cli {

/// How a picture of a scene is made, its worlds read.
struct RenderRequest {
  std::string out, shading;
  scene::Worlds worlds;
  scene::PlacedCamera camera;
  scene::ShadingOptions shading_options;
  scene::RenderOptions options;
  const WriteFlags* write = nullptr;
};

/// Options of animations.
struct AnimationFlags {
  std::string frames, move;
  int turntable = 0, every = 10;
  bool resume = false;

  void add(CLI::App& command);
  /// Whether there is one; throws UsageError for options of one where there is none.
  bool asked(const std::string& out) const;
  /// Makes and writes all frames; `words` is the command line, which --resume compares.
  void run(const scene::TracedScene& scene, RenderRequest request, const std::string& words) const;

 private:
  struct Motion;
  std::optional<Motion> motion_of(const scene::Scene& scene, const FrameRange& range) const;
};

}  // namespace welkin::cli
