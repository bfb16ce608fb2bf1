#include <cmath>

#include "welkin/base/error.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/sphere_pictures.h"
#include "welkin/render/shading/texture_coordinates.h"
#include "welkin/render/trace/texture.h"

namespace welkin::scene {
namespace {

/// `matcap` and the sketches: a picture of a ball, looked up by the normal or the reflected direction in the
/// eye's frame, over what a pixel covers of it.
class SphereMapShading : public Shading {
 public:
  SphereMapShading(Texture texture, const ShadingOptions& options)
      : texture_(std::move(texture)), to_eye_(options.to_eye), reflected_(options.reflected_coordinates) {}

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const SphereMapPlace middle = place(at.normal, at.view);
      const auto change = [&](const Vec3d& dn, const Vec3d& dv) -> std::array<double, 2> {
        const SphereMapPlace there = place(at.normal + dn, at.view + dv);
        return {there[0] - middle[0], there[1] - middle[1]};
      };
      const auto value = texture_.mean(middle, change(at.normal_change.right, at.view_change.right),
                                       change(at.normal_change.down, at.view_change.down));
      radiance[i] = {value[0], value[1], value[2]};
    }
  }

 private:
  SphereMapPlace place(const Vec3d& normal, const Vec3d& view) const {
    const Vec3d n = to_eye_ * normalize(normal);
    return reflected_ ? sphere_map_of_reflection(n, to_eye_ * normalize(view)) : sphere_map_of_normal(n);
  }

  Texture texture_;
  Matrix3 to_eye_;
  bool reflected_;
};

}  // namespace

std::unique_ptr<Shading> make_matcap(const Worlds&, const ShadingOptions& options) {
  if (!options.picture) throw Error(ErrorKind::bad_request, "a matcap needs its picture of a ball");
  require(options.picture->width() == options.picture->height(), "a picture of a ball is square");
  std::vector<Image> levels;
  levels.emplace_back(options.picture->width(), options.picture->height(), options.picture->channels());
  copy_pixels(options.picture->view(), levels[0].view());
  return std::make_unique<SphereMapShading>(Texture(std::move(levels)), options);
}

std::unique_ptr<Shading> make_sketch(std::string_view picture, const ShadingOptions& options) {
  return std::make_unique<SphereMapShading>(Texture(sphere_picture(picture)), options);
}

}  // namespace welkin::scene
