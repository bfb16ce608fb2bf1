// How far each filter of cones is from the cone's own mean, and from what the filter means to compute, in the
// cases that are hard for some; and what it costs.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "cone_kernels.h"
#include "harness.h"
#include "welkin/lookup/cone_reference.h"
#include "welkin/lookup/cone_sampler.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

using Cones = std::vector<EllipticalCone>;
constexpr int kPoints = 2;  ///< along a texel's side, of references

double wide(float x) {
  return static_cast<double>(x);
}

Vec3<float> narrow(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

using LookUp = std::function<void(std::span<const EllipticalCone>, std::span<float>)>;

/// A line of the tables. Whatever looks cones up can be one.
struct Method {
  std::string name;
  std::function<LookUp(const Map&)> on;  ///< on a map, which outlives it; nothing where it can't
  OwnMean own;
};

Method method(const std::string& name, const ConeSamplerOptions& options, OwnMean own) {
  return {name,
          [options](const Map& map) -> LookUp {
            if (!is_usable(options.filter, map.parameterization)) return {};
            return [sampler = ConeSampler::borrow(map, options)](std::span<const EllipticalCone> cones,
                                                                 std::span<float> radiance) {
              sampler.look_up(cones, radiance);
            };
          },
          std::move(own)};
}

std::vector<Method> all_methods() {
  return {method("nearest", {.filter = ConeFilter::nearest}, {}),
          method("bilinear", {.filter = ConeFilter::bilinear}, {}),
          method("differential", {.filter = ConeFilter::differential}, own_longer_side),
          method("mirrored", {.filter = ConeFilter::mirrored}, own_longer_side),
          method("trilinear", {.filter = ConeFilter::trilinear}, own_trilinear),
          method("box", {.filter = ConeFilter::box}, own_box),
          method("sat, 1 box", {.filter = ConeFilter::sat, .boxes = 1}, own_boxes(1)),
          method("sat, 3 boxes", {.filter = ConeFilter::sat, .boxes = 3}, own_boxes(3)),
          method("probes, 16", {.filter = ConeFilter::probes, .probes = 16}, own_probes),
          method("hybrid", {.filter = ConeFilter::hybrid}, own_ewa),
          method("ewa", {.filter = ConeFilter::ewa}, own_ewa),
          method("gaussian, 1 %", {.filter = ConeFilter::gaussian}, own_cone),
          method("gaussian, 0.1 %", {.filter = ConeFilter::gaussian, .accuracy = GaussianAccuracy::permille},
                 own_cone)};
}

using Scene = std::function<double(const Vec3d&)>;

/// Means of 4×4 points a texel.
Map rendered(const char* spec, int width, int height, const Scene& scene) {
  Map map(sphere::AnyParameterization::make(spec), width, height, 3);
  const auto& p = map.parameterization;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int k = 0; k < 16; ++k) {
          sum +=
              scene(p.to_sphere(chart, (x + (k % 4 + 0.5) / 4) / width, (y + (k / 4 + 0.5) / 4) / height)) /
              16;
        }
        float* texel = map.level.chart(chart).at(x, y);
        for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(sum * (1 + 0.1 * c));
      }
    }
  }
  fill_borders(map);
  return map;
}

/// A floor of squares one below the eye, under a sky that darkens upwards.
double checker_floor(const Vec3d& d) {
  if (d.y >= -1e-3) return 1 - 0.7 * d.y;
  const double x = std::floor(d.x / -d.y), z = std::floor(d.z / -d.y);
  return std::fmod(std::fabs(x + z), 2.0) < 0.5 ? 0.02 : 0.8;
}

/// Bright sky over dark ground: an edge, and clouds.
double horizon(const Vec3d& d) {
  const double clouds = 0.3 * std::sin(23 * d.x + 5 * d.z) * std::sin(19 * d.z - 7 * d.y);
  return d.y > 0 ? 2 + clouds : 0.05 + 0.1 * clouds * clouds;
}

const Vec3d kSun = direction_at(35, 40);

double sun(const Vec3d& d) {
  return 0.3 + 0.2 * d.y + (angle_between(d, kSun) < 0.5 * kSunDiameter * kDegree ? 1e5 : 0);
}

