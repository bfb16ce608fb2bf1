// What pictures of a panorama cost, and how near `auto` is to a supersampled picture.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "harness.h"
#include "welkin/camera/view.h"
#include "welkin/map_file/byte_remap.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

Map world_of(const char* name, int width) {
  return render(synth::make(name), sphere::AnyParameterization::make("latlong"), width, width / 2,
                {.samples = 1});
}

Camera camera_of(const char* lens, double fov, ChartSize size) {
  Camera camera;
  camera.lens = lens;
  camera.fov = fov;
  camera.size = size;
  camera.rotation = rotation_of({30, 10, 5});
  return camera;
}

void pictures() {
  heading("Pictures of a panorama");
  paragraph(
      "RGB floats of 8192×4096 in memory to a picture of 1920×1080, yaw 30°, pitch 10°, roll 5°: processor "
      "seconds, median "
      "(best). *First* is the first picture of a camera, into memory that has been touched; nothing is set "
      "up before it. *Kept*: positions are kept "
      "from frame to frame (`TexelPositions`), which *positions* finds once.");
  const Map world = world_of("studio", 8192);
  const Table table({"camera", "filter", "first", "warm", "ns per pixel", "positions", "kept"});
  struct Case {
    const char* lens;
    double fov;
    Filter filter;
  };
  for (const Case& each :
       {Case{"perspective", 90, Filter::bilinear}, Case{"perspective", 90, Filter::automatic},
        Case{"perspective", 120, Filter::automatic}, Case{"pannini", 150, Filter::bilinear},
        Case{"equidistant", 180, Filter::bilinear}, Case{"stereographic", 240, Filter::bilinear},
        Case{"cylindrical", 180, Filter::bilinear}}) {
    const Camera camera = camera_of(each.lens, each.fov, {1920, 1080});
    Map picture(frame_of(camera).parameterization, 1920, 1080, 3);
    picture.orientation = frame_of(camera).orientation;
    // What the system takes to provide fresh pages isn't the picture's.
    for (int y = 0; y < picture.height(); ++y) std::fill_n(picture.level.chart(0).row(y), 3 * 1920, 1.0f);
    const auto job = [&] { resample(world, picture, {.filter = each.filter, .borders = false}); };
    const Seconds first = time_once(job);
    ResampleOptions by_kept{.filter = each.filter, .borders = false};
    const bool keeps = each.filter != Filter::automatic;
    Seconds positions;
    if (keeps)
      positions = time_once([&] { by_kept.positions = std::make_shared<TexelPositions>(world, picture); });
    const std::vector<Timing> timings = time_jobs({job, [&] { resample(world, picture, by_kept); }}, 9);
    const Timing& warm = timings[0];
    table.row({std::string(each.lens) + " " + fixed(each.fov, 0) + "°", std::string(name_of(each.filter)),
               fixed(first.cpu, 3), cpu_cell(warm), fixed(warm.median().cpu / (1920 * 1080) * 1e9, 1),
               keeps ? fixed(positions.cpu, 3) : "", keeps ? cpu_cell(timings[1]) : ""});
  }
}

void cubes() {
  heading("Cubes of a panorama");
  paragraph("RGB floats of 4096×2048 in memory to the six faces of 1024, bilinear.");
  const Map world = world_of("studio", 4096);
  Map cube(sphere::AnyParameterization::make("cube"), 1024, 1024, 3);
  const Timing timing =
      time_jobs({[&] { resample(world, cube, {.filter = Filter::bilinear, .borders = false}); }}, 9)[0];
  const Table table({"processor seconds", "Mpix/s of processor time"});
  table.row({cpu_cell(timing), fixed(6 * 1024 * 1024e-6 / timing.median().cpu, 0)});
}

/// A gradient in 8 bits.
std::vector<std::uint8_t> picture_of(ChartSize size, int channels) {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < size.height; ++y) {
    for (int i = 0; i < size.width * channels; ++i)
      bytes.push_back(static_cast<std::uint8_t>((i + 3 * y) >> 4));
  }
  return bytes;
}

