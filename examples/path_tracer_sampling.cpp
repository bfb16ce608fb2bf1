// Irradiance as a path tracer estimates it, with directions drawn by the map, by the cosine, and by both:
// path_tracer_sampling MAP
#include <welkin/filter/sampler.h>
#include <welkin/light/importance.h>
#include <welkin/map_file/map_file.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace {

using welkin::Vec3d;

struct Estimate {
  double sum = 0, squares = 0;
  int count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(std::fmax(squares / count - mean() * mean(), 0)); }
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return std::fprintf(stderr, "usage: path_tracer_sampling MAP\n"), 2;
  const auto map = std::make_shared<const welkin::Map>(welkin::read_map(argv[1]).map);
  // The tables count light as it is looked up below: bilinearly.
  const welkin::ImportanceSampler lights(*map, {.look_up = welkin::Filter::bilinear});
  const welkin::ImportanceSampler bright(*map, {.compensate = true, .look_up = welkin::Filter::bilinear});
  const welkin::Sampler radiance(map);

  // A floor, seen from above: normal +Y. Green light from a direction, times the cosine.
  const auto arriving = [&](const Vec3d& d) {
    return d.y > 0 ? static_cast<double>(radiance.rgb(d)[1]) * d.y : 0;
  };
  const auto cosine_pdf = [](const Vec3d& d) { return d.y > 0 ? d.y / welkin::kPi : 0; };
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto draw_cosine = [&] {
    const double r = std::sqrt(uniform(random)), a = 2 * welkin::kPi * uniform(random);
    return Vec3d{r * std::cos(a), std::sqrt(1 - r * r), r * std::sin(a)};
  };
  const auto draw_light = [&](const welkin::ImportanceSampler& sampler) {
    const double u = uniform(random);
    return sampler.draw(u, uniform(random));
  };

  Estimate by_light, by_cosine, by_both;
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const welkin::ImportanceDraw light = draw_light(lights);
    by_light.add(arriving(light.direction) / light.pdf);
    const Vec3d d = draw_cosine();
    by_cosine.add(arriving(d) / cosine_pdf(d));
    // Balance heuristic: one of two techniques, each half of the time. The compensated table leaves what is
    // dim to the cosine.
    const Vec3d e = i % 2 == 0 ? draw_light(bright).direction : draw_cosine();
    by_both.add(arriving(e) / (0.5 * bright.pdf(e) + 0.5 * cosine_pdf(e)));
  }

  // The exact value, by a fine grid of directions.
  double exact = 0;
  constexpr int kRows = 1024;
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < 2 * kRows; ++i) {
      // Steps of equal solid angle over the upper half.
      const double y = (j + 0.5) / kRows, r = std::sqrt(1 - y * y), a = welkin::kPi * (i + 0.5) / kRows;
      exact += arriving({r * std::cos(a), y, r * std::sin(a)}) * 2 * welkin::kPi / (2.0 * kRows * kRows);
    }
  }
  std::printf("exact irradiance      %.5g\n", exact);
  bool right = true;
  for (const auto& [name, estimate] : {std::pair{"drawn by the map", &by_light},
                                       {"by the cosine", &by_cosine},
                                       {"by both, compensated", &by_both}}) {
    const double error = estimate->deviation() / std::sqrt(kDraws);
    std::printf("%-21s %.5g ± %.2g\n", name, estimate->mean(), error);
    right = right && std::fabs(estimate->mean() - exact) < 5 * error + 2e-3 * exact;
  }
  return right ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "path_tracer_sampling: %s\n", error.what());
  return 1;
}
