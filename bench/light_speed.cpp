// How exactly lights are found in a map, beside EEVEE's method, and how long it takes.

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "eevee_sun.h"
#include "harness.h"
#include "welkin/light/extract.h"
#include "welkin/light/light_cases.h"
#include "welkin/light/region_lights.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using cases::Disc;

constexpr double kSun = 0.53 * kDegree;
constexpr double kSky = 1, kContrast = 1e5;

/// What a threshold of EEVEE's has to be for this sky: it is a radiance, ten by default.
constexpr double kThreshold = 10;

Map plain_sky(const std::string& spec, int width, int height) {
  return render(
      [](const Vec3d&) {
        return std::array<float, 3>{kSky, kSky, kSky};
      },
      sphere::AnyParameterization::make(spec), width, height, {.samples = 1});
}

std::vector<Vec3d> random_directions(int count) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> list;
  for (int i = 0; i < count; ++i)
    list.push_back(normalize(Vec3d{normal(random), normal(random), normal(random)}));
  return list;
}

/// Errors of many suns, one for each.
struct Errors {
  std::vector<double> direction, irradiance, solid_angle;

  void add(const Vec3d& found, double e, double omega, const Disc& disc) {
    direction.push_back(angle_between(found, disc.direction) / kDegree);
    irradiance.push_back(100 * std::fabs(e / disc.irradiance() - 1));
    solid_angle.push_back(100 * std::fabs(omega / disc.solid_angle() - 1));
  }
};

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}
std::string both(const std::vector<double>& values, int digits) {
  return values.empty() ? "–" : fixed(median_of(values), digits) + " / " + fixed(largest(values), digits);
}

void accuracy(const std::string& spec, int width, int height, int count, const Table& table) {
  const Map sky = plain_sky(spec, width, height);
  Errors ours, theirs;
  double energy = 0, left = 0;
  int unmeasurable = 0, missed = 0;
  for (const Vec3d& d : random_directions(count)) {
    Map map = sky.clone();
    const Disc disc{d, kSun, kContrast * kSky};
    cases::add_disc(map, disc, {1, 1, 1}, 128);
    const Extraction extraction = extract_lights(map);
    const EeveeSun eevee = eevee_sun(map, kThreshold);
    theirs.add(eevee.direction, eevee.irradiance, eevee.solid_angle, disc);
    if (extraction.found.lights.size() != 1) {
      ++missed;
      continue;
    }
    const ExtractedLight& sun = extraction.found.lights.front();
    ours.add(sun.direction, sun.irradiance[0], sun.solid_angle, disc);
    if (sun.shape == LightShape::point) {
      ours.solid_angle.pop_back();
      ++unmeasurable;
    }
    const double rest = cases::energy_of(extraction.residual)[0];
    energy = std::max(energy, std::fabs((rest + sun.irradiance[0]) / cases::energy_of(map)[0] - 1));
    left = std::max(left, cases::largest_value(extraction.residual) / kSky);
  }
  const std::string name = spec + " " + std::to_string(width) + "×" + std::to_string(height);
  const bool good = missed == 0 && largest(ours.direction) <= 0.05 && largest(ours.irradiance) <= 0.2 &&
                    energy <= 1e-5 && (ours.solid_angle.empty() || largest(ours.solid_angle) <= 5);
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", energy);
  table.row({name, "Welkin", both(ours.direction, 4), both(ours.irradiance, 3), both(ours.solid_angle, 2),
             std::to_string(unmeasurable) + " of " + std::to_string(count), text, fixed(left, 2), met(good)});
  table.row({name, "EEVEE", both(theirs.direction, 4), both(theirs.irradiance, 3),
             both(theirs.solid_angle, 2), "–", "–", "–", "–"});
}

