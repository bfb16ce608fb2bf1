#include "lighting.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>

#include "harness.h"
#include "pictures.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/synth/render_synth.h"

namespace welkin::bench {
namespace {

constexpr int kWidth = 1024;

Map render_lighting(const synth::Radiance& radiance) {
  return render(radiance, sphere::AnyParameterization::make("latlong"), kWidth, kWidth / 2);
}

NamedMap sun(double elevation, const std::string& where) {
  synth::SynthOptions options;
  options.angle = 0.5;
  options.intensity = 1e5;
  options.background = 0.1;
  options.elevation = elevation;
  return {"sun of 0.5°, 1e5 on 0.1, " + where, render_lighting(synth::make("sun", options))};
}

/// 5e5 where a square of 7° about a direction 30° above +Z is seen, 1 elsewhere.
NamedMap soft_box() {
  const Vec3d front{0, 0.5, std::sqrt(0.75)}, right{1, 0, 0}, up{0, std::sqrt(0.75), -0.5};
  const double half = std::tan(3.5 * kPi / 180);
  return {"soft box of 7°, contrast 5e5", render_lighting([=](const Vec3d& d) {
            const double depth = dot(d, front);
            const bool lit =
                std::fabs(dot(d, right)) <= half * depth && std::fabs(dot(d, up)) <= half * depth;
            const float value = lit ? 5e5f : 1.0f;
            return std::array<float, 3>{value, value, value};
          })};
}

struct Texel {
  int chart, x, y;
};

struct ComparedTexels {
  std::vector<Texel> texels;  ///< the random ones first
  std::size_t random;
};

ComparedTexels compared_texels(const Map& level) {
  std::vector<Texel> all;
  for (int chart = 0; chart < level.charts(); ++chart) {
    for (int y = 0; y < level.height(); ++y) {
      for (int x = 0; x < level.width(); ++x) all.push_back({chart, x, y});
    }
  }
  ComparedTexels compared;
  std::sample(all.begin(), all.end(), std::back_inserter(compared.texels), 300, std::mt19937(1));
  compared.random = compared.texels.size();
  const std::ptrdiff_t hot = std::min<std::ptrdiff_t>(100, static_cast<std::ptrdiff_t>(all.size()));
  const auto brightness = [&](const Texel& p) {
    const float* values = level.level.chart(p.chart).at(p.x, p.y);
    return std::accumulate(values, values + level.channels(), 0.0f);
  };
  std::partial_sort(all.begin(), all.begin() + hot, all.end(),
                    [&](const Texel& a, const Texel& b) { return brightness(a) > brightness(b); });
  compared.texels.insert(compared.texels.end(), all.begin(), all.begin() + hot);
  return compared;
}

}  // namespace

Map lighting_picture(int width) {
  Map map = high_dynamic_range().map;
  if (map.width() == width && map.height() == width / 2) return map;
  return detailed_picture(width);
}

std::vector<NamedMap> built_in_lighting() {
  std::vector<NamedMap> maps;
  for (const char* name : {"studio", "sky", "room", "lamps", "sun"}) {
    maps.push_back({name, render_lighting(synth::make(name))});
  }
  return maps;
}

std::vector<NamedMap> hostile_lighting() {
  std::vector<NamedMap> maps;
  maps.push_back(sun(40, "40° high"));
  maps.push_back(sun(0, "on the horizon"));
  maps.push_back(sun(89.9, "at the pole"));
  maps.push_back(soft_box());
  maps.push_back({"3000 lamps, range e⁸", render_lighting(synth::make("lamps"))});
  return maps;
}

std::vector<PrefilterLevel> ggx_chain(int face, int levels) {
  const lobe::AnyLobe ggx = lobe::AnyLobe::make("ggx");
  std::vector<PrefilterLevel> chain;
  for (int k = 0; k < levels; ++k) {
    chain.push_back({chain_size({face, face}, k), ggx.with_roughness(k / std::max(1.0, levels - 1.0))});
  }
  return chain;
}

PrefilterShape shape_of(const Map& map) {
  return {map.parameterization, {map.width(), map.height()}, map.channels()};
}

LevelErrors errors_of(const PrefilterReference& reference, const Map& level, const lobe::AnyLobe& lobe) {
  const auto [texels, random] = compared_texels(level);
  const std::size_t channels = static_cast<std::size_t>(level.channels());
  const Matrix3 to_world = transpose(level.orientation);
  std::vector<Vec3d> directions;
  std::vector<double> omega;
  for (const Texel& p : texels) {
    const double u = (p.x + 0.5) / level.width(), v = (p.y + 0.5) / level.height();
    directions.push_back(to_world * level.parameterization.to_sphere(p.chart, u, v));
    omega.push_back(level.parameterization.solid_angle_density(p.chart, u, v));
  }
  std::vector<double> wanted(texels.size() * channels);
  reference.evaluate(lobe, directions, wanted);
  LevelErrors errors;
  double error_squares = 0, squares = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const float* values = level.level.chart(texels[i].chart).at(texels[i].x, texels[i].y);
    double error = 0, size = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const double right = wanted[i * channels + c], wrong = static_cast<double>(values[c]) - right;
      error += wrong * wrong;
      size += right * right;
    }
    if (i < random) {
      error_squares += omega[i] * error;
      squares += omega[i] * size;
    }
    errors.maximum = std::max(errors.maximum, std::sqrt(error / size));
  }
  errors.relative_rmse = std::sqrt(error_squares / squares);
  return errors;
}

std::string errors_cell(const LevelErrors& errors) {
  return percent(errors.relative_rmse) + " / " + percent(errors.maximum);
}

std::string percent(double part) {
  const double value = 100 * part;
  return fixed(value, value < 0.1 ? 4 : value < 10 ? 2 : 1);
}

}  // namespace welkin::bench
