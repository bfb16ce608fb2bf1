// How long spherical harmonics of a map take, in memory, and the round trip through a map.

#include <cmath>
#include <random>

#include "harness.h"
#include "welkin/harmonics/dering.h"
#include "welkin/harmonics/project.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using namespace welkin::harmonics;

Map sky(const char* spec, int width, int height) {
  RenderOptions options;
  options.samples = 1;
  return render(synth::make("sky"), sphere::AnyParameterization::make(spec), width, height, options);
}

void speed_row(const Table& table, const char* spec, int width, int height, int degree,
               const std::string& target) {
  const Map map = sky(spec, width, height);
  const auto timing = time_jobs(
      {[&] { project(map, degree); }, [&] { dering(project(map, degree), irradiance_factors(degree)); }},
      degree > 8 ? 5 : 21);
  table.row({spec, std::to_string(width) + "×" + std::to_string(height), std::to_string(degree),
             cpu_milliseconds(timing[0]), cpu_milliseconds(timing[1]), target});
}

void round_trip_row(const Table& table, const char* spec, int width, int height, int degree) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  SphericalHarmonics wanted(degree, 3);
  for (double& value : wanted.values()) value = normal(random);
  const auto p = sphere::AnyParameterization::make(spec);
  const SphericalHarmonics back = project(map_of(wanted, p, {width, height}), degree);
  double largest = 0;
  for (std::size_t i = 0; i < wanted.values().size(); ++i)
    largest = std::max(largest, std::fabs(back.values()[i] - wanted.values()[i]));
  const auto timing = time_jobs({[&] { map_of(wanted, p, {width, height}); }}, 3);
  char text[40];
  std::snprintf(text, sizeof text, "%.1e", largest / wanted.norm());
  table.row({spec, std::to_string(width) + "×" + std::to_string(height), std::to_string(degree), text,
             cpu_milliseconds(timing[0])});
}

}  // namespace

int main() {
  const Threads threads;
  heading("Spherical harmonics of a map");
  paragraph(
      "R G B in memory, warm; processor milliseconds, median (best). Deringed: `dering` for irradiance, each "
      "channel.");
  const Table speed({"map", "size", "order", "project", "project and dering", "wanted"});
  speed_row(speed, "latlong", 1024, 512, 2, "3");
  speed_row(speed, "latlong", 4096, 2048, 2, "");
  speed_row(speed, "latlong", 1024, 512, 8, "");
  speed_row(speed, "latlong", 1024, 512, 32, "");
  speed_row(speed, "equal-area", 1024, 512, 2, "");
  speed_row(speed, "cube", 256, 256, 2, "");
  speed_row(speed, "octahedral-equal-area", 512, 512, 2, "");
  heading("Order 32 → map → order 32");
  paragraph("Largest difference of a coefficient over the norm of all; random coefficients. Wanted: 1e-5.");
  const Table trips({"map", "size", "order", "difference", "map_of, ms"});
  round_trip_row(trips, "latlong", 256, 128, 32);
  round_trip_row(trips, "cube", 64, 64, 32);
  round_trip_row(trips, "octahedral", 128, 128, 16);
}
