#include "render_integrator.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "json_text.h"
#include "picture_file.h"
#include "scene_flags.h"
#include "welkin/measure/picture_errors.h"
#include "welkin/render/backdrop.h"
#include "welkin/render/hybrid.h"

namespace welkin::cli {

void IntegratorFlags::add(Command command) {
  command
      .add_option(
          "--integrator", integrator,
          "look-up: surfaces show maps. hybrid: mirrors and glass trace what is near, and show maps where "
          "there is nothing. path: paths of light through all of the scene, by its materials")
      .show_default();
  command.add_option("--paths", paths, "Paths of each pixel").within(1, 1 << 20).show_default();
  command
      .add_option("--depth", depth,
                  "Surfaces at which paths are scattered, or rays of mirrors go on, at most")
      .within(0, 100)
      .show_default();
  command
      .add_option("--sampling", sampling,
                  "How paths find light: mis (both of the others), bsdf (where surfaces scatter), "
                  "light (where the map or a lamp is bright)")
      .show_default();
  command.add_option("--seed", seed, "Another number gives other paths of the same mean").show_default();
  command
      .add_option("--clamp", clamp,
                  "The most radiance of one path: hides bright dots, and darkens. Default: no bound")
      .finite(0);
  command.add_option("--smooth", smooth, "Of hybrid: the largest roughness of surfaces that trace rays")
      .within(0.0, 1.0)
      .show_default();
  command.add_option(
      "--compare", compare,
      "Render the truth by paths as well, write both and their difference side by side to this "
      "picture, and print the error");
  command.add_option("--standard-error", standard_error,
                     "Of path: write the standard error of each pixel's values to this picture");
  command.add_flag("--json", json, "With --compare: the error as JSON, on standard output");
}

void IntegratorFlags::check() const {
  const std::vector<std::string> names{"look-up", "path", "hybrid"};
  if (std::find(names.begin(), names.end(), integrator) == names.end())
    throw UsageError("--integrator: " + unknown_name("integrator", integrator, names));
  parse_option("--sampling", [&] { return scene::light_sampling_from_name(sampling); });
  if (integrator == "path" && !compare.empty())
    throw UsageError("--compare: compares look-up or hybrid with paths: choose one of them by --integrator");
  if (integrator != "path" && !standard_error.empty())
    throw UsageError("--standard-error: is that of paths: add --integrator path");
  if (json && compare.empty()) throw UsageError("--json: is what --compare finds: add it");
  for (const std::string& file : {compare, standard_error})
    if (!file.empty()) check_extension(file);
}

scene::PathOptions IntegratorFlags::path_options(const RenderJob& job) const {
  scene::PathOptions options;
  options.samples = paths;
  options.depth = depth;
  options.seed = seed;
  options.sampling = scene::light_sampling_from_name(sampling);
  options.clamp = clamp;
  options.background = job.look_up.background;
  options.monitor = progress_monitor("following paths");
  return options;
}

Image IntegratorFlags::make(const RenderJob& job, bool background) const {
  if (integrator == "hybrid")
    return render_hybrid(job.scene, job.camera, job.worlds, *job.shading,
                         {.samples = job.look_up.samples,
                          .depth = depth,
                          .smooth = smooth,
                          .background = background,
                          .monitor = job.look_up.monitor});
  scene::RenderOptions options = job.look_up;
  options.background = background;
  return scene::render(job.scene, job.camera, job.worlds.whole, *job.shading, options);
}

void IntegratorFlags::compare_with_paths(const RenderJob& job, const Image& alone) const {
  scene::PathOptions options = path_options(job);
  options.background = false;
  const scene::PathPicture truth = path_trace(job.scene, job.camera, job.worlds.whole, options);
  end_progress();
  const PictureErrors errors =
      picture_errors({alone.view(), truth.picture.view(), truth.standard_error.view()});
  Image shown[2] = {Image(alone.width(), alone.height(), 4), Image(alone.width(), alone.height(), 4)};
  copy_pixels(alone.view(), shown[0].view());
  copy_pixels(truth.picture.view(), shown[1].view());
  // The difference is that of the scene alone.
  Image sides = side_by_side({shown[0].view(), shown[1].view()});
  if (job.look_up.background) {
    for (Image& each : shown) show_behind(each, job.camera, job.worlds.whole);
    const Image behind = side_by_side({shown[0].view(), shown[1].view()});
    const int both = sides.width() - alone.width();
    copy_pixels(behind.view().part(0, 0, both, alone.height()),
                sides.view().part(0, 0, both, alone.height()));
  }
  write_picture(compare, sides, true, job.write);
  if (json) {
    print_json_text({{"picture", job.out},
                     {"compare", compare},
                     {"paths", paths},
                     {"pixels", errors.pixels},
                     {"skipped", errors.skipped},
                     {"relative_rmse", errors.relative_rmse},
                     {"truth_noise", errors.truth_noise},
                     {"mean_error", errors.mean_error},
                     {"max", errors.maximum},
                     {"max_pixel", {errors.maximum_x, errors.maximum_y}}});
    return;
  }
  fmt::print(
      "rel. RMSE {:.4g} (of which {:.4g} is the noise of {} paths)   mean {:+.4g}   max {:.4g} at "
      "{},{}   {} pixels\n",
      errors.relative_rmse, errors.truth_noise, paths, errors.mean_error, errors.maximum, errors.maximum_x,
      errors.maximum_y, errors.pixels);
}

void IntegratorFlags::run(const RenderJob& job) const {
  if (!job.worlds.own.empty() && (integrator == "path" || !compare.empty()))
    print_warning(job.out, "paths are lit by --env alone, not by --own");
  const bool background = job.look_up.background;
  if (integrator == "path") {
    const scene::PathPicture made = parse_option(
        "--sampling", [&] { return path_trace(job.scene, job.camera, job.worlds.whole, path_options(job)); });
    write_picture(job.out, made.picture, background, job.write, job.note);
    if (!standard_error.empty()) write_picture(standard_error, made.standard_error, true, job.write);
    return;
  }
  if (compare.empty()) return write_picture(job.out, make(job, background), background, job.write, job.note);
  Image made = make(job, false);
  compare_with_paths(job, made);
  if (background) show_behind(made, job.camera, job.worlds.whole);
  write_picture(job.out, made, background, job.write, job.note);
}

bool has_lights(const scene::Scene& scene) {
  return !scene.lights.empty() ||
         std::any_of(scene.materials.begin(), scene.materials.end(), [](const scene::Material& material) {
           return std::any_of(material.emission.begin(), material.emission.end(),
                              [](float e) { return e > 0; });
         });
}

}  // namespace welkin::cli
