// How far surfaces that are shaded by look-ups are from paths of light: balls of each roughness in the middle
// and at grazing angles, mirrors, glass, and scenes whose things reflect each other.

#include <cmath>
#include <string>
#include <vector>

#include "harness.h"
#include "lighting.h"
#include "welkin/measure/picture_errors.h"
#include "welkin/render/hybrid.h"
#include "welkin/render/path/path_tracer.h"
#include "welkin/scene/built_in.h"
#include "welkin/scene/shapes.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using namespace welkin::scene;

constexpr int kSize = 96;

Scene ball_of(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  scene.meshes.push_back(sphere_mesh(256));
  scene.instances.push_back({"ball", 0, {}, -1});
  return scene;
}

Material metal(float roughness) {
  Material material;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

Material paint(float roughness) {
  Material material;
  material.roughness = roughness;
  material.base_color = {0.5f, 0.5f, 0.5f};
  return material;
}

/// The ball fills the picture.
PlacedCamera ball_camera() {
  PlacedCamera placed;
  placed.camera.fov = 29;
  placed.camera.size = {kSize, kSize};
  placed.position = {0, 0, -4};
  return placed;
}

/// Both pictures where the ball's n·v is within a range: elsewhere nothing covers.
PictureErrors errors_between(const Image& picture, const PathPicture& truth, double least, double most) {
  Image a(kSize, kSize, 4), b(kSize, kSize, 4);
  const double half = std::tan(29 * kPi / 360);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (truth.picture.at(x, y)[3] < 1) continue;
      const double sx = ((x + 0.5) / kSize * 2 - 1) * half, sy = ((y + 0.5) / kSize * 2 - 1) * half;
      const Vec3d d = normalize(Vec3d{sx, sy, 1});
      const double along = 4 * d.z, square = along * along - 15;
      if (square < 0) continue;
      const double nv = std::sqrt(square);  // the ball's radius is 1
      if (nv < least || nv >= most) continue;
      for (int c = 0; c < 4; ++c) {
        a.at(x, y)[c] = picture.at(x, y)[c];
        b.at(x, y)[c] = truth.picture.at(x, y)[c];
      }
    }
  }
  return picture_errors({a.view(), b.view(), truth.standard_error.view()});
}

std::string signed_percent(double part) {
  return (part < 0 ? "" : "+") + fixed(100 * part, 2);
}

std::string cell(const Image& picture, const PathPicture& truth, double least, double most) {
  const PictureErrors errors = errors_between(picture, truth, least, most);
  return percent(errors.relative_rmse) + " (" + (errors.mean_error < 0 ? "" : "+") +
         percent(errors.mean_error) + ")";
}

void ball_table(const std::string& name, Map map, bool metallic) {
  heading(std::string(metallic ? "Metal" : "Grey paint") + " under `" + name + "`");
  const Table table({"roughness", "shading", "n·v > 0.7", "0.3 … 0.7", "< 0.3", "noise of the truth"});
  const World world(std::move(map));
  std::vector<std::string> shadings{"material"};
  if (metallic) shadings.insert(shadings.end(), {"stack", "glossy", "mirror"});
  for (const float roughness : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const TracedScene scene(ball_of(metallic ? metal(roughness) : paint(roughness)));
    const PathPicture truth = path_trace(scene, ball_camera(), world, {.samples = 256, .background = false});
    for (const std::string& shading : shadings) {
      if (shading == "mirror" && roughness > 0) continue;
      const Image picture = render(scene, ball_camera(), world, *make_shading(shading, {world}),
                                   {.samples = 8, .background = false});
      table.row({fixed(static_cast<double>(roughness), 2), shading, cell(picture, truth, 0.7, 2),
                 cell(picture, truth, 0.3, 0.7), cell(picture, truth, 0, 0.3),
                 percent(errors_between(picture, truth, 0, 2).truth_noise)});
    }
  }
}

