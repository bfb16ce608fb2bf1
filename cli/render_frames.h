#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "command.h"
#include "render_integrator.h"
#include "welkin/render/render.h"
#include "welkin/sequence/frame_names.h"

namespace welkin::cli {

/// Makes a scene's shading in these worlds.
using MakeSceneShading = std::function<std::unique_ptr<scene::Shading>(const scene::Worlds& worlds,
                                                                       const scene::TracedScene& scene)>;

/// Options of animations.
struct AnimationFlags {
  std::string frames, move;
  int turntable = 0, every = 10;
  bool resume = false;

  void add(Command command);
  /// Whether there is one; throws UsageError for options of one where there is none.
  bool asked(const std::string& out) const;
  /// Makes and writes all frames of a job; `words` is the command line, which --resume compares.
  void run(const RenderJob& job, const MakeSceneShading& shade, const IntegratorFlags& integrator,
           const std::string& words) const;

 private:
  struct Motion;
  std::optional<Motion> motion_of(const scene::Scene& scene, const FrameRange& range) const;
};

}  // namespace welkin::cli
