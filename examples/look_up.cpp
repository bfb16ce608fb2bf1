// Radiance along one direction, and along a million of them from many threads: look_up MAP
#include <welkin/filter/sampler.h>
#include <welkin/map_file/map_file.h>

#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 2) return std::fprintf(stderr, "usage: look_up MAP\n"), 2;
  const welkin::Sampler sampler(welkin::read_map(argv[1]).map, {.levels = 0});
  const auto channels = static_cast<std::size_t>(sampler.channels());

  // One direction: up, from the finest level, and halfway between the two coarsest.
  std::vector<float> radiance(channels);
  const welkin::Vec3<float> up{0, 1, 0};
  sampler.look_up(up, radiance);
  std::printf("up %g", static_cast<double>(radiance[0]));
  sampler.look_up(up, radiance, std::fmax(0, sampler.levels() - 1.5));
  std::printf(", blurred %g\n", static_cast<double>(radiance[0]));

  // A million, spread evenly over the sphere; every thread looks its share up into its part of the result.
  constexpr std::size_t kCount = 1'000'000, kThreads = 4, kShare = kCount / kThreads;
  std::vector<welkin::Vec3<float>> directions(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double y = 1 - (2 * static_cast<double>(i) + 1) / kCount, r = std::sqrt(1 - y * y),
                 a = 2.399963 * static_cast<double>(i);
    directions[i] = {static_cast<float>(r * std::cos(a)), static_cast<float>(y),
                     static_cast<float>(r * std::sin(a))};
  }
  std::vector<float> all(kCount * channels), again(all);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      sampler.look_up(std::span(directions).subspan(t * kShare, kShare),
                      std::span(all).subspan(t * kShare * channels, kShare * channels));
    });
  }
  for (std::thread& thread : threads) thread.join();
  sampler.look_up(directions, again);
  if (all != again) return std::puts("the threads disagree"), 1;
  double sum = 0;
  for (std::size_t i = 0; i < kCount; ++i) sum += static_cast<double>(all[i * channels]);
  std::printf("mean over the sphere %g\n", sum / kCount);
} catch (const std::exception& error) {
  std::fprintf(stderr, "look_up: %s\n", error.what());
  return 1;
}
