// The world in a wavy floor that is a mirror, every pixel by the cone that it sees: cone_look_up MAP OUT
// [FILTER [ROUGHNESS]]
#include <welkin/io/image_file.h>
#include <welkin/lobe/lobe.h>
#include <welkin/lookup/cone_sampler.h>
#include <welkin/lookup/cone_shapes.h>
#include <welkin/map_file/map_file.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using welkin::Vec3d;

constexpr int kWidth = 480, kHeight = 270;

constexpr int kHorizon = kHeight / 3;

/// What the ray through a point of the picture sees: the sky, or the sky in the floor, one below the eye. Its
/// waves fade with distance, before a pixel sees several of them.
Vec3d seen(double x, double y) {
  const Vec3d ray{(x - kWidth / 2.0) / kWidth, (kHorizon - y) / kWidth, 0.9};
  if (ray.y >= 0) return ray;
  const double far = -1 / ray.y, floor_x = far * ray.x, floor_z = far * ray.z;
  const double height = 0.05 / (1 + far * far / 200);
  const Vec3d normal = welkin::normalize(Vec3d{height * std::cos(2 * floor_x + 0.7 * floor_z), 1,
                                               height * std::sin(1.3 * floor_z - 0.5 * floor_x)});
  return ray - 2 * welkin::dot(ray, normal) * normal;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) return std::fprintf(stderr, "usage: cone_look_up MAP OUT [FILTER [ROUGHNESS]]\n"), 2;
  welkin::ConeSamplerOptions options;
  if (argc > 3) options.filter = welkin::cone_filter_from_name(argv[3]);
  const welkin::ConeSampler sampler(welkin::read_map(argv[1], {.channels = {"R", "G", "B"}}).map, options);

  // A rough mirror blurs every cone by its lobe.
  const std::string roughness = argc > 4 ? argv[4] : "0";
  const double lobe_sigma = welkin::lobe_sigma_of(welkin::lobe::AnyLobe::make("ggx,roughness=" + roughness));

  std::vector<welkin::EllipticalCone> cones;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const welkin::QuadCone pixel{{seen(x, y), seen(x + 1, y), seen(x + 1, y + 1), seen(x, y + 1)}};
      welkin::EllipticalCone cone = welkin::cone_of(pixel);
      if (y >= kHorizon) cone = welkin::blurred(cone, lobe_sigma);
      cones.push_back(cone);
    }
  }
  welkin::Image picture(kWidth, kHeight, 3);
  std::vector<float> radiance(cones.size() * 3);
  sampler.look_up(cones, radiance);
  for (int y = 0; y < kHeight; ++y) {
    for (int i = 0; i < 3 * kWidth; ++i)
      picture.at(0, y)[i] = radiance[static_cast<std::size_t>(3 * kWidth * y + i)];
  }
  const welkin::io::WritePart part{"", picture.view(), {"R", "G", "B"}};
  welkin::io::write(argv[2], {&part, 1});
} catch (const std::exception& error) {
  std::fprintf(stderr, "cone_look_up: %s\n", error.what());
  return 1;
}
