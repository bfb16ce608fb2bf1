// How near look-ups over Gaussian cones are to the exact mean, and what they cost, beside trilinear ones.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "harness.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/gaussian_cases.h"
#include "welkin/lookup/gaussian_stack.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr const char* kNames[] = {"sun", "room", "checker"};
constexpr double kWidest = 20 * kPi / 180;

/// Cones from a texel wide on, half of those of the sun aimed within 2σ of it.
std::vector<EllipticalCone> cones_of(std::size_t count, double texel, double aspect, bool sun,
                                     unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> along;
  std::uniform_real_distribution<double> share(0, 1);
  const synth::SynthOptions options;
  const double up = options.elevation * kPi / 180, round = options.azimuth * kPi / 180;
  const Vec3d at{std::cos(up) * std::sin(round), std::sin(up), std::cos(up) * std::cos(round)};
  std::vector<EllipticalCone> cones(count);
  for (std::size_t i = 0; i < count; ++i) {
    EllipticalCone& cone = cones[i];
    const double narrow = texel * std::pow(std::max(1.01, kWidest / aspect / texel), share(random));
    cone.narrow = static_cast<float>(narrow);
    cone.wide = static_cast<float>(narrow * aspect);
    cone.direction = {along(random), along(random), along(random)};
    cone.axis = {along(random), along(random), along(random)};
    if (!sun || i % 2 == 1) continue;
    const Vec3d off = normalize(Vec3d{cone.direction.x, cone.direction.y, cone.direction.z});
    const Vec3d d = at + (2 * narrow * aspect * share(random)) * off;
    cone.direction = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  return cones;
}

struct Errors {
  double squares = 0, largest = 0;
  std::size_t count = 0;

  void add(double got, double wanted, double mean) {
    const double error = std::fabs(got - wanted) / std::max(std::fabs(wanted), 0.1 * mean);
    squares += error * error;
    largest = std::max(largest, error);
    ++count;
  }
  std::string cell() const {
    return fixed(100 * std::sqrt(squares / static_cast<double>(count)), 3) + " / " + fixed(100 * largest, 2);
  }
};

/// What is compared: fills radiance of cones.
using LookUp = std::function<void(std::size_t map, std::span<const EllipticalCone>, std::span<float>)>;
struct Way {
  std::string name;
  LookUp look_up;
};

void measure(const char* parameterization, int width, int height) {
  std::vector<Map> maps;
  std::vector<std::unique_ptr<test::GaussianReference>> references;
  for (const char* name : kNames) {
    maps.push_back(
        render(synth::make(name), sphere::AnyParameterization::make(parameterization), width, height));
    references.push_back(std::make_unique<test::GaussianReference>(maps.back()));
  }
  const double texel = references[0]->texel();
  const double source = static_cast<double>(maps[0].charts()) * width * height * 3 * sizeof(float);

  heading(std::string("Gaussian cones in a ") + parameterization + " of " + std::to_string(width) + "×" +
          std::to_string(height));
  std::vector<std::vector<GaussianStack>> stacks(2);
  std::vector<Sampler> samplers;
  for (const Map& map : maps) samplers.push_back(Sampler::borrow(map, {.levels = 0}));
  const Table made({"accuracy", "map", "made in, CPU ms", "wall ms", "memory, × the map's"});
  for (const GaussianAccuracy accuracy : {GaussianAccuracy::percent, GaussianAccuracy::permille}) {
    std::vector<GaussianStack>& of = stacks[accuracy == GaussianAccuracy::permille];
    for (std::size_t m = 0; m < maps.size(); ++m) {
      of.push_back(GaussianStack::borrow(maps[m], {accuracy}));
      const auto timing = time_jobs({[&] { GaussianStack::borrow(maps[m], {accuracy}); }}, 3);
      made.row({accuracy == GaussianAccuracy::permille ? "0.1 %" : "1 %", kNames[m],
                cpu_milliseconds(timing[0]), wall_milliseconds(timing[0]),
                fixed(static_cast<double>(of[m].bytes()) / source, 2)});
    }
  }

  const Way ways[] = {
      {"trilinear",
       [&](std::size_t m, std::span<const EllipticalCone> cones, std::span<float> out) {
         const double last = samplers[m].levels() - 1;
         for (std::size_t i = 0; i < cones.size(); ++i) {
           const double side = std::sqrt(12.0 * cones[i].wide * cones[i].narrow);
           samplers[m].look_up(cones[i].direction, out.subspan(3 * i),
                               std::clamp(std::log2(side / texel), 0.0, last));
         }
       }},
      {"1 %", [&](std::size_t m, auto cones, auto out) { stacks[0][m].look_up(cones, out); }},
      {"0.1 %", [&](std::size_t m, auto cones, auto out) { stacks[1][m].look_up(cones, out); }}};

  const std::size_t compared = static_cast<std::size_t>(std::stoi(setting("WELKIN_BENCH_CONES", "60")));
  constexpr std::size_t kTimed = 4096;
  paragraph(
      "RMS error % / largest %, over the value or a tenth of the map's mean; ns for each cone, one thread, " +
      std::to_string(kTimed) + " cones anywhere at once (best).");
  const Table table({"aspect", "way", "sun", "room", "checker", "all", "ns"});
  for (const double aspect : {1.0, 2.0, 4.0, 16.0}) {
    std::vector<std::vector<EllipticalCone>> cones;
    std::vector<std::vector<std::vector<double>>> wanted(maps.size(),
                                                         std::vector<std::vector<double>>(compared));
    for (std::size_t m = 0; m < maps.size(); ++m) {
      cones.push_back(cones_of(compared, texel, aspect, m == 0, 7));
      parallel_for(static_cast<int>(compared), [&](int i) {
        const std::size_t k = static_cast<std::size_t>(i);
        wanted[m][k] = references[m]->mean(cones[m][k]);
      });
    }
    const std::vector<EllipticalCone> timed = cones_of(kTimed, texel, aspect, false, 9);
    std::vector<float> out(3 * std::max(kTimed, compared));
    std::vector<std::function<void()>> jobs;
    for (const Way& way : ways) jobs.push_back([&] { way.look_up(1, timed, out); });
    const std::vector<Timing> timings = time_jobs(jobs, 15);
    for (std::size_t w = 0; w < std::size(ways); ++w) {
      std::vector<std::string> cells{fixed(aspect, 0), ways[w].name};
      Errors all;
      for (std::size_t m = 0; m < maps.size(); ++m) {
        Errors errors;
        const std::vector<double> mean = references[m]->mean();
        ways[w].look_up(m, cones[m], out);
        for (std::size_t i = 0; i < compared; ++i) {
          for (std::size_t c = 0; c < 3; ++c) {
            errors.add(out[3 * i + c], wanted[m][i][c], mean[c]);
            all.add(out[3 * i + c], wanted[m][i][c], mean[c]);
          }
        }
        cells.push_back(errors.cell());
      }
      cells.push_back(all.cell());
      cells.push_back(fixed(timings[w].best().cpu * 1e9 / kTimed, 0));
      table.row(cells);
    }
  }
}

}  // namespace

int main() {
  const Threads threads;
  measure("latlong", 1024, 512);
  measure("cube", 296, 296);
}
