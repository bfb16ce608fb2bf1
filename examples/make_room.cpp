// Renders a built-in world into a file, for the other examples to read: make_room OUT
#include <welkin/map_file/map_file.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) return std::fprintf(stderr, "usage: make_room OUT\n"), 2;
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  welkin::write_map(argv[1], welkin::render(welkin::synth::make("room"), latlong, 256, 128));
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_room: %s\n", error.what());
  return 1;
}
