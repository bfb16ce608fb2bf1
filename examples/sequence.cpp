// A plan made once and used for every frame of a sequence.
#include <welkin/map_file/chain_file.h>
#include <welkin/prefilter/bake.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  welkin::BakeOptions options;
  options.size = {64, 64};
  // All that depends on sizes and lobes alone. It never changes: threads may share it.
  const welkin::BakePlan plan({latlong, {128, 64}, 3}, options);
  for (int frame = 0; frame < 4; ++frame) {
    welkin::synth::SynthOptions sun;
    sun.azimuth = 15.0 * frame;
    const welkin::Map sky = welkin::render(welkin::synth::make("sky", sun), latlong, 128, 64);
    char name[32];
    std::snprintf(name, sizeof name, "frame-%04d.ktx2", frame);
    welkin::write_chain(name, plan.run(sky));
    std::printf("%s: %zu levels\n", name, plan.levels().size());
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "sequence: %s\n", error.what());
  return 1;
}
