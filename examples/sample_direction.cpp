// Prints the radiance that comes from a direction, one value per channel: sample_direction MAP X Y Z
#include <welkin/filter/sampler.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
  if (argc != 5) return std::fprintf(stderr, "usage: sample_direction MAP X Y Z\n"), 2;
  const welkin::Sampler sampler(welkin::read_map(argv[1]).map, {.filter = welkin::Filter::bicubic});
  const welkin::Vec3d direction{std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
  if (!(welkin::dot(direction, direction) > 0)) return std::fprintf(stderr, "X Y Z is not a direction\n"), 2;
  std::vector<float> radiance(static_cast<std::size_t>(sampler.channels()));
  sampler.look_up(direction, radiance);
  for (const float value : radiance) std::printf("%.9g\n", static_cast<double>(value));
} catch (const std::exception& error) {
  std::fprintf(stderr, "sample_direction: %s\n", error.what());
  return 1;
}
