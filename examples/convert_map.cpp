// Converts a map of any kind to a cube: convert_map IN OUT
#include <welkin/filter/resample.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: convert_map IN OUT\n"), 2;
  const welkin::LoadedMap input = welkin::read_map(argv[1]);
  welkin::Map cube(welkin::sphere::AnyParameterization::make("cube"), 256, 256, input.map.channels());
  welkin::resample(input.map, cube);
  welkin::write_map(argv[2], cube);
} catch (const std::exception& error) {
  std::fprintf(stderr, "convert_map: %s\n", error.what());
  return 1;
}
