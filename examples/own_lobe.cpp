// A lobe of one's own, and a map filtered with it.
#include <welkin/lobe/custom.h>
#include <welkin/map/map.h>
#include <welkin/plot/draw_lobes.h>
#include <welkin/prefilter/bake.h>
#include <welkin/synth/render_synth.h>

#include <cmath>
#include <cstdio>

namespace {

/// Light from a cap about the axis, all alike: what a camera's wide, flat sensor may see.
struct Cap {
  static constexpr const char* kName = "cap";
  double radius = 0.5;  // radians

  template <class T>
  T weight(T s) const {
    return s <= static_cast<T>(1 - std::cos(radius)) ? T(1) : T(0);  // s = 1 − cos θ
  }
  double width() const { return radius; }
  std::vector<double> breakpoints() const { return {1 - std::cos(radius)}; }
};

}  // namespace

int main() try {
  const welkin::lobe::AnyLobe cap = welkin::lobe::make_lobe(Cap{0.4});
  const double exact = 2 * welkin::kPi * (1 - std::cos(0.4));
  std::printf("solid angle of the cap: %.6f sr, in closed form %.6f\n", cap.integral(), exact);

  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::Map room = welkin::render(welkin::synth::make("room"), latlong, 128, 64);
  welkin::BakeOptions options;
  options.lobe = cap;
  options.size = {32, 32};
  const welkin::Chain chain = welkin::bake(room, options);
  std::printf("%s: %d faces of %d\n", chain.notes.lobe.c_str(), chain.levels[0].charts(),
              chain.levels[0].width());

  // Without a struct: values at angles in degrees, linear between them.
  const double degrees[] = {0, 20, 25}, values[] = {1, 1, 0};
  const welkin::lobe::AnyLobe both[] = {cap, welkin::lobe::AnyLobe::from_table("soft cap", degrees, values)};
  const welkin::Image plot = welkin::draw_lobes(both, {});
  std::printf("plotted %d pixels wide\n", plot.width());
} catch (const std::exception& error) {
  std::fprintf(stderr, "own_lobe: %s\n", error.what());
  return 1;
}
