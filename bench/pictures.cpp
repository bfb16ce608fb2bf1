#include "pictures.h"

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "harness.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"
#include "welkin/map_file/map_file.h"
#include "welkin/synth/render_synth.h"

namespace welkin::bench {
namespace {

/// 0…1, evenly spread: the finaliser of splitmix64 (Steele, Lea & Flood 2014) of the position.
float noise(std::uint64_t position) {
  std::uint64_t z = position + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24f;
}

Map latlong(int width, int height) {
  return Map(sphere::AnyParameterization::make("latlong"), width, height, 3);
}

std::uint64_t position(const Map& map, int x, int y) {
  return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(map.width()) +
         static_cast<std::uint64_t>(x);
}

/// texel(x, y, values of its three channels) for every texel, then borders.
template <class Texel>
void fill(Map& map, const Texel& texel) {
  parallel_for(map.height(), [&](int y) {
    for (int x = 0; x < map.width(); ++x) texel(x, y, map.level.chart(0).at(x, y));
  });
  fill_borders(map);
}

/// Brightens and darkens every texel by up to `part`.
void add_grain(Map& map, float part) {
  fill(map, [&](int x, int y, float* to) {
    const float factor = 1 + part * (2 * noise(position(map, x, y)) - 1);
    for (int c = 0; c < 3; ++c) to[c] *= factor;
  });
}

}  // namespace

Map noise_picture(int width, int height) {
  Map map = latlong(width, height);
  fill(map, [&](int x, int y, float* to) {
    for (std::uint64_t c = 0; c < 3; ++c) to[c] = noise(3 * position(map, x, y) + c);
  });
  return map;
}

Map aliasing_patterns(int width) {
  Map map = latlong(width, width / 2);
  fill(map, [&](int x, int y, float* to) {
    const double dx = x + 0.5 - 0.5 * width, dy = y + 0.5 - 0.25 * width;
    to[0] = static_cast<float>(0.5 + 0.5 * std::cos(kPi * (dx * dx + dy * dy) / width));
    to[1] = static_cast<float>((x / 5 + y / 5) % 2);
    to[2] = x % 64 < 3 ? 1.0f : 0.0f;
  });
  return map;
}

HighDynamicRange high_dynamic_range() {
  const std::string file = setting("WELKIN_BENCH_HDRI");
  if (!file.empty()) {
    const std::string name = std::filesystem::path(file).filename().string();
    return {name, name == "forest.exr", read_map(file).map};
  }
  HighDynamicRange made{
      "built-in studio with noise", false,
      render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), 1024, 512)};
  add_grain(made.map, 0.1f);
  return made;
}

Map detailed_picture(int width) {
  const HighDynamicRange coarse = high_dynamic_range();
  Map fine = latlong(width, width / 2);
  resample(coarse.map, fine);
  add_grain(fine, 0.05f);
  return fine;
}

}  // namespace welkin::bench
