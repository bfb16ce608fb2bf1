// A parameterization that only this program knows: converted to and from, baked, plotted, written and read.
#include <welkin/welkin.h>

#include <cmath>
#include <cstdio>

namespace {

/// Lambert's azimuthal equal-area projection of the whole sphere onto a disc, +Y in the middle.
struct LambertAzimuthal {
  static constexpr const char* kName = "lambert-azimuthal";
  static constexpr int kCharts = 1;
  double aspect() const { return 1; }
  double coverage() const { return 4 * welkin::kPi; }

  template <class T>
  welkin::Vec3<T> to_sphere(int, T u, T v) const {
    // With (x, z) in the unit disc, r² = x² + z² and cos θ = 1 − 2r²; past the rim it goes on around.
    const T x = T(2) * u - T(1), z = T(2) * v - T(1), r2 = x * x + z * z;
    const T k = T(2) * std::sqrt(welkin::max(T(1) - r2, T(0)));
    return normalize(welkin::Vec3<T>{k * x, T(1) - T(2) * r2, k * z});
  }
  template <class T>
  welkin::sphere::ChartPoint<T> from_sphere(const welkin::Vec3<T>& d) const {
    const welkin::Vec3<T> n = normalize(d);
    // r = sin(θ/2); at −Y, where no direction is left, any point of the rim will do.
    const T r = std::sqrt(welkin::max((T(1) - n.y) / T(2), T(0))), level = std::sqrt(n.x * n.x + n.z * n.z);
    const T scale = level > T(0) ? r / level : T(0);
    const T x = level > T(0) ? n.x * scale : r;
    return {T(0), (x + T(1)) / T(2), (n.z * scale + T(1)) / T(2)};
  }
  template <class T>
  T solid_angle_density(int, T, T) const {
    return T(16);  // 4π over the disc's area of π/4
  }
  template <class T>
  bool valid(int, T u, T v) const {
    const T x = T(2) * u - T(1), z = T(2) * v - T(1);
    return x * x + z * z <= T(1);
  }
  template <class T>
  bool covers(const welkin::Vec3<T>&) const {
    return true;
  }
};

}  // namespace

int main() try {
  const auto mine = welkin::sphere::register_parameterization<LambertAzimuthal>();
  const auto cube = welkin::sphere::AnyParameterization::make("cube");
  const welkin::Map room = welkin::render(welkin::synth::make("room"), cube, 64, 64);

  // Converted to and from.
  welkin::Map disc(mine, 160, 160, 3), back(cube, 64, 64, 3);
  welkin::resample(room, disc);
  welkin::resample(disc, back);
  std::printf("there and back: relative RMSE %.3f\n", welkin::compare(room, back).all.relative_rmse);

  // Baked, and plotted: it is equal-area.
  welkin::BakeOptions options;
  options.target = mine;
  options.size = {64, 64};
  options.levels = 3;
  std::printf("baked %zu levels\n", welkin::bake(disc, options).levels.size());
  const welkin::DensityReport density = welkin::density_of(mine, 64);
  std::printf("density: largest over least %.3f\n", density.limit_ratio);
  const welkin::Image plot = welkin::draw_density(mine, density);

  // Written and read: the file says what it is, and the name is known now.
  welkin::io::MemorySink sink;
  welkin::write_map(sink, "exr", disc);
  const welkin::LoadedMap read = welkin::read_map(sink.bytes(), "disc.exr");
  std::printf("read again as %s, %s\n", read.info.shape->text().c_str(), read.info.reason.c_str());
  return plot.empty() || !(read.map.parameterization == mine);
} catch (const std::exception& error) {
  std::fprintf(stderr, "own_parameterization: %s\n", error.what());
  return 1;
}
