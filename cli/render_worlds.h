#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "welkin/render/shading/shading.h"
#include "welkin/scene/scene.h"

namespace welkin::cli {

/// Options of the worlds that a scene's surfaces reflect.
struct WorldFlags {
  std::string env, chain, proxy, filter = "auto";
  std::vector<std::string> own;
  double exposure = 0;
  ReadFlags read;

  void add(Command command);
  /// Reads all of them. Throws UsageError.
  scene::Worlds load(const scene::Scene& scene) const;

 private:
  scene::World load_one(const std::string& file, const scene::Proxy& where) const;
};

}  // namespace welkin::cli
