// Work that tells how far it is, and that can be stopped.
#include <welkin/base/error.h>
#include <welkin/prefilter/bake.h>
#include <welkin/synth/render_synth.h>

#include <atomic>
#include <cstdio>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::Map room = welkin::render(welkin::synth::make("room"), latlong, 512, 256);

  // Both are called from the threads that work, so what they touch is atomic.
  std::atomic<int> percent{0};
  std::atomic<bool> stop{false};
  welkin::Monitor monitor;
  monitor.progress = [&](double fraction) { percent = static_cast<int>(100 * fraction); };
  monitor.cancelled = [&] { return stop.load(); };

  welkin::bake(room, {}, monitor);
  std::printf("baked to %d %%\n", percent.load());

  // A user who cancels halfway.
  monitor.progress = [&](double fraction) { stop = fraction > 0.5; };
  try {
    welkin::bake(room, {}, monitor);
  } catch (const welkin::Cancelled&) {
    std::puts("cancelled");
    return 0;
  }
  std::puts("not cancelled");
  return 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "progress_and_cancel: %s\n", error.what());
  return 1;
}