/// Detail everywhere.
double detail(const Vec3d& d) {
  return 1 + 0.4 * std::sin(41 * d.x + 9 * d.y) + 0.3 * std::sin(37 * d.y - 11 * d.z) +
         0.25 * std::sin(53 * d.z + 17 * d.x);
}

struct Case {
  std::string name;
  Map map;
  Cones cones;
  std::vector<std::vector<double>> truth;
  double mean;
};

constexpr int kCones = 48;
/// Of a case, that are compared with a filter's own kernel.
constexpr std::size_t kOwn = 16;

/// A cone whose axis turns `angle` from straight up.
EllipticalCone cone_at(const Vec3d& direction, double angle, double sigma, double aspect) {
  const Vec3d d = normalize(direction);
  const Vec3d up = std::fabs(d.y) < 0.999 ? normalize(Vec3d{0, 1, 0} - d.y * d) : Vec3d{1, 0, 0};
  const Vec3d axis = std::cos(angle) * up + std::sin(angle) * cross(d, up);
  return {narrow(d), narrow(axis), static_cast<float>(sigma * aspect), static_cast<float>(sigma)};
}

Case make_case(std::string name, Map map, const std::function<EllipticalCone(std::mt19937&)>& draw) {
  std::mt19937 random(1);
  Cones cones;
  for (int i = 0; i < kCones; ++i) cones.push_back(draw(random));
  std::vector<std::vector<double>> truth;
  for (const EllipticalCone& cone : cones) truth.push_back(look_up_reference(map, cone, kPoints));
  const double mean = weighted_mean(
      map, [](const Vec3d&) { return 1.0; }, 1)[0];
  return {std::move(name), std::move(map), std::move(cones), std::move(truth), mean};
}

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  cases.push_back(make_case("horizon", rendered("cube", 296, 296, horizon), [](std::mt19937& random) {
    // Seen by a mirror at grazing angles: tall and thin.
    return cone_at(direction_at(uniform(random, 0, 360), uniform(random, -4, 4)), uniform(random, -0.2, 0.2),
                   uniform(random, 0.5, 1.0) * kDegree, uniform(random, 8, 16));
  }));
  cases.push_back(
      make_case("checker floor", rendered("cube", 296, 296, checker_floor), [](std::mt19937& random) {
        return cone_at(direction_at(uniform(random, 0, 360), uniform(random, -60, -5)),
                       uniform(random, 0, kPi), uniform(random, 0.5, 2.0) * kDegree, uniform(random, 1, 4));
      }));
  cases.push_back(make_case("sun", rendered("cube", 296, 296, sun), [](std::mt19937& random) {
    const double sigma = uniform(random, 1, 4) * kDegree;
    const TangentPlane plane(kSun);
    const double turn = uniform(random, 0, 2 * kPi), away = uniform(random, 0, 2.5) * sigma;
    return cone_at(plane.exponential({away * std::cos(turn), away * std::sin(turn)}), uniform(random, 0, kPi),
                   sigma, uniform(random, 1, 4));
  }));
  cases.push_back(make_case("fold", rendered("octahedral", 724, 724, detail), [](std::mt19937& random) {
    // The lower hemisphere's edges: x or z = 0.
    const double along = uniform(random, -0.95, 0.95), off = uniform(random, -0.02, 0.02);
    const double down = -std::sqrt(1 - along * along);
    return cone_at(random() % 2 == 0 ? Vec3d{along, down, off} : Vec3d{off, down, along},
                   uniform(random, 0, kPi), uniform(random, 0.5, 1.5) * kDegree, uniform(random, 1, 4));
  }));
  cases.push_back(make_case("pole", rendered("latlong", 1024, 512, detail), [](std::mt19937& random) {
    const double up = random() % 2 == 0 ? 1 : -1;
    return cone_at(direction_at(uniform(random, 0, 360), up * uniform(random, 84, 90)),
                   uniform(random, 0, kPi), uniform(random, 0.5, 1.5) * kDegree, uniform(random, 1, 4));
  }));
  return cases;
}

double mean_of(const Map& map) {
  return weighted_mean(
      map, [](const Vec3d&) { return 1.0; }, 1)[0];
}

/// Relative to a value, but at least to a tenth of the map's mean.
struct Errors {
  double square = 0, largest = 0;
  int count = 0;

