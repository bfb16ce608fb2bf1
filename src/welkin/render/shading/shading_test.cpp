#include "welkin/render/shading/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "welkin/base/error.h"
#include "welkin/brdf/brdf.h"
#include "welkin/render/render_cases.h"
#include "welkin/render/shading/sphere_pictures.h"
#include "welkin/render/shading/texture_coordinates.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

/// A surface at the origin that faces a viewer.
Surface facing(const Vec3d& normal, const Vec3d& view, const Material& material) {
  Surface at{};
  at.normal = at.flat_normal = normalize(normal);
  at.view = normalize(view);
  at.tangent = {1, 0, 0};
  at.bitangent = {0, 1, 0};
  at.material = point_of(material);
  return at;
}

Rgb shaded(const Shading& shading, const Surface& at) {
  Rgb radiance{};
  shading.shade({&at, 1}, {&radiance, 1});
  return radiance;
}

World constant_world(float value) {
  Map map(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = -kBorder; y < 32 + kBorder; ++y)
    for (int x = -kBorder; x < 64 + kBorder; ++x) std::fill_n(map.level.chart(0).at(x, y), 3, value);
  return World(std::move(map));
}

// White furnace: what a white material sends back of light from everywhere is that light, for metals to what
// Fdez-Agüera's estimate of multiple scattering is good for, and never more.
TEST(MaterialShading, WhiteMaterialsKeepTheLight) {
  const World world = constant_world(1);
  const auto shading = make_shading("material", {world});
  for (const float metallic : {0.0f, 1.0f}) {
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f}) {
      for (const double slope : {0.0, 0.5, 1.0, 1.4}) {
        Material material;
        material.metallic = metallic;
        material.roughness = roughness;
        const Rgb seen = shaded(*shading, facing({0, 0, 1}, {std::sin(slope), 0, std::cos(slope)}, material));
        EXPECT_NEAR(seen[0], 1, 2e-3) << metallic << " " << roughness << " " << slope;
      }
    }
  }
}

TEST(MaterialShading, EmissionAndCoatAreAdded) {
  const World world = constant_world(0);
  const auto shading = make_shading("material", {world});
  Material material;
  material.emission = {3, 2, 1};
  EXPECT_EQ(shaded(*shading, facing({0, 0, 1}, {0, 0, 1}, material)), (Rgb{3, 2, 1}));
  material.clearcoat = 1;
  EXPECT_NEAR(shaded(*shading, facing({0, 0, 1}, {0, 0, 1}, material))[0], 3 * 0.96, 1e-5);
}

// The two combinations of Heidrich & Seidel 1999, §3.1, in a world of one radiance: F + 1 and 1.
TEST(Fresnel, CombinesReflectionWithDiffuseLight) {
  const World world = constant_world(1);
  ShadingOptions options;
  options.fresnel = Fresnel::add;
  Material material;
  const Surface at = facing({0, 0, 1}, {0, 0, 1}, material);
  EXPECT_NEAR(shaded(*make_shading("mirror", {world}, options), at)[0], 1.04, 1e-4);
  EXPECT_NEAR(shaded(*make_shading("phong", {world}, options), at)[0], 1.04, 1e-4);
  options.fresnel = Fresnel::share;
  EXPECT_NEAR(shaded(*make_shading("mirror", {world}, options), at)[0], 1, 1e-4);
  options.eta = 200;
  options.fresnel = Fresnel::add;
  EXPECT_NEAR(shaded(*make_shading("mirror", {world}, options), at)[0], 1 + std::pow(199.0 / 201, 2), 1e-4);
}

// dc·D + sc·S: between the diffuse picture and the mirror's.
TEST(Globe, IsBetweenDiffuseAndMirror) {
  const World world(synth_map("studio"));
  Material material;
  const Surface at = facing({0.3, 0.4, 0.5}, {0, 0, 1}, material);
  const Rgb diffuse = shaded(*make_shading("diffuse", {world}), at),
            mirror = shaded(*make_shading("mirror", {world}), at);
  material.metallic = 0.25f;
  const Surface mixed = facing({0.3, 0.4, 0.5}, {0, 0, 1}, material);
  const Rgb globe = shaded(*make_shading("globe", {world}), mixed);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(globe[c], 0.75 * diffuse[c] + 0.25 * mirror[c], 1e-5);
}