void two_suns(double apart, const Table& table) {
  double worst = 0, worst_energy = 0, theirs = 0;
  int missed = 0;
  const Map sky = plain_sky("latlong", 1024, 512);
  const std::vector<Vec3d> places = random_directions(21);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Vec3d aside = normalize(cross(places[i], places[i + 1]));
    const Disc one{places[i], kSun, kContrast},
        two{std::cos(apart * kDegree) * places[i] + std::sin(apart * kDegree) * aside, kSun, kContrast / 2};
    Map map = sky.clone();
    cases::add_disc(map, one);
    cases::add_disc(map, two);
    theirs = std::max(theirs, angle_between(eevee_sun(map, kThreshold).direction, one.direction) / kDegree);
    const auto lights = extract_lights(map).found.lights;
    if (lights.size() != 2) {
      ++missed;
      continue;
    }
    for (const auto& [light, disc] : {std::pair{&lights[0], &one}, {&lights[1], &two}}) {
      worst = std::max(worst, angle_between(light->direction, disc->direction) / kDegree);
      worst_energy = std::max(worst_energy, 100 * std::fabs(light->irradiance[0] / disc->irradiance() - 1));
    }
  }
  table.row({fixed(apart, 1) + "°", std::to_string(missed) + " of 20", fixed(worst, 3),
             fixed(worst_energy, 2), fixed(theirs, 3)});
}

void speed(int width, const Table& table) {
  Map map = render(synth::make("sky"), sphere::AnyParameterization::make("latlong"), width, width / 2,
                   {.samples = 2});
  cases::add_disc(map, {normalize(Vec3d{0.2, 0.5, 0.6}), kSun, kContrast}, {1, 1, 1}, 4);
  RegionOptions median;
  median.method = RegionMethod::median_cut;
  const auto timings = time_jobs({[&] { extract_lights(map); }, [&] { region_lights(map); },
                                  [&] { region_lights(map, median); }, [&] { map.clone(); }},
                                 11);
  const std::string size = std::to_string(width) + "×" + std::to_string(width / 2);
  const char* names[] = {"extract_lights", "region_lights, 64, variance", "region_lights, 64, median cut",
                         "a copy of the map"};
  for (std::size_t i = 0; i < timings.size(); ++i) {
    const bool counts = i == 0 && width == 1024;
    table.row({size, names[i], cpu_milliseconds(timings[i]), wall_milliseconds(timings[i]),
               counts ? "≤ 20 ms" : "", counts ? met(timings[i].median().wall <= 0.020) : ""});
  }
}

}  // namespace

int main() {
  const Threads threads;
  heading("Lights: how exactly they are found");
  paragraph(
      "A sun of 0.53° and 10⁵ on a sky of 1, at random places, each texel its mean. Errors, median / "
      "largest: of "
      "the direction, degrees; of the irradiance and the solid angle, percent, the latter of those that the "
      "texels show. *Energy* is how far lights and residual together are from the map; *left* is the "
      "residual's brightest texel. EEVEE's formulas are applied to the same texels.");
  {
    const Table table({"map", "method", "direction, °", "irradiance, %", "solid angle, %", "not measurable",
                       "energy", "left", "met"});
    accuracy("latlong", 1024, 512, 200, table);
    accuracy("latlong", 2048, 1024, 50, table);
    accuracy("cube", 256, 256, 50, table);
    accuracy("octahedral", 1024, 1024, 50, table);
  }
  heading("Lights: two suns");
  paragraph(
      "Two such suns, the second half as bright, in a lat-long of 1024×512: how often they aren't found as "
      "two, "
      "and the largest errors of either. EEVEE's is that of its one direction from the first.");
  {
    const Table table({"apart", "missed", "direction, °", "irradiance, %", "EEVEE, direction, °"});
    for (const double apart : {1.2, 1.5, 2.0, 5.0, 60.0}) two_suns(apart, table);
  }
  heading("Lights: how long it takes");
  paragraph("A built-in sky with a sun, RGB float, in memory.");
  {
    const Table table({"map", "work", "CPU ms", "wall ms", "target", "met"});
    speed(1024, table);
    speed(4096, table);
  }
}
