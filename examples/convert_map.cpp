// Converts a map of any kind to a cube: convert_map IN OUT
#include <welkin/filter/resample.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) throw welkin::Error("usage: convert_map IN OUT");
  const welkin::LoadedMap input = welkin::read_map(argv[1]);
  const welkin::MapShape shape = welkin::parse_map_shape("cube:hcross");
  welkin::Map cube(shape.parameterization, 256, 256, input.map.channels());
  welkin::resample(input.map, cube);
  welkin::write_map(argv[2], cube, shape.layout);
} catch (const std::exception& error) {
  std::fprintf(stderr, "convert_map: %s\n", error.what());
  return 1;
}
