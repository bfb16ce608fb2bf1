// How close `auto` comes to exact area sampling when a large map becomes a small one, on patterns that alias
// badly.

#include <algorithm>
#include <array>
#include <cmath>

#include "harness.h"
#include "pictures.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kFace = 256;
constexpr int kStride = 12;    ///< every twelfth texel of a face along both axes is measured
constexpr int kSamples = 128;  ///< squared, to a texel

using Color = std::array<double, 3>;

/// The texel of a lat-long at a position in 0…1.
Color texel_at(const Map& map, double u, double v) {
  const auto inside = [](double position, int size) {
    return std::clamp(static_cast<int>(std::floor(position * size)), 0, size - 1);
  };
  const float* texel = map.level.chart(0).at(inside(u, map.width()), inside(v, map.height()));
  return {static_cast<double>(texel[0]), static_cast<double>(texel[1]), static_cast<double>(texel[2])};
}

/// Sums over the measured texels, each weighted by its solid angle.
struct Sums {
  Color squares{};         ///< of result − exact
  double solid_angle = 0;  ///< sr
  double result_ripple = 0,
         exact_ripple = 0;  ///< squares of the zone plate's difference from ½ where it is fine
  double fine_solid_angle = 0;

  void add(const Sums& other) {
    for (std::size_t c = 0; c < 3; ++c) squares[c] += other.squares[c];
    solid_angle += other.solid_angle;
    result_ripple += other.result_ripple;
    exact_ripple += other.exact_ripple;
    fine_solid_angle += other.fine_solid_angle;
  }
};

Sums measure_texel(const Map& source, const Map& target, int face, int x, int y) {
  const auto &t = target.parameterization, &s = source.parameterization;
  Color sum{};
  double weight = 0;
  bool fine = true;
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const double u = (x + (k % kSamples + 0.5) / kSamples) / kFace,
                 v = (y + (k / kSamples + 0.5) / kSamples) / kFace;
    const double density = t.solid_angle_density(face, u, v);
    const auto position = s.from_sphere(t.to_sphere(face, u, v));
    const Color value = texel_at(source, position.u, position.v);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += density * value[c];
    weight += density;
    const double radius =
        std::hypot((position.u - 0.5) * source.width(), (position.v - 0.5) * source.height());
    fine = fine && radius > source.width() / 8.0;
  }
  Sums sums;
  sums.solid_angle = weight / (kSamples * kSamples) / (kFace * kFace);
  const float* result = target.level.chart(face).at(x, y);
  for (std::size_t c = 0; c < 3; ++c) {
    sums.squares[c] = sums.solid_angle * std::pow(static_cast<double>(result[c]) - sum[c] / weight, 2);
  }
  if (fine) {
    sums.fine_solid_angle = sums.solid_angle;
    sums.result_ripple = sums.solid_angle * std::pow(static_cast<double>(result[0]) - 0.5, 2);
    sums.exact_ripple = sums.solid_angle * std::pow(sum[0] / weight - 0.5, 2);
  }
  return sums;
}

Sums measure(const Map& source, const Map& target) {
  const int rows = (kFace - 1 + kStride - 1) / kStride;
  std::vector<Sums> each(static_cast<std::size_t>(6 * rows));
  parallel_for(6 * rows, [&](int i) {
    for (int x = 1; x < kFace; x += kStride) {
      each[static_cast<std::size_t>(i)].add(
          measure_texel(source, target, i / rows, x, 1 + i % rows * kStride));
    }
  });
  Sums all;
  for (const Sums& sums : each) all.add(sums);
  return all;
}

double psnr(double mean_square) {
  return -10 * std::log10(mean_square);
}

void run_width(int width, const Table& table) {
  const Map source = aliasing_patterns(width);
  Map target(sphere::AnyParameterization::make("cube"), kFace, kFace, 3);
  for (const Filter filter : {Filter::automatic, Filter::lanczos, Filter::bicubic, Filter::bilinear}) {
    ResampleOptions options;
    options.filter = filter;
    const Timing timing = time_jobs({[&] { resample(source, target, options); }})[0];
    const Sums sums = measure(source, target);
    const double n = sums.solid_angle;
    const double all = psnr((sums.squares[0] + sums.squares[1] + sums.squares[2]) / (3 * n));
    const double alias = std::sqrt(sums.result_ripple / sums.fine_solid_angle);
    const double exact = std::sqrt(sums.exact_ripple / sums.fine_solid_angle);
    const bool judged = filter == Filter::automatic && width == 8192;
    table.row({std::to_string(width), std::string(name_of(filter)), fixed(psnr(sums.squares[0] / n), 1),
               fixed(psnr(sums.squares[1] / n), 1), fixed(psnr(sums.squares[2] / n), 1), fixed(all, 1),
               fixed(alias, 4) + " (" + fixed(exact, 4) + ")", cpu_cell(timing), wall_cell(timing),
               judged ? "≥ 50 dB, alias ≤ 0.036, ≤ 0.5 s" : "",
               judged ? met(all >= 50 && alias <= 0.036 && timing.median().cpu <= 0.5) : ""});
  }
}

}  // namespace

int main() {
  const Threads threads;
  heading("Lat-long to a small cube, 6×256: how `auto` filters");
  paragraph(
      "Patterns in texels of the source: a zone plate that reaches the Nyquist frequency at the left and "
      "right edges, a checker of 5×5 "
      "texels, lines 3 texels wide. PSNR (peak 1, weighted by solid angle) is against float64: the mean "
      "of the source's texels, "
      "by 128×128 points in every twelfth texel along both axes of all faces. *Alias* is the rms difference "
      "from ½ "
      "where the zone plate is "
      "finer than ⅛ cycle per texel; exact area sampling leaves some of it too, and that is given in "
      "brackets.");
  const Table table({"source width", "filter", "zone plate, dB", "checker, dB", "lines, dB", "all, dB",
                     "alias (exact)", "CPU s", "wall s", "target", "met"});
  for (const int width : {8192, 2048}) run_width(width, table);
}
