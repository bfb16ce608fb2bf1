// Light over cones of a map, round and elliptical, with a chosen error: gaussian_look_up MAP
#include <welkin/lookup/gaussian_stack.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 2) return std::fprintf(stderr, "usage: gaussian_look_up MAP\n"), 2;
  const welkin::GaussianStack stack(welkin::read_map(argv[1]).map,
                                    {.accuracy = welkin::GaussianAccuracy::percent});
  std::printf("%.1f MB of levels, from σ = %.4f radians on\n", static_cast<double>(stack.bytes()) * 1e-6,
              stack.narrowest());

  // One cone: what a rough floor shows of the horizon is spread far up and down, and little to the sides.
  const welkin::EllipticalCone horizon{
      .direction = {0, 0.1f, 1}, .axis = {0, 1, 0}, .wide = 0.3f, .narrow = 0.03f};
  std::vector<float> radiance(static_cast<std::size_t>(stack.channels()));
  stack.look_up(horizon, radiance);
  std::printf("towards the horizon %g\n", static_cast<double>(radiance[0]));

  // Many at once, which is faster: from a sharp one to one that sees nearly everything.
  std::vector<welkin::EllipticalCone> cones;
  for (const float sigma : {0.0f, 0.01f, 0.1f, 1.0f}) cones.push_back({{0, 1, 0}, {}, sigma, sigma});
  std::vector<float> all(cones.size() * radiance.size());
  stack.look_up(cones, all);
  for (std::size_t i = 0; i < cones.size(); ++i) {
    std::printf("up, σ = %g: %g\n", static_cast<double>(cones[i].narrow),
                static_cast<double>(all[i * radiance.size()]));
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "gaussian_look_up: %s\n", error.what());
  return 1;
}