void bytes() {
  heading("8-bit frames");
  paragraph(
      "`ByteRemap` of frames in memory, bilinear: processor seconds to find the positions, once, and for "
      "each frame. Three channels "
      "interleaved, and one, of which planar video has three.");
  const auto latlong = sphere::AnyParameterization::make("latlong");
  const Camera camera = camera_of("perspective", 90, {1920, 1080});
  const MapFrame cube(sphere::AnyParameterization::make("cube"), {1024, 1024}), view = frame_of(camera);
  struct Case {
    const char* name;
    MapFrame from, to;
    const char* layout;
  };
  const Table table({"from → to", "channels", "positions", "frame", "Mpix/s of processor time"});
  for (const Case& each :
       {Case{"4096×2048 → cube:3x2 of 1024", {latlong, {4096, 2048}}, cube, "3x2"},
        Case{"8192×4096 → perspective 90° of 1920×1080", {latlong, {8192, 4096}}, view, ""}}) {
    const std::vector<Layout> layouts = layouts_of(each.to.parameterization);
    const auto layout = std::find_if(layouts.begin(), layouts.end(),
                                     [&](const Layout& one) { return one.name == each.layout; });
    std::optional<ByteRemap> remap;
    const Seconds positions = time_once([&] { remap.emplace(each.from, each.to, *layout); });
    const ChartSize size = remap->target_size();
    for (const int channels : {3, 1}) {
      const std::vector<std::uint8_t> source = picture_of(each.from.size, channels);
      std::vector<std::uint8_t> target(static_cast<std::size_t>(size.width * size.height * channels));
      const Timing timing =
          time_jobs({[&] {
                      remap->apply({source.data(), each.from.size.width, each.from.size.height, channels,
                                    static_cast<std::ptrdiff_t>(each.from.size.width) * channels},
                                   {target.data(), size.width, size.height, channels,
                                    static_cast<std::ptrdiff_t>(size.width) * channels});
                    }},
                    15)[0];
      table.row({each.name, std::to_string(channels), fixed(positions.cpu, 3), cpu_cell(timing),
                 fixed(size.width * 1e-6 * size.height / timing.median().cpu, 0)});
    }
  }
}

/// Every pixel the mean of the world itself at 32×32 even steps.
std::vector<float> supersampled(const synth::Radiance& world, const MapFrame& frame) {
  constexpr int kSide = 32;
  const auto [width, height] = frame.size;
  const Matrix3 to_world = transpose(frame.orientation);
  std::vector<float> picture(static_cast<std::size_t>(width * height));
  for (int i = 0; i < width * height; ++i) {
    double sum = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      const double u = (i % width + (k % kSide + 0.5) / kSide) / width;
      const double v = (i / width + (k / kSide + 0.5) / kSide) / height;
      sum += world(to_world * frame.parameterization.to_sphere(0, u, v))[0];
    }
    picture[static_cast<std::size_t>(i)] = static_cast<float>(sum / (kSide * kSide));
  }
  return picture;
}

void zone_plate() {
  heading("A zone plate through a wide lens");
  paragraph(
      "Rings that grow finer toward −Z, down to six texels of a lat-long of 2048×1024, and a picture of "
      "240×135 toward them, "
      "perspective 120°, whose pixels are two and a half to ten texels across: relative RMSE and largest "
      "error against 32×32 points of "
      "the rings themselves in every pixel, and processor milliseconds.");
  const synth::Radiance rings = synth::make("zoneplate", {.frequency = 1024 / (6 * kPi)});
  const Map world = render(rings, sphere::AnyParameterization::make("latlong"), 2048, 1024, {.samples = 8});
  Camera camera = camera_of("perspective", 120, {240, 135});
  camera.rotation = rotation_of({130, 10, 5});
  const MapFrame frame = frame_of(camera);
  std::vector<float> reference;
  const Seconds slow = time_once([&] { reference = supersampled(rings, frame); });
  const Table table({"filter", "rel. RMSE %", "max %", "ms"});
  double squares = 0;
  for (const float value : reference) squares += value * value;
  const double scale = std::sqrt(squares / static_cast<double>(reference.size()));
  for (const Filter filter :
       {Filter::automatic, Filter::lanczos, Filter::bicubic, Filter::bilinear, Filter::nearest}) {
    Map picture = view(world, camera, {.filter = filter});
    const Timing timing =
        time_jobs({[&] { resample(world, picture, {.filter = filter, .borders = false}); }}, 5)[0];
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const int x = static_cast<int>(i) % 240, y = static_cast<int>(i) / 240;
      const double off = picture.level.chart(0).at(x, y)[0] - reference[i];
      error += off * off;
      largest = std::max(largest, std::fabs(off));
    }
    table.row({std::string(name_of(filter)),
               fixed(100 * std::sqrt(error / static_cast<double>(reference.size())) / scale, 3),
               fixed(100 * largest / scale, 2), cpu_milliseconds(timing)});
  }
  paragraph("The points took " + fixed(slow.cpu, 1) + " s.");
}

}  // namespace

int main() {
  const Threads threads;
  pictures();
  cubes();
  bytes();
  zone_plate();
}
