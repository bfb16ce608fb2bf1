#include "welkin/sphere/parameterization_cases.h"

#include <algorithm>

namespace welkin::sphere::cases {
namespace {

/// A parameterization with its one parameter set.
template <class P, int kParameter>
struct With : P {
  With() : P(kParameter) {}
};

/// A frame in which everything is set: an aspect of 1.6, a shift, vertical or diagonal field of view. Of
/// radial lenses the rim crosses it.
template <class P, int kFov, bool kDiagonal, int kRim = 0>
struct Shifted : P {
  Shifted() {
    (kDiagonal ? this->dfov : this->vfov) = kFov;
    this->ratio = 1.6;
    this->right = 0.21;
    this->up = -0.13;
    if (kRim > 0) this->rim = kRim;
    this->shape = {0.7, kDiagonal ? 0.4 : 0.0};
    this->update();
  }
};

template <class P>
class Of : public Case {
 public:
  explicit Of(std::size_t index) {
    name = P::kName;
    std::replace(name.begin(), name.end(), '-', '_');
    name += "_" + std::to_string(index);
    kind = P::kName;
    charts = P::kCharts;
    coverage = p_.coverage();
    density_by_row = traits_of<P>().density_by_row;
  }

  Vec3d to_sphere(int chart, double u, double v) const override { return p_.to_sphere(chart, u, v); }
  Vec3<float> to_sphere(int chart, float u, float v) const override { return p_.to_sphere(chart, u, v); }
  Vec3<Pack> to_sphere(int chart, const Pack& u, const Pack& v) const override {
    return p_.to_sphere(chart, u, v);
  }

  ChartPoint<double> from_sphere(const Vec3d& d) const override { return p_.from_sphere(d); }
  ChartPoint<float> from_sphere(const Vec3<float>& d) const override { return p_.from_sphere(d); }
  ChartPoint<Pack> from_sphere(const Vec3<Pack>& d) const override { return p_.from_sphere(d); }

  bool covers(const Vec3d& d) const override { return p_.covers(d); }
  bool covers(const Vec3<float>& d) const override { return p_.covers(d); }
  Mask<Pack> covers(const Vec3<Pack>& d) const override { return p_.covers(d); }

  bool valid(int chart, double u, double v) const override { return p_.valid(chart, u, v); }
  Mask<Pack> valid(int chart, const Pack& u, const Pack& v) const override { return p_.valid(chart, u, v); }

  double solid_angle_density(int chart, double u, double v) const override {
    return p_.solid_angle_density(chart, u, v);
  }
  float solid_angle_density(int chart, float u, float v) const override {
    return p_.solid_angle_density(chart, u, v);
  }
  Pack solid_angle_density(int chart, const Pack& u, const Pack& v) const override {
    return p_.solid_angle_density(chart, u, v);
  }

 private:
  P p_;
};

using All = std::vector<std::unique_ptr<const Case>>;

template <class... P>
void append(TypeList<P...>, All& all) {
  (all.push_back(std::make_unique<Of<P>>(all.size())), ...);
}

using WithParameters =
    TypeList<With<MirrorBall, 5>, With<MirrorBall, 2>, With<FisheyeEquidistant, 220>,
             With<FisheyeEquidistant, 360>, With<FisheyeEquisolid, 220>, With<FisheyeEquisolid, 360>,
             With<FisheyeOrthographic, 120>, With<FisheyeStereographic, 220>, With<FisheyeStereographic, 350>,
             With<Cylinder, 150>, With<Mercator, 120>, Window<-90, 90, 45, -45>, Window<0, 180, 90, -90>,
             Window<90, 270, 60, -20>, Window<-180, 180, 30, -60>, Window<0, 360, 90, -90>,
             Window<37, 38, 61, 60>, Window<-70, 230, 90, 20>, Window<130, 200, -30, -90>, With<Vr180, 220>,
             With<Vr180, 60>, Shifted<Perspective, 70, true>, Shifted<Pannini, 60, false>,
             Shifted<Pannini, 120, true>, Shifted<Cylindrical, 120, true>, Shifted<Stereographic, 240, false>,
             Shifted<Equidistant, 190, false, 230>, Shifted<Equisolid, 330, true, 250>,
             Shifted<Orthographic, 100, false, 150>, With<Perspective, 150>, With<Pannini, 300>,
             With<Cylindrical, 360>, With<Equidistant, 360>>;

}  // namespace

const All& all_cases() {
  static const All all = [] {
    All made;
    append(AllParameterizations(), made);
    append(WithParameters(), made);
    return made;
  }();
  return all;
}

}  // namespace welkin::sphere::cases
