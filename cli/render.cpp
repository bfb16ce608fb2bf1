#include "welkin/render/render.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "bake_set.h"
#include "command.h"
#include "picture_file.h"
#include "progress.h"
#include "render_frames.h"
#include "render_integrator.h"
#include "render_worlds.h"
#include "scene_flags.h"
#include "welkin/io/image_file.h"

namespace welkin::cli {
namespace {

struct Render {
  std::string scene, out, format, shading = "material", fresnel = "none", brdf = "ggx", picture;
  int samples = 4, views = 20;
  std::vector<std::string> balls;
  bool no_background = false, quadrilateral = false, per_vertex = false, reflected = false;
  double eta = 1.5, exponent = 50;
  WriteFlags write;
  SceneFlags placed;
  WorldFlags worlds;
  AnimationFlags animation;
  IntegratorFlags integrator;

  void run(const Command& command) const;
  scene::ShadingOptions shading_options() const;
};

scene::ShadingOptions Render::shading_options() const {
  scene::ShadingOptions options;
  options.eta = eta;
  options.exponent = exponent;
  options.quadrilateral = quadrilateral;
  options.brdf = brdf;
  options.views = views;
  options.reflected_coordinates = reflected;
  const std::vector<std::string> names{"none", "add", "share"};
  const auto found = std::find(names.begin(), names.end(), fresnel);
  if (found == names.end()) throw UsageError("--fresnel: " + unknown_name("combination", fresnel, names));
  options.fresnel = static_cast<scene::Fresnel>(found - names.begin());
  if (!picture.empty()) options.picture = std::make_shared<const Image>(read_picture(picture, 3));
  for (const std::string& ball : balls) {
    const std::size_t at = ball.rfind('@');
    if (at == std::string::npos) throw UsageError("--ball: '" + ball + "' is not PICTURE@X,Y,Z");
    const Vec3d view = parse_point("--ball", ball.substr(at + 1));
    if (!(length(view) > 0)) throw UsageError("--ball: '" + ball + "' is seen from no direction");
    auto map = std::make_shared<scene::ViewMap>();
    map->to_eye = scene::eye_towards(view);
    map->picture = read_picture(ball.substr(0, at), 3);
    options.view_maps.push_back(std::move(map));
  }
  return options;
}

void Render::run(const Command& command) const {
  check_extension(out);
  worlds.read.parse();
  const bool animated = animation.asked(out);
  integrator.check();
  scene::ShadingOptions options = shading_options();
  const std::vector<std::string> needless{"matcap",   "window",  "cool-warm", "outline",
                                          "hatching", "normals", "chrome"};
  const bool sketch = std::find(needless.begin(), needless.end(), shading) != needless.end();
  if (!sketch && worlds.env.empty() && integrator.needs_shading())
    throw UsageError("--env: a map of the world is needed to shade with " + shading);
  scene::Scene loaded = placed.load(scene);
  if (!integrator.needs_shading() && worlds.env.empty() && !has_lights(loaded))
    throw UsageError("--env: a map of the world is needed, as nothing in the scene shines");
  const scene::PlacedCamera camera = placed.camera_of(loaded);
  options.to_eye = scene::eye_of(camera.camera.rotation);
  options.lights = loaded.lights;
  options.sheen = has_sheen(loaded);
  const scene::Worlds around = worlds.load(loaded);
  const scene::TracedScene traced(std::move(loaded));
  const MakeSceneShading shade = [&](const scene::Worlds& seen, const scene::TracedScene& standing) {
    return parse_option("--shading",
                        [&] { return placed.lit(make_shading(shading, seen, options), shading, standing); });
  };
  const scene::RenderOptions how{
      .samples = samples,
      .reflection = per_vertex ? scene::Reflection::per_vertex : scene::Reflection::per_pixel,
      .background = !no_background && !worlds.env.empty(),
      .monitor = progress_monitor("rendering " + out)};
  std::unique_ptr<const scene::Shading> made;
  if (animated || integrator.needs_shading()) made = shade(around, traced);
  const RenderJob job{.out = out,
                      .scene = traced,
                      .camera = camera,
                      .worlds = around,
                      .shading = made.get(),
                      .look_up = how,
                      .write = write};
  if (animated) return animation.run(job, shade, integrator, command_line(command));
  integrator.run(job);
}

}  // namespace

void add_render(Command app) {
  auto render = std::make_shared<Render>();
  Command command =
      app.add_command("render", "Make a picture of a scene whose surfaces reflect the world of a map");
  command.add_option("SCENE", render->scene, "glTF or OBJ to read, or a built-in scene: `welkin list scenes`")
      .required();
  command.add_option("OUT", render->out, "Picture to write").required();
  std::string names;
  for (const scene::ShadingName& each : scene::shading_names())
    names += (names.empty() ? "" : ", ") + each.name;
  command.add_option("--shading", render->shading, "How surfaces are shaded: " + names).show_default();
  command
      .add_option(
          "--fresnel", render->fresnel,
          "Of mirror and phong: none, add (F·Lm + Ld), share (F·Lm + (1 − F)·Ld), with diffuse light Ld")
      .show_default();
  command.add_option("--eta", render->eta, "Index of refraction of mirror, phong and refraction")
      .finite()
      .show_default();
  command.add_option("--exponent", render->exponent, "Of phong, and of the highlights of chrome")
      .finite()
      .show_default();
  command
      .add_option("--brdf", render->brdf, "Of stack and warped: ggx, ward, table,file=PATH… (`bake --views`)")
      .show_default();
  command.add_option("--views", render->views, "Of warped: from how many directions the ball is baked")
      .within(3, 1000)
      .show_default();
  command.add_option(
      "--ball", render->balls,
      "PICTURE@X,Y,Z: of warped, a square photograph of a ball of the material, its disc filling "
      "the square, seen from that direction, +Y up; three at least");
  command.add_option("--picture", render->picture,
                     "Of matcap: a square picture of a ball. Of chrome: its colours, the zenith on top");
  command.add_flag("--reflected", render->reflected,
                   "Of matcap: look up by the reflected direction, not the normal");
  command.add_flag("--quadrilateral", render->quadrilateral,
                   "Take cones by their four corners, not as ellipses");
  command.add_flag("--per-vertex", render->per_vertex,
                   "Find reflected directions at corners of triangles, and interpolate them between");
  command.add_option("--samples", render->samples, "Rays along each axis of a pixel")
      .within(1, 64)
      .show_default();
  command.add_flag("--no-background", render->no_background,
                   "Leave the world out: alpha is the scene's coverage");
  render->animation.add(command);
  render->placed.add(command);
  render->worlds.add(command);
  render->integrator.add(command);
  render->write.add(command);
  add_format(command, render->format);
  command.callback([render, command] {
    if (render->out == "-" && !render->integrator.compare.empty())
      throw UsageError("--compare: its numbers are on standard output, where OUT can't be as well");
    render->out = output_path(render->out, render->format);
    if (!render->worlds.env.empty()) render->worlds.env = input_path(render->worlds.env);
    render->run(command);
  });
}

}  // namespace welkin::cli