/// A scene's look-ups, and mirrors that trace, against paths.
void scene_row(const Table& table, const std::string& name, const World& world) {
  Scene loaded = built_in(name);
  Camera like;
  like.size = {192, 108};
  PlacedCamera camera = camera_that_sees(loaded, like);
  if (!loaded.cameras.empty()) {
    const SceneCamera& own = loaded.cameras.front();
    camera.camera.rotation = own.rotation;
    camera.camera.axis = FovAxis::vertical;
    camera.camera.fov = own.vertical_fov;
    camera.position = own.position;
  }
  const TracedScene scene(std::move(loaded));
  const auto shading = make_shading("material", {world});
  const PathPicture truth = path_trace(scene, camera, world, {.samples = 256, .background = false});
  const Image looked_up = render(scene, camera, world, *shading, {.background = false});
  const Image hybrid = render_hybrid(scene, camera, {world}, *shading, {.background = false});
  const auto errors = [&](const Image& picture) {
    return picture_errors({picture.view(), truth.picture.view(), truth.standard_error.view()});
  };
  const PictureErrors by_map = errors(looked_up), by_both = errors(hybrid);
  table.row({name, percent(by_map.relative_rmse), signed_percent(by_map.mean_error),
             percent(by_both.relative_rmse), signed_percent(by_both.mean_error),
             percent(by_map.truth_noise)});
}

/// White balls in a world of radiance 1: what of 1 is missing.
void furnace_table() {
  heading("White furnace");
  const Table table({"roughness", "metal", "dielectric", "glass", "± (standard error)"});
  Map even(sphere::AnyParameterization::make("latlong"), 32, 16, 3);
  for (int y = -kBorder; y < 16 + kBorder; ++y)
    for (int x = -kBorder; x < 32 + kBorder; ++x)
      for (int c = 0; c < 3; ++c) even.level.chart(0).at(x, y)[c] = 1;
  const World world(std::move(even));
  for (const float roughness : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    std::vector<std::string> cells{fixed(static_cast<double>(roughness), 2)};
    double most = 0;
    Material dielectric = metal(roughness);
    dielectric.metallic = 0;
    Material glass = dielectric;
    glass.transmission = 1;
    for (const Material& material : {metal(roughness), dielectric, glass}) {
      const PathPicture made =
          path_trace(TracedScene(ball_of(material)), ball_camera(), world,
                     {.samples = 256, .depth = 256, .sampling = LightSampling::bsdf, .background = false});
      double sum = 0, error = 0;
      int count = 0;
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          if (made.picture.at(x, y)[3] < 1) continue;
          sum += made.picture.at(x, y)[0];
          error += std::pow(made.standard_error.at(x, y)[0], 2);
          ++count;
        }
      }
      cells.push_back(signed_percent(sum / count - 1));
      most = std::max(most, std::sqrt(error) / count);
    }
    cells.push_back(percent(most));
    table.row(cells);
  }
}

}  // namespace

int main() {
  const Threads threads;
  heading("Pictures by look-ups against paths of light");
  paragraph(
      "Root mean square error in percent of that of the truth, and in brackets the mean error in percent of "
      "the mean: "
      "above 0, look-ups are too bright. Balls of radius 1 from 4 away, 96×96 pixels, 256 paths a pixel; "
      "maps of "
      "1024×512.");
  for (const char* name : {"studio", "room"})
    for (const bool metallic : {true, false})
      ball_table(name,
                 welkin::render(synth::make(name), sphere::AnyParameterization::make("latlong"), 1024, 512),
                 metallic);
  heading("Scenes");
  const Table table(
      {"scene", "`material`: rel. RMSE", "mean", "`hybrid`: rel. RMSE", "mean", "noise of the truth"});
  const World world(
      welkin::render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), 1024, 512));
  for (const char* name : {"sphere", "spheres", "torus", "teapot", "floor", "creature"})
    scene_row(table, name, world);
  furnace_table();
  return 0;
}
