// Sets for engines: what the whole takes, from a map in memory to the files' bytes, and what of it is
// encoding.

#include <cstdint>
#include <cstdio>
#include <string>

#include "harness.h"
#include "pictures.h"
#include "welkin/lighting_set/lighting_set.h"
#include "welkin/lighting_set/manifest.h"
#include "welkin/lighting_set/page.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace

int main() {
  const Threads threads;
  const HighDynamicRange hdri = high_dynamic_range();
  std::printf(
      "\n## Sets\n\nFrom %s in memory (%d×%d) to all files of the general set, faces of 256, as BC6H + zstd "
      "by `--quality`: CPU seconds, "
      "warm, median of rounds (best). *Plain*: the files alone. *Told*: with what other texels would take "
      "and lose. *Page*: with the manifest "
      "and the page too. *Encoding*: of the plain set, storing the specular chain, on the clock.\n\n",
      hdri.name.c_str(), hdri.map.width(), hdri.map.height());
  const Table table({"quality", "plain", "told", "page", "encoding"});
  for (const auto& [word, quality] :
       {std::pair{"fast", TextureQuality::fast}, {"normal", TextureQuality::normal}}) {
    SetOptions plain;
    plain.quality = quality;
    plain.compare_formats = false;
    SetOptions told = plain;
    told.compare_formats = true;
    double encoding = 0;
    const auto timings = time_jobs(
        {[&] { encoding = make_lighting_set(hdri.map, engines().front(), plain).files[0].encoding_seconds; },
         [&] { make_lighting_set(hdri.map, engines().front(), told); },
         [&] {
           const LightingSet set = make_lighting_set(hdri.map, engines().front(), told);
           manifest_text(set, {});
           page_text(set, {});
         }},
        5);
    const auto cell = [](const Timing& timing) {
      return text("%.3f", timing.median().cpu) + text(" (%.3f)", timing.best().cpu);
    };
    table.row({word, cell(timings[0]), cell(timings[1]), cell(timings[2]), text("%.3f", encoding)});
  }
}
