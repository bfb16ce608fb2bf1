// What drawing a direction by a map's light costs, and making the tables.

#include <random>

#include "harness.h"
#include "pictures.h"
#include "welkin/filter/resample.h"
#include "welkin/light/importance.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr std::size_t kNumbers = 65536;
constexpr std::size_t kRun = 4096;
constexpr int kRounds = 64;

struct Case {
  const char* name;
  int width, height;
};
constexpr Case kCases[] = {{"latlong", 1024, 512},
                           {"latlong", 4096, 2048},
                           {"cube", 256, 256},
                           {"octahedral", 640, 640},
                           {"octahedral-equal-area", 1024, 1024},
                           {"paraboloid", 512, 512},
                           {"healpix", 256, 256}};

double nanoseconds(const Timing& timing) {
  return timing.best().cpu / static_cast<double>(kRun) * 1e9;
}

}  // namespace

int main() {
  heading("Importance sampling");
  paragraph(
      "Nanoseconds of processor time for a draw (direction and density) and for the density of a given "
      "direction, one thread, the best of 64 rounds of 4096 random numbers. *Many*: all in one call. "
      "*Making*: milliseconds on the "
      "wall, cdf / alias. The map: the HDRI of the benchmarks, resampled.");
  const HighDynamicRange source = high_dynamic_range();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> a(kNumbers), b(kNumbers);
  for (std::size_t i = 0; i < kNumbers; ++i) {
    a[i] = uniform(random);
    b[i] = uniform(random);
  }
  const Table table(
      {"map", "cdf: draw", "many", "pdf", "alias: draw", "many", "pdf", "making", "target", "met"});
  std::vector<ImportanceDraw> draws(kRun);
  double kept = 0;
  for (const Case& which : kCases) {
    const auto p = sphere::AnyParameterization::make(which.name);
    Map map(p, which.width, which.height, source.map.channels());
    resample(source.map, map);
    std::vector<std::string> row{std::string(which.name) + " " + std::to_string(which.width) + "×" +
                                 std::to_string(which.height)};
    std::string making;
    double slowest = 0;
    for (const ImportanceMethod method : {ImportanceMethod::cdf, ImportanceMethod::alias}) {
      const Timing made =
          time_jobs({[&] { const ImportanceSampler sampler(map, {.method = method}); }}, 3)[0];
      making += (making.empty() ? "" : " / ") + fixed(made.best().wall * 1e3, 0);
      const ImportanceSampler sampler(map, {.method = method});
      std::vector<Vec3d> directions;
      for (std::size_t i = 0; i < kNumbers; ++i) directions.push_back(sampler.draw(a[i], b[i]).direction);
      std::size_t from = 0;
      const auto alone = [&] {
        from = (from + kRun) % kNumbers;
        for (std::size_t i = from; i < from + kRun; ++i) {
          const ImportanceDraw draw = sampler.draw(a[i], b[i]);
          kept += draw.pdf + draw.direction.x;
        }
      };
      const auto many = [&] {
        from = (from + kRun) % kNumbers;
        sampler.draw(std::span(a).subspan(from, kRun), std::span(b).subspan(from, kRun), draws);
        kept += draws[7].pdf;
      };
      const auto density = [&] {
        for (std::size_t i = from; i < from + kRun; ++i) kept += sampler.pdf(directions[i]);
      };
      const auto timings = time_jobs({alone, many, density}, kRounds);
      for (const Timing& timing : timings) row.push_back(fixed(nanoseconds(timing), 1));
      slowest = std::max(slowest, nanoseconds(timings[1]));
    }
    row.insert(row.end(), {making, "many < 100", met(slowest < 100 && kept > 0)});
    table.row(row);
  }
}
