// BC6H: how far blocks are from what was given, and how long they take, on one thread.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "harness.h"
#include "pictures.h"
#include "welkin/filter/resample.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/synth/render_synth.h"
#include "welkin/texture/bc6h.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kFace = 256;

struct Errors {
  double rmsle = 0, relative = 0;
};

/// Against the picture clamped to what halves hold.
Errors errors_of(const Map& map, TextureQuality quality, std::vector<std::byte>& blocks) {
  Errors errors;
  std::size_t count = 0;
  Image decoded(map.width(), map.height(), 3);
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<const float> picture = map.level.chart(chart);
    encode_bc6h(picture, quality, blocks);
    decode_bc6h(blocks, false, decoded.view());
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < 3 * map.width(); ++i, ++count) {
        const double a = std::clamp(static_cast<double>(picture.row(y)[i]), 0.0, 65504.0),
                     b = static_cast<double>(decoded.view().row(y)[i]);
        errors.rmsle += std::pow(std::log1p(a) - std::log1p(b), 2);
        errors.relative += std::pow((b - a) / (a + 0.01), 2);
      }
    }
  }
  return {std::sqrt(errors.rmsle / static_cast<double>(count)),
          std::sqrt(errors.relative / static_cast<double>(count))};
}

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

void measure(const Table& table, const std::string& name, const Map& map) {
  std::vector<std::byte> blocks(bc6h_bytes(map.width(), map.height()));
  const double texels = 1e-6 * map.charts() * map.width() * map.height();
  for (const auto& [word, quality] : {std::pair{"fast", TextureQuality::fast},
                                      {"normal", TextureQuality::normal},
                                      {"best", TextureQuality::best}}) {
    const Errors errors = errors_of(map, quality, blocks);
    const Timing timing = time_jobs({[&map, &blocks, quality = quality] {
                                      for (int chart = 0; chart < map.charts(); ++chart)
                                        encode_bc6h(map.level.chart(chart), quality, blocks);
                                    }},
                                    3)[0];
    table.row({name, word, text("%.5f", errors.rmsle), text("%.5f", errors.relative),
               text("%.3f", timing.median().cpu / texels) + text(" (%.3f)", timing.best().cpu / texels)});
  }
}

}  // namespace

int main() {
  const Threads one(1);
  std::printf(
      "\n## BC6H\n\nCubes of 6×%d as blocks of BC6H, by `--quality`. *RMSLE*: of ln(v + 1). *Relative*: rms "
      "of the difference over v + "
      "0.01. One thread; CPU seconds for a million texels.\n\n",
      kFace);
  const Table table({"picture", "quality", "RMSLE", "relative", "CPU s"});
  const HighDynamicRange hdri = high_dynamic_range();
  Map cube(sphere::AnyParameterization::make("cube"), kFace, kFace, 3);
  resample(hdri.map, cube);
  measure(table, hdri.name, cube);
  measure(table, hdri.name + ", ggx of roughness ⅛",
          prefilter_map(hdri.map, sphere::AnyParameterization::make("cube"),
                        {{{kFace, kFace}, lobe::AnyLobe::make("ggx,roughness=0.125")}})[0]);
  for (const char* world : {"studio", "sky"}) {
    measure(table, world,
            render(synth::make(world), sphere::AnyParameterization::make("cube"), kFace, kFace, {2}));
  }
}