// The integral of the BRDF over the map's texels, and what its albedo lacks of 1 as diffuse light.
TEST(Stack, AgreesWithTheIntegralAlongTheNormal) {
  const Map map = synth_map("studio");
  const World world(synth_map("studio"));
  const Vec3d normal = normalize(Vec3d{0.2, 0.3, 0.9}), right = normalize(cross(normal, Vec3d{0, 1, 0})),
              up = cross(right, normal);
  const auto stack = make_shading("stack", {world});
  // Roughnesses that are baked, of lobes wider than a few texels.
  for (const float roughness : {0.35f, 0.6f, 1.0f}) {
    const auto ggx = brdf::AnyBrdf::make("ggx").with_roughness(static_cast<double>(roughness));
    double once = 0, albedo = 0, diffuse = 0;
    for (int y = 0; y < map.height(); ++y) {
      std::vector<float> solid_angles(static_cast<std::size_t>(map.width()));
      texel_solid_angles(map.parameterization, map.width(), map.height(), 0, y, solid_angles.data());
      for (int x = 0; x < map.width(); ++x) {
        const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / map.width(), (y + 0.5) / map.height());
        if (dot(d, normal) <= 0) continue;
        const double part = static_cast<double>(solid_angles[static_cast<std::size_t>(x)]) * dot(d, normal),
                     reflected = ggx.value({0, 0, 1}, {dot(d, right), dot(d, up), dot(d, normal)}) * part;
        const double radiance = *map.level.chart(0).at(x, y);
        once += reflected * radiance;
        albedo += reflected;
        diffuse += radiance * part / kPi;
      }
    }
    Material metal;
    metal.metallic = 1;
    metal.roughness = roughness;
    const double seen = shaded(*stack, facing(normal, normal, metal))[0];
    EXPECT_NEAR(seen, once + (1 - albedo) * diffuse, 0.02 * seen) << roughness;
  }
}

/// What a metal of this colour and roughness sends a viewer at an angle in radians.
float seen_of_metal(const Shading& shading, float base, float roughness, double angle) {
  Material metal;
  metal.metallic = 1;
  metal.base_color = {base, base, base};
  metal.roughness = roughness;
  return shaded(shading, facing({0, 0, 1}, {std::sin(angle), 0, std::cos(angle)}, metal))[0];
}

// White furnace: what GGX's facets scatter more than once is added, of white metals all that was lost.
TEST(Stack, WhiteMetalsKeepTheLight) {
  const World world = constant_world(1);
  ShadingOptions half;
  half.brdf = "ggx,roughness=0.5";
  const auto stack = make_shading("stack", {world}), warped = make_shading("warped", {world}, half);
  for (const double angle : {0.0, 0.7, 1.3}) {
    // Between the roughnesses that were baked, albedo is linear.
    for (const float roughness : {0.0f, 0.35f, 0.5f, 0.8f, 1.0f})
      EXPECT_NEAR(seen_of_metal(*stack, 1, roughness, angle), 1, 0.02) << roughness << " " << angle;
    EXPECT_NEAR(seen_of_metal(*warped, 1, 0.5f, angle), 1, 0.02) << angle;
  }
}

// Along the normal, where Fresnel's factor, which a stack has not, does least.
TEST(Stack, ColouredMetalsAreNearThoseOfMaterial) {
  const World world = constant_world(1);
  const auto stack = make_shading("stack", {world}), material = make_shading("material", {world});
  for (const float roughness : {0.0f, 0.5f, 1.0f})
    EXPECT_NEAR(seen_of_metal(*stack, 0.5f, roughness, 0), seen_of_metal(*material, 0.5f, roughness, 0),
                0.02);
}

// Ward's BRDF isn't one of facets.
TEST(Stack, OthersThanGgxAreAsTheirBrdfSays) {
  const World world = constant_world(1);
  ShadingOptions options;
  options.brdf = "ward,roughness=1";
  const double albedo = seen_of_metal(*make_shading("stack", {world}, options), 1, 1, 0);
  EXPECT_LT(albedo, 0.9);
  EXPECT_GT(albedo, 0.1);
}

// A cone over all elevations sees the table's mean; a narrow one its own elevation.

TEST(Chrome, AveragesOverTheConesElevations) {
  const World world = constant_world(1);
  ShadingOptions options;
  auto table = std::make_shared<Image>(1, 4, 3);
  for (int y = 0; y < 4; ++y) std::fill_n(table->at(0, y), 3, static_cast<float>(y));
  options.picture = table;
  const auto chrome = make_shading("chrome", {world}, options);
  Material material;
  Surface up = facing({0, 1, 0}, {0, 1, 0}, material);
  EXPECT_NEAR(shaded(*chrome, up)[0], 0, 1e-5);
  Surface down = facing({0, -1, 0}, {0, -1, 0}, material);
  EXPECT_NEAR(shaded(*chrome, down)[0], 3, 1e-5);
  Surface wide = facing({0, 0, 1}, {0, 0, 1}, material);
  wide.view_change = {{0, kPi, 0}, {0, 0, 0}};
  EXPECT_NEAR(shaded(*chrome, wide)[0], 1.5, 1e-5);
}