  void add(double got, double want, double mean) {
    const double error = std::fabs(got - want) / std::max(std::fabs(want), 0.1 * mean);
    square += error * error;
    largest = std::max(largest, error);
    ++count;
  }
  std::string cell() const {
    const double rms = 100 * std::sqrt(square / count);
    return fixed(rms, rms < 10 ? 2 : 0) + " / " + fixed(100 * largest, largest < 0.1 ? 2 : 0);
  }
};

std::vector<float> looked_up(const LookUp& look_up, const Cones& cones, int channels) {
  std::vector<float> radiance(cones.size() * static_cast<std::size_t>(channels));
  look_up(cones, radiance);
  return radiance;
}

std::string nanoseconds(const LookUp& look_up, const Cones& cones, int channels) {
  Cones many;
  while (many.size() < 1024) many.insert(many.end(), cones.begin(), cones.end());
  std::vector<float> radiance(many.size() * static_cast<std::size_t>(channels));
  // As many at once as take some milliseconds.
  const double once = time_once([&] { look_up({many.data(), 16}, radiance); }).cpu / 16;
  const std::size_t count =
      std::clamp<std::size_t>(static_cast<std::size_t>(0.004 / std::max(once, 1e-9)), 16, many.size());
  const Timing timing = time_jobs({[&] { look_up({many.data(), count}, radiance); }}, 9)[0];
  return fixed(timing.best().cpu / static_cast<double>(count) * 1e9, 0);
}

std::vector<std::string> columns_of(const std::vector<Case>& cases) {
  std::vector<std::string> columns{"filter"};
  for (const Case& each : cases) columns.push_back(each.name);
  return columns;
}

/// A row for each method, a cell for each case that it can be used on.
void print_table(const std::vector<Case>& cases, const std::vector<Method>& methods,
                 const std::function<std::string(const Case&, const Method&, const LookUp&)>& cell) {
  const Table table(columns_of(cases));
  for (const Method& each : methods) {
    std::vector<std::string> row{each.name};
    for (const Case& scene : cases) {
      const LookUp look_up = each.on(scene.map);
      row.push_back(look_up ? cell(scene, each, look_up) : "–");
    }
    table.row(row);
  }
}

/// Of the first `count` cones, against `truth` of each.
std::string errors_of(const Case& scene, const LookUp& look_up, std::size_t count,
                      const std::function<double(std::size_t)>& truth) {
  const auto radiance = looked_up(look_up, scene.cones, 3);
  Errors errors;
  for (std::size_t i = 0; i < count; ++i) errors.add(wide(radiance[3 * i]), truth(i), scene.mean);
  return errors.cell();
}

void print_errors(const std::vector<Case>& cases, const std::vector<Method>& methods) {
  heading("Look-ups over cones");
  paragraph(
      "Maps of half a million texels, RGB: the horizon, the floor and the sun on a cube of 296, the fold on "
      "an octahedron "
      "of 724, the pole on a lat-long of 1024×512; " +
      std::to_string(kCones) +
      " cones in each. The error against the mean over the cone in float64, as a part of it but at least of "
      "a tenth of "
      "the map's mean: root mean square % / largest %.\n");
  print_table(cases, methods, [](const Case& scene, const Method&, const LookUp& look_up) {
    return errors_of(scene, look_up, scene.cones.size(), [&](std::size_t i) { return scene.truth[i][0]; });
  });
}

void print_own_errors(const std::vector<Case>& cases, const std::vector<Method>& methods) {
  paragraph(
      "\nThe same against each filter's own kernel in float64, which is what it would be at its best: "
      "circles "
      "of the same area (trilinear) or as wide as the longer side (differential, mirrored), squares and "
      "rectangles of the map's texels (box, sat), a row of circles (probes), the Gaussian of the logarithm "
      "map (ewa, hybrid).\n");
  std::vector<Method> with_kernel;
  for (const Method& each : methods) {
    if (each.own) with_kernel.push_back(each);
  }
  print_table(cases, with_kernel, [](const Case& scene, const Method& method, const LookUp& look_up) {
    return errors_of(scene, look_up, kOwn,
                     [&](std::size_t i) { return method.own(scene.map, scene.cones[i])[0]; });
  });
}

void print_times(const std::vector<Case>& cases, const std::vector<Method>& methods) {
  paragraph("\nNanoseconds of processor time for one, among many, one thread, the best of nine runs.\n");
  print_table(cases, methods, [](const Case& scene, const Method&, const LookUp& look_up) {
    return nanoseconds(look_up, scene.cones, 3);
  });
}

