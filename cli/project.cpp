#include "welkin/render/project/project.h"

#include <fmt/core.h>

#include "command.h"
#include "commands.h"
#include "progress.h"
#include "project_grid.h"
#include "render_worlds.h"
#include "scene_flags.h"

namespace welkin::cli {
namespace {

struct Project {
  std::string scene, out, format, at, to = "cube", size, shading = "material", depth = "none";
  int samples = 4;
  bool coverage = false, shade_once = false;
  std::optional<double> farthest;
  WriteFlags write;
  SceneFlags placed;
  WorldFlags worlds;
  GridFlags grid;

  void run(const Command& command) const;

 private:
  scene::ProjectOptions options() const;
  void project(const scene::ShadedScene& seen, const Vec3d& place, const MapShape& shape,
               const scene::ProjectOptions& how) const;
};

std::vector<std::string> channels_of(const scene::ProjectOptions& options) {
  std::vector<std::string> names{"R", "G", "B"};
  if (options.coverage) names.emplace_back("A");
  if (options.depth != scene::DepthChannels::none) names.emplace_back("Z");
  if (options.depth == scene::DepthChannels::moments) names.emplace_back("Z2");
  return names;
}

/// Where nothing is said of the world around, it is black: surfaces show what they give off.
scene::Worlds black() {
  return {scene::World(Map(sphere::AnyParameterization::make("latlong"), 32, 16, 3))};
}

scene::ProjectOptions Project::options() const {
  scene::ProjectOptions how;
  how.samples = samples;
  how.coverage = coverage;
  how.shade_once = shade_once;
  how.farthest = farthest;
  const std::vector<std::string> names{"none", "mean", "moments"};
  const auto found = std::find(names.begin(), names.end(), depth);
  if (found == names.end()) throw UsageError("--depth: " + unknown_name("kind of depth", depth, names));
  how.depth = static_cast<scene::DepthChannels>(found - names.begin());
  return how;
}

void Project::project(const scene::ShadedScene& seen, const Vec3d& place, const MapShape& shape,
                      const scene::ProjectOptions& how) const {
  const std::string text = !size.empty() ? size : shape.parameterization.charts() == 1 ? "1024" : "256";
  const ChartSize chart = parse_chart_size("--size", text, shape.parameterization);
  check_output_size(chart, shape, write);
  const MapShape sized = for_chart_size(shape, chart);
  const WriteMapOptions options = write.parse();
  check_write_map(out, sized, chart, 1, channels_of(how), options);
  scene::ProjectOptions monitored = how;
  monitored.monitor = progress_monitor("project");
  const Map map = parse_option("--at", [&] {
    return scene::project(seen, place, MapFrame(sized.parameterization, chart), monitored);
  });
  end_progress();
  report_losses(out, write_map(out, map, sized.layout, options));
}

void Project::run(const Command& command) const {
  const scene::ProjectOptions how = options();
  worlds.read.parse();
  if (grid.asked() != at.empty())
    throw UsageError(at.empty() ? "--at: say from where the scene is seen, or --grid"
                                : "--at: doesn't go with --grid");
  std::optional<GridFlags::Request> request;
  std::optional<Vec3d> place;
  std::optional<MapShape> shape;
  if (grid.asked()) {
    for (const char* option : {"--to", "--depth", "--coverage"})
      if (command.option(option).given())
        throw UsageError(
            fmt::format("{}: doesn't go with --grid, whose probes are octahedral, with distances", option));
    check_extension(out);
    request = grid.parse(out, size, samples, write);
    request->options.farthest = farthest;
  } else {
    grid.check_unused();
    place = parse_point("--at", at);
    shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
    check_output(out, *shape, write);
  }
  scene::Scene loaded = placed.load(scene);
  const bool lit = !worlds.env.empty();
  const scene::Worlds around = lit ? worlds.load(loaded) : black();
  const scene::TracedScene traced(std::move(loaded));
  const auto shade = placed.lit(
      parse_option("--shading", [&] { return scene::make_shading(shading, around); }), shading, traced);
  const scene::ShadedScene seen{traced, *shade, lit ? &around.whole : nullptr};
  if (request) return grid.run(*request, seen, out, write);
  project(seen, *place, *shape, how);
}

}  // namespace

void add_project(Command app) {
  auto project = std::make_shared<Project>();
  Command command = app.add_command(
      "project", "Make a map of what a place in a scene sees all around, or atlases of a grid of places");
  command
      .add_option("SCENE", project->scene, "glTF or OBJ to read, or a built-in scene: `welkin list scenes`")
      .required();
  command.add_option("OUT", project->out, "Map to write; its extension names the format").required();
  command.add_option("--at", project->at, "x,y,z: the place");
  command.add_option("--to", project->to, "Parameterization: NAME[:LAYOUT][,PARAMETER=VALUE]").show_default();
  command.add_option("--size", project->size,
                     "Size of a chart in texels: N across, or WxH. Default: 1024, faces 256, probes 32");
  std::string names;
  for (const scene::ShadingName& each : scene::shading_names())
    names += (names.empty() ? "" : ", ") + each.name;
  command
      .add_option("--shading", project->shading,
                  "How surfaces are shaded: " + names + ". Without --env, the world is black")
      .show_default();
  command.add_option("--samples", project->samples, "Rays along each axis of a texel")
      .within(1, 64)
      .show_default();
  command
      .add_option("--depth", project->depth,
                  "Distances too: none, mean (channel Z), moments (Z, and Z2 of their squares)")
      .show_default();
  command
      .add_option(
          "--farthest", project->farthest,
          "Distance that farther ones, and the sky, count as. Default: that of the scene's farthest corner")
      .finite(0);
  command.add_flag("--coverage", project->coverage, "Channel A: the share that surfaces cover");
  command.add_flag("--shade-once", project->shade_once,
                   "Shade each surface once a texel, not for each ray: faster");
  project->grid.add(command);
  project->placed.add_scene(command);
  project->worlds.add(command);
  project->write.add(command);
  add_format(command, project->format);
  command.callback([project, command] {
    project->out = output_path(project->out, project->format);
    if (!project->worlds.env.empty()) project->worlds.env = input_path(project->worlds.env);
    project->run(command);
  });
}

}  // namespace welkin::cli
