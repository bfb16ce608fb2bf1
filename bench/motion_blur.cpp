// What blurred motion costs, and how near it is to the mean of sharp pictures.

#include <cmath>
#include <vector>

#include "harness.h"
#include "welkin/camera/motion_blur.h"
#include "welkin/camera/view.h"
#include "welkin/map/borders.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kSharp = 64;
constexpr ChartSize kSize{960, 540};
constexpr Shutter kShutter{0, 1};

/// Turns by so many degrees a frame, looks up, rolls and zooms.
std::function<Camera(double)> camera_turning(double degrees) {
  return [degrees](double frame) {
    Camera camera;
    camera.size = kSize;
    camera.rotation = rotation_of({20 + degrees * frame, -10 + degrees * frame / 2, degrees * frame});
    camera.fov = 80 - degrees * frame / 4;
    return camera;
  };
}

std::vector<double> mean_of_views(const Map& world, const std::function<Camera(double)>& camera) {
  std::vector<double> sum(static_cast<std::size_t>(kSize.width * kSize.height * 3));
  for (int i = 0; i < kSharp; ++i) {
    const Map picture = view(world, camera((i + 0.5) / kSharp), {.borders = false});
    for (int y = 0; y < kSize.height; ++y) {
      const float* const values = picture.level.chart(0).row(y);
      for (int k = 0; k < 3 * kSize.width; ++k)
        sum[static_cast<std::size_t>(y * 3 * kSize.width + k)] += static_cast<double>(values[k]) / kSharp;
    }
  }
  return sum;
}

double relative_rmse(const Map& picture, const std::vector<double>& wanted) {
  double error = 0, all = 0;
  for (int y = 0; y < kSize.height; ++y) {
    const float* const values = picture.level.chart(0).row(y);
    for (int k = 0; k < 3 * kSize.width; ++k) {
      const double want = wanted[static_cast<std::size_t>(y * 3 * kSize.width + k)];
      error += (static_cast<double>(values[k]) - want) * (static_cast<double>(values[k]) - want);
      all += want * want;
    }
  }
  return std::sqrt(error / all);
}

/// Frames of one world, each by a pyramid of its own and by one that is kept.
void sequences() {
  heading("Blurred frames of one world");
  paragraph(
      "The next frame of a sequence, 4° a frame, of a lat-long: processor seconds of `blurred_view`, which "
      "makes the world's pyramid for every frame, and of a `BlurredWorld`, which keeps it.");
  const Table table({"world", "fov", "blurred_view", "BlurredWorld", "times faster"});
  for (const int width : {4096, 8192}) {
    const Map world = render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), width,
                             width / 2, {.samples = 1});
    const BlurredWorld kept(world);
    for (const double fov : {60.0, 120.0}) {
      const auto camera = [fov](double frame) {
        Camera wide = camera_turning(4)(frame);
        wide.fov = fov;
        return wide;
      };
      const std::vector<Timing> timings = time_jobs(
          {[&] { blurred_view(world, camera, kShutter); }, [&] { kept.view(camera, kShutter); }}, 5);
      table.row({"studio " + std::to_string(width), fixed(fov, 0) + "°", cpu_cell(timings[0]),
                 cpu_cell(timings[1]), fixed(ratio(timings[0], timings[1]), 2)});
    }
  }
}

}  // namespace

int main() {
  const Threads threads;
  sequences();
  heading("Blurred motion");
  paragraph(
      "Pictures of 960×540, 80° across, of lat-longs, by a camera that turns, looks up, rolls and zooms "
      "while its shutter is open: relative "
      "RMSE against the mean of 64 sharp pictures by `auto`, processor seconds of both, and their ratio.");
  const Table table(
      {"world", "moves, pixels", "rel. RMSE %", "64 sharp pictures", "blurred", "times faster"});
  for (const char* name : {"studio", "room", "checker"}) {
    for (const int width : {2048, 8192}) {
      const Map world = render(synth::make(name), sphere::AnyParameterization::make("latlong"), width,
                               width / 2, {.samples = 1});
      for (const double degrees : {1.0, 4.0}) {
        const auto camera = camera_turning(degrees);
        std::vector<double> wanted;
        const Seconds sharp = time_once([&] { wanted = mean_of_views(world, camera); });
        std::optional<Map> picture;
        const Timing blurred =
            time_jobs({[&] { picture.emplace(blurred_view(world, camera, kShutter)); }}, 3)[0];
        table.row({std::string(name) + " " + std::to_string(width), fixed(swept_pixels(camera, kShutter), 1),
                   fixed(100 * relative_rmse(*picture, wanted), 2), fixed(sharp.cpu, 2), cpu_cell(blurred),
                   fixed(sharp.cpu / blurred.median().cpu, 1)});
      }
    }
  }
}