/// What a cone's width does to the cost.
void print_wide_cones(const std::vector<Method>& methods) {
  paragraph(
      "\nNanoseconds by the σ of isotropic cones anywhere, on the lat-long and the cube of the same scenes. "
      "Filters that "
      "read levels don't grow with the cone.\n");
  const double degrees[] = {0.5, 1, 2, 4, 8, 16, 32, 64, 128};
  std::vector<std::string> columns{"map", "filter"};
  for (const double each : degrees) columns.push_back("σ " + fixed(each, each < 1 ? 1 : 0) + "°");
  const Table table(columns);
  const Map maps[] = {rendered("latlong", 1024, 512, detail), rendered("cube", 296, 296, detail)};
  for (const Map& map : maps) {
    for (const Method& each : methods) {
      if (each.name == "nearest" || each.name == "bilinear") continue;
      const LookUp look_up = each.on(map);
      if (!look_up) continue;
      std::vector<std::string> row{map.parameterization.name(), each.name};
      for (const double sigma : degrees) {
        std::mt19937 random(2);
        std::normal_distribution<double> along;
        Cones cones;
        for (int i = 0; i < 64; ++i) {
          cones.push_back(isotropic_cone({along(random), along(random), along(random)}, sigma * kDegree));
        }
        row.push_back(nanoseconds(look_up, cones, 3));
      }
      table.row(row);
    }
  }
}

/// Every parameterization alike.
void print_parameterizations(const std::vector<Method>& methods) {
  paragraph(
      "\nCones of σ 2°, of 2° × 8° in brackets, in any direction, on maps of 130,000 texels of every shape "
      "that shows the "
      "whole world, detail everywhere: root mean square error against the mean over the cone, %.\n");
  std::vector<std::string> columns{"map"};
  for (const Method& each : methods) columns.push_back(each.name);
  const Table table(columns);
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = sphere::AnyParameterization::make(name);
    if (!p.whole_world()) continue;
    const double side = std::sqrt(131072.0 / p.charts());
    const Map map = rendered(name.c_str(), static_cast<int>(side * std::sqrt(p.aspect())),
                             static_cast<int>(side / std::sqrt(p.aspect())), detail);
    const double mean = mean_of(map);
    std::vector<std::string> row{name};
    std::vector<std::string> cells(methods.size());
    for (const double aspect : {1.0, 4.0}) {
      std::mt19937 random(3);
      std::normal_distribution<double> along;
      Cones cones;
      for (int i = 0; i < 40; ++i) {
        cones.push_back(cone_at({along(random), along(random), along(random)}, uniform(random, 0, kPi),
                                2 * kDegree, aspect));
      }
      std::vector<double> truth;
      for (const EllipticalCone& cone : cones) truth.push_back(look_up_reference(map, cone, kPoints)[0]);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        const LookUp look_up = methods[m].on(map);
        if (!look_up) {
          cells[m] = "–";
          continue;
        }
        const auto radiance = looked_up(look_up, cones, 3);
        Errors errors;
        for (std::size_t i = 0; i < cones.size(); ++i) errors.add(wide(radiance[3 * i]), truth[i], mean);
        const double rms = 100 * std::sqrt(errors.square / errors.count);
        const std::string text = fixed(rms, 2);
        cells[m] += aspect == 1 ? text : " (" + text + ")";
      }
    }
    row.insert(row.end(), cells.begin(), cells.end());
    table.row(row);
  }
}

}  // namespace

/// lookup_errors [errors | times | own | wide | shapes]: all of it, or a part.
int main(int argc, char** argv) {
  const Threads threads;
  const std::vector<Method> methods = all_methods();
  const std::string part = argc > 1 ? argv[1] : "";
  const auto wanted = [&](const char* name) { return part.empty() || part == name; };
  if (wanted("errors") || wanted("times") || wanted("own")) {
    const std::vector<Case> cases = all_cases();
    if (wanted("errors")) print_errors(cases, methods);
    if (wanted("times")) print_times(cases, methods);
    if (wanted("own")) print_own_errors(cases, methods);
  }
  if (wanted("wide")) print_wide_cones(methods);
  if (wanted("shapes")) print_parameterizations(methods);
}
