#pragma once

#include <cstdint>
#include <string>

#include "command.h"
#include "welkin/render/path/path_tracer.h"
#include "welkin/render/render.h"

namespace welkin::cli {

/// What is rendered.
struct RenderJob {
  std::string out;
  const scene::TracedScene& scene;
  const scene::PlacedCamera& camera;
  const scene::Worlds& worlds;
  const scene::Shading* shading;  ///< none for paths
  scene::RenderOptions look_up;   ///< its background is that of all integrators
  const WriteFlags& write;
  std::string note = {};  ///< of write_picture
};

/// Options of how a picture is made: by look-ups, paths, or both.
struct IntegratorFlags {
  std::string integrator = "look-up", sampling = "mis", compare, standard_error;
  int paths = 64, depth = 16;
  std::uint64_t seed = 0;
  double clamp = 0, smooth = 0.1;
  bool json = false;

  void add(Command command);
  /// Throws UsageError.
  void check() const;
  bool needs_shading() const { return integrator != "path"; }
  /// The picture, written with all that was asked for beside it.
  void run(const RenderJob& job) const;

 private:
  scene::PathOptions path_options(const RenderJob& job) const;
  Image make(const RenderJob& job, bool background) const;
  void compare_with_paths(const RenderJob& job, const Image& alone) const;
};

/// Whether a scene shines by itself.
bool has_lights(const scene::Scene& scene);

}  // namespace welkin::cli