TEST(SpherePictures, HaveLevelsDownToOneTexel) {
  for (const std::string& name : sphere_picture_names()) {
    const std::vector<Image> levels = sphere_picture(name, 64);
    ASSERT_EQ(levels.size(), 7u) << name;
    EXPECT_EQ(levels.back().width(), 1);
    std::set<float> values;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) values.insert(levels[0].at(x, y)[0]);
    EXPECT_GT(values.size(), 2u) << name;
  }
  EXPECT_THROW(sphere_picture("nothing"), Error);
}

/// The width of the black rim along the middle row, in texels.
double rim_of(const Image& level) {
  double dark = 0;
  for (int x = 0; x < level.width() / 2; ++x) dark += 1 - level.at(x, level.height() / 2)[0] / 0.9;
  return dark;
}

// Whatever the level, the rim is as many texels wide, which mean levels' is not.
TEST(SpherePictures, OutlinesHaveOneWidthInEveryLevel) {
  const std::vector<Image> levels = sphere_picture("outline", 256);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(rim_of(levels[k]), rim_of(levels[0]), 0.3) << k;
}

// OpenGL 2.1 specification, §2.11.4: m = 2√(r_x² + r_y² + (r_z + 1)²); t runs up there.
TEST(TextureCoordinates, SphereMapsAgree) {
  const Vec3d view{0, 0, 1};
  for (const double tilt : {0.0, 0.3, 0.7, 1.2}) {
    const Vec3d n{std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt)};
    // To a viewer at infinity the normal that reflects is the normal.
    const SphereMapPlace by_reflection = sphere_map_of_reflection(n, view),
                         by_normal = sphere_map_of_normal(n);
    EXPECT_NEAR(by_reflection[0], by_normal[0], 1e-12);
    EXPECT_NEAR(by_reflection[1], by_normal[1], 1e-12);
  }
}

// Fine triangles: both ways agree. Coarse ones: they don't.
TEST(Reflection, PerVertexTendsToPerPixel) {
  const World world(synth_map("studio"));
  const auto mirror = make_shading("mirror", {world});
  const auto difference = [&](int rows) {
    const TracedScene scene(ball(rows));
    const Image pixel = render(scene, ball_camera(48), world, *mirror);
    const Image vertex =
        render(scene, ball_camera(48), world, *mirror, {.reflection = Reflection::per_vertex});
    double sum = 0;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) sum += std::abs(pixel.at(x, y)[1] - vertex.at(x, y)[1]);
    return sum / (48 * 48);
  };
  const double coarse = difference(8), fine = difference(128);
  EXPECT_GT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 10);
}

// Boxes and spheres: from the centre nothing is corrected; from elsewhere the point that is met is.
TEST(Proxy, ShowsWhatTheRayMeets) {
  Proxy box;
  box.shape = Proxy::Shape::box;
  box.least = {-2, -1, -3};
  box.most = {2, 1, 3};
  const Vec3d d{1, 0.2, 0.3};
  const Vec3d straight = normalize(seen_from(box, {0, 0, 0}, d));
  EXPECT_NEAR(dot(straight, normalize(d)), 1, 1e-12);
  const Vec3d met = seen_from(box, {1, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(met.x, 2, 1e-12);
  Proxy ground;
  ground.shape = Proxy::Shape::ground;
  ground.radius = 100;
  ground.height = 2;
  const Vec3d floor = seen_from(ground, {3, -1, 0}, {0, -1, 0});
  EXPECT_NEAR(floor.x, 3, 1e-12);
  EXPECT_NEAR(floor.y, -2, 1e-12);
  Proxy sphere;
  sphere.shape = Proxy::Shape::sphere;
  sphere.radius = 5;
  EXPECT_NEAR(length(seen_from(sphere, {1, 2, -3}, {0.3, -0.5, 0.2})), 5, 1e-12);
  EXPECT_EQ(seen_from(sphere, {9, 0, 0}, {0, 1, 0}).y, 1);
}

// Each instance looks its own world up.
TEST(Worlds, OfInstances) {
  Worlds worlds{constant_world(1)};
  worlds.own.push_back(constant_world(2));
  worlds.of_instance = {-1, 0};
  const auto mirror = make_shading("mirror", worlds);
  Material material;
  Surface at = facing({0, 0, 1}, {0, 0, 1}, material);
  EXPECT_NEAR(shaded(*mirror, at)[0], 1, 1e-5);
  at.instance = 1;
  EXPECT_NEAR(shaded(*mirror, at)[0], 2, 1e-5);
}

}  // namespace
}  // namespace welkin::scene
