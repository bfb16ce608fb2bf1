#pragma once

#include "welkin/map/map_cases.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/reference.h"

/// What the tests of pre-filtering share.
namespace welkin::prefilter_cases {

using lobe::AnyLobe;
using sphere::AnyParameterization;

/// Sanitizers make brute force ten times slower: every third case is left to them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::size_t kThin = 3;
#else
inline constexpr std::size_t kThin = 1;
#endif

template <class T>
std::vector<T> thinned(const std::vector<T>& cases) {
  std::vector<T> some;
  for (std::size_t i = 0; i < cases.size(); i += kThin) some.push_back(cases[i]);
  return some;
}

/// Dark ground, a bright sky, noise in every texel and a few lamps a hundred times as bright. Channel c is
/// (c + 1) times as bright, but for the noise.
inline Map landscape(const std::string& spec, int width, int height, int channels = 1, unsigned seed = 8) {
  Map map(AnyParameterization::make(spec).at_size(width, height), width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value;
  cases::for_each_valid_texel(map, [&](int chart, int x, int y) {
    const Vec3d d = cases::direction_at(map, chart, x, y);
    const float lamp = value(random) < 0.004f ? 100.0f : 1.0f;
    const float base =
        lamp * static_cast<float>(0.1 + 1 / (1 + std::exp(-6 * d.y)) + 0.5 * std::exp(6 * (d.x - 1)));
    float* texel = map.level.chart(chart).at(x, y);
    for (int c = 0; c < channels; ++c) texel[c] = static_cast<float>(c + 1) * base * (0.5f + value(random));
  });
  fill_borders(map);
  return map;
}

inline Map filled(const std::string& spec, int width, int height, float value, int channels = 1) {
  Map map(AnyParameterization::make(spec).at_size(width, height), width, height, channels);
  cases::for_each_valid_texel(map, [&](int chart, int x, int y) {
    for (int c = 0; c < channels; ++c) map.level.chart(chart).at(x, y)[c] = value;
  });
  fill_borders(map);
  return map;
}

inline PrefilterShape shape_of(const Map& map) {
  return {map.parameterization, {map.width(), map.height()}, map.channels()};
}

/// One level.
inline Map prefiltered(const Map& source, const std::string& target, ChartSize size, const std::string& lobe,
                       const PrefilterOptions& options = {}) {
  return std::move(
      prefilter_map(source, AnyParameterization::make(target), {{size, AnyLobe::make(lobe)}}, options)
          .front());
}

/// Registered lobes at their defaults and others, one so narrow that texels widen it, and a table.
inline std::vector<AnyLobe> lobes() {
  std::vector<AnyLobe> list;
  for (const std::string& name : lobe::lobe_names()) list.push_back(AnyLobe::make(name));
  for (const char* spec : {"ggx,roughness=1", "ggx,roughness=0.2", "ggx,roughness=0.02", "phong,exponent=0.5",
                           "phong,exponent=1000", "charlie,roughness=0.2", "vmf,kappa=0", "vmf,kappa=40"}) {
    list.push_back(AnyLobe::make(spec));
  }
  const double degrees[] = {0, 5, 25, 70}, values[] = {3, 2, 1, 0};
  list.push_back(AnyLobe::from_table("hat", degrees, values));
  return list;
}

struct Errors {
  double relative_rmse = 0, maximum = 0;
};

/// A level against brute force with `lobe` in every `step`-th of its valid texels. Maximum: relative to the
/// reference, taken to be a hundredth of its root mean square at least.
inline Errors errors_of(const Map& level, const PrefilterReference& reference, const AnyLobe& lobe,
                        int step) {
  std::vector<Vec3d> directions;
  std::vector<const float*> texels;
  int index = 0;
  cases::for_each_valid_texel(level, [&](int chart, int x, int y) {
    if (index++ % step != 0) return;
    directions.push_back(cases::direction_at(level, chart, x, y));
    texels.push_back(level.level.chart(chart).at(x, y));
  });
  const std::size_t channels = static_cast<std::size_t>(level.channels());
  std::vector<double> expected(directions.size() * channels);
  reference.evaluate(lobe, directions, expected);
  double squares = 0, error_squares = 0;
  Errors errors;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double error = static_cast<double>(texels[i / channels][i % channels]) - expected[i];
    squares += expected[i] * expected[i];
    error_squares += error * error;
  }
  errors.relative_rmse = std::sqrt(error_squares / squares);
  const double mean = std::sqrt(squares / static_cast<double>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double error = static_cast<double>(texels[i / channels][i % channels]) - expected[i];
    const double relative = std::fabs(error) / std::max(std::fabs(expected[i]), 0.01 * mean);
    errors.maximum = relative <= errors.maximum ? errors.maximum : relative;  // NaN is larger
  }
  return errors;
}

/// body(value) for every channel of every valid texel.
template <class Body>
void for_each_value(const Map& map, const Body& body) {
  cases::for_each_valid_texel(map, [&](int chart, int x, int y) {
    for (int c = 0; c < map.channels(); ++c) body(static_cast<double>(map.level.chart(chart).at(x, y)[c]));
  });
}

}  // namespace welkin::prefilter_cases
