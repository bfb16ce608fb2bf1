#pragma once

#include <optional>
#include <string>

#include "command.h"
#include "welkin/render/probes/probe_grid.h"

namespace welkin::cli {

/// `project --grid`: many places at once.
struct GridFlags {
  std::string counts, box, layout = "welkin", roughness;
  std::optional<int> diffuse_size, depth_size;

  void add(Command command);
  bool asked() const { return !counts.empty(); }
  /// Throws UsageError for what only goes with --grid.
  void check_unused() const;

  /// What can be known before the scene is. Throws UsageError.
  struct Request {
    std::array<int, 3> counts;
    std::optional<scene::Bounds> box;
    bool rtxgi = false;
    scene::ProbeGridOptions options;
  };
  Request parse(const std::string& out, const std::string& size, int samples, const WriteFlags& write) const;

  /// Projects and writes all files: OUT's name, each with what it holds before the extension, and a JSON.
  void run(const Request& request, const scene::ShadedScene& seen, const std::string& out,
           const WriteFlags& write) const;
};

}  // namespace welkin::cli
