#include "welkin/render/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/render/embree_functions.h"
#include "welkin/render/texture.h"

namespace welkin::scene {
namespace {

constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 31;
/// Rays that are handed to Embree at once.
constexpr std::size_t kStream = 256;

using Float3 = Vec3<float>;

Float3 to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3d to_double(const Float3& v) {
  return {v.x, v.y, v.z};
}

Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double size = length(v);
  return size > 1e-300 ? (1 / size) * v : otherwise;
}

/// Some vector across a unit vector.
Vec3d across(const Vec3d& n) {
  return normalize(std::abs(n.y) < 0.9 ? cross({0, 1, 0}, n) : cross({1, 0, 0}, n));
}

/// An instance's mesh in the world. Embree reads 16 bytes of each vertex, so there is one more than is used.
struct WorldMesh {
  const Mesh* mesh;
  const Material* material;
  std::vector<Float3> positions, normals;
  std::vector<std::array<float, 4>> tangents;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

WorldMesh world_mesh(const Scene& scene, const Instance& instance, const Transform& to) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
  const int material = instance.material >= 0 ? instance.material : mesh.material;
  WorldMesh world{&mesh, &scene.materials[static_cast<std::size_t>(material)], {}, {}, {}, mesh.triangles};
  for (const Float3& p : mesh.positions) world.positions.push_back(to_float(point_to(to, to_double(p))));
  world.positions.push_back({0, 0, 0});
  for (const Float3& n : mesh.normals)
    world.normals.push_back(to_float(normalize(normal_to(to, to_double(n)))));
  for (const auto& t : mesh.tangents) {
    const Vec3d turned = unit_or(to.linear * Vec3d{t[0], t[1], t[2]}, {1, 0, 0});
    world.tangents.push_back(
        {static_cast<float>(turned.x), static_cast<float>(turned.y), static_cast<float>(turned.z), t[3]});
  }
  if (determinant(to.linear) < 0) {
    // A mirrored mesh keeps its front, and what is counterclockwise in its pictures turns round.
    for (auto& triangle : world.triangles) std::swap(triangle[1], triangle[2]);
    for (auto& tangent : world.tangents) tangent[3] = -tangent[3];
  }
  return world;
}

}  // namespace

class TracedScene::State {
 public:
  /// What scenes have in common whose instances stand elsewhere.
  struct Shared {
    explicit Shared(Scene given) : scene(std::move(given)) {
      scene.check();
      for (const Picture& picture : scene.pictures) textures.emplace_back(picture);
    }
    Scene scene;
    std::vector<Texture> textures;
  };

  State(std::shared_ptr<const Shared> given, const std::vector<Transform>& to_world,
        const std::vector<bool>& hidden);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::shared_ptr<const Shared> shared;
  std::vector<WorldMesh> meshes;  // one an instance
  const EmbreeFunctions& rt = embree();
  RTCDevice device = nullptr;
  RTCScene traced = nullptr;
  double largest = 1;  // of all coordinates

  MaterialPoint material_at(const Material& material, const Surface& at,
                            const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
  std::array<float, 4> look_up(const PictureUse& use,
                               const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
  void bend_normal(Surface& at, const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
};

TracedScene::State::State(std::shared_ptr<const Shared> given, const std::vector<Transform>& to_world,
                          const std::vector<bool>& hidden)
    : shared(std::move(given)) {
  const Scene& scene = shared->scene;
  if (triangle_count(scene) > kMostTriangles)
    throw Error(ErrorKind::too_large, "the instances have more than 2³¹ triangles altogether");
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    meshes.push_back(world_mesh(scene, scene.instances[i], to_world[i]));
  for (const WorldMesh& mesh : meshes) {
    for (const Float3& p : mesh.positions)
      largest = std::max<double>({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  device = rt.new_device(nullptr);
  if (device == nullptr) throw Error(ErrorKind::system, "Embree could not start");
  traced = rt.new_scene(device);
  rt.set_scene_flags(traced, RTC_SCENE_FLAG_ROBUST);
  rt.set_scene_build_quality(traced, RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    WorldMesh& mesh = meshes[i];
    if (mesh.triangles.empty() || (i < hidden.size() && hidden[i])) continue;
    RTCGeometry geometry = rt.new_geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rt.set_shared_geometry_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                  mesh.positions.data(), 0, sizeof(Float3), mesh.positions.size() - 1);
    rt.set_shared_geometry_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(),
                                  0, sizeof mesh.triangles[0], mesh.triangles.size());
    rt.commit_geometry(geometry);
    rt.attach_geometry_by_id(traced, geometry, static_cast<unsigned>(i));
    rt.release_geometry(geometry);
  }
  rt.commit_scene(traced);
  const RTCError error = rt.get_device_error(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw Error(ErrorKind::system, "Embree could not take the scene");
}

TracedScene::State::~State() {
  if (traced != nullptr) rt.release_scene(traced);
  if (device != nullptr) rt.release_device(device);
}

std::array<float, 4> TracedScene::State::look_up(const PictureUse& use,
                                                 const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  const auto& set = uv[use.uv_set];
  const double c = std::cos(use.angle), s = std::sin(use.angle);
  const auto turned = [&](const std::array<double, 2>& d) -> std::array<double, 2> {
    const double x = d[0] * use.scale[0], y = d[1] * use.scale[1];
    return {c * x + s * y, -s * x + c * y};
  };
  std::array<double, 2> at = turned(set[0]);
  at[0] += use.offset[0];
  at[1] += use.offset[1];
  return shared->textures[static_cast<std::size_t>(use.picture)].mean(at, turned(set[1]), turned(set[2]));
}

MaterialPoint TracedScene::State::material_at(const Material& material, const Surface&,
                                              const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  MaterialPoint point{&material,         material.base_color, material.emission,     material.alpha,
                      material.metallic, material.roughness,  material.transmission, material.clearcoat};
  const auto times = [](std::array<float, 3>& color, const std::array<float, 4>& by) {
    for (std::size_t c = 0; c < 3; ++c) color[c] *= by[c];
  };
  if (material.base_map) {
    const auto value = look_up(material.base_map, uv);
    times(point.base_color, value);
    point.alpha *= value[3];
  }
  if (material.metallic_roughness_map) {
    const auto value = look_up(material.metallic_roughness_map, uv);
    point.roughness *= value[1];
    point.metallic *= value[2];
  }
  if (material.emission_map) times(point.emission, look_up(material.emission_map, uv));
  if (material.transmission_map) point.transmission *= look_up(material.transmission_map, uv)[0];
  if (material.clearcoat_map) point.clearcoat *= look_up(material.clearcoat_map, uv)[0];
  for (float* share :
       {&point.metallic, &point.roughness, &point.transmission, &point.clearcoat, &point.alpha})
    *share = std::clamp(*share, 0.0f, 1.0f);
  if (material.masked) point.alpha = point.alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
  if (!material.masked && !material.blended) point.alpha = 1;
  return point;
}

void TracedScene::State::bend_normal(Surface& at, const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  const Material& material = *at.material.material;
  const auto value = look_up(material.normal_map, uv);
  const double scale = material.normal_scale;
  const Vec3d bent{scale * (2 * value[0] - 1), scale * (2 * value[1] - 1), 2.0 * value[2] - 1};
  const double size = length(bent);
  if (!(size > 1e-6)) return;
  // Pictures hold unit vectors to a part in 256 or so.
  at.normal_variance = size < 0.995 ? -std::log(size) : 0;
  at.normal = normalize(bent.x * at.tangent + bent.y * at.bitangent + bent.z * at.normal);
}

namespace {

std::vector<Transform> places_of(const Scene& scene) {
  std::vector<Transform> places;
  for (const Instance& instance : scene.instances) places.push_back(instance.to_world);
  return places;
}

}  // namespace

TracedScene::TracedScene(Scene scene) {
  auto shared = std::make_shared<const State::Shared>(std::move(scene));
  state_ = std::make_shared<const State>(shared, places_of(shared->scene), std::vector<bool>());
}

TracedScene TracedScene::moved(const std::vector<Transform>& to_world,
                               const std::vector<bool>& hidden) const {
  require(to_world.size() == scene().instances.size(), "there is a place for each instance");
  for (const Transform& place : to_world) {
    const double volume = determinant(place.linear);
    require(std::isfinite(volume) && volume != 0 && std::isfinite(length(place.origin)),
            "an instance stands somewhere, and has a volume");
  }
  TracedScene other(*this);
  other.state_ = std::make_shared<const State>(state_->shared, to_world, hidden);
  return other;
}

const Scene& TracedScene::scene() const {
  return state_->shared->scene;
}

namespace {

RTCRay embree_ray(const Ray& ray) {
  RTCRay to{};
  to.org_x = ray.origin.x;
  to.org_y = ray.origin.y;
  to.org_z = ray.origin.z;
  to.tnear = ray.near;
  to.dir_x = ray.direction.x;
  to.dir_y = ray.direction.y;
  to.dir_z = ray.direction.z;
  to.tfar = ray.far;
  to.mask = ~0u;
  return to;
}

RTCRayHit embree_ray_hit(const Ray& ray) {
  RTCRayHit both{};
  both.ray = embree_ray(ray);
  both.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  both.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return both;
}

Hit hit_of(const RTCRayHit& both) {
  if (both.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {both.ray.tfar, both.hit.geomID, both.hit.primID,
          both.hit.u,    both.hit.v,      {both.hit.Ng_x, both.hit.Ng_y, both.hit.Ng_z}};
}

}  // namespace

void TracedScene::closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence) const {
  require(hits.size() >= rays.size(), "there is room for a hit of each ray");
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (coherence == Coherence::close) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::array<RTCRayHit, kStream> stream;
  for (std::size_t first = 0; first < rays.size(); first += kStream) {
    const std::size_t count = std::min(kStream, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) stream[i] = embree_ray_hit(rays[first + i]);
    state_->rt.intersect_1m(state_->traced, &context, stream.data(), static_cast<unsigned>(count),
                            sizeof stream[0]);
    for (std::size_t i = 0; i < count; ++i) hits[first + i] = hit_of(stream[i]);
  }
}

Hit TracedScene::closest(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit both = embree_ray_hit(ray);
  state_->rt.intersect_1(state_->traced, &context, &both);
  return hit_of(both);
}

bool TracedScene::occluded(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay traced = embree_ray(ray);
  state_->rt.occluded_1(state_->traced, &context, &traced);
  return traced.tfar < 0;
}

double TracedScene::clearance(const Vec3d& position) const {
  const double size = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
  return 1e-6 * state_->largest + 4e-6 * size;
}

Surface TracedScene::surface(const RaySpread& ray, const Hit& hit, Reflection reflection) const {
  const WorldMesh& mesh = state_->meshes[hit.instance];
  const auto& triangle = mesh.triangles[hit.triangle];
  const Vec3d p0 = to_double(mesh.positions[triangle[0]]);
  const Vec3d e1 = to_double(mesh.positions[triangle[1]]) - p0,
              e2 = to_double(mesh.positions[triangle[2]]) - p0;
  const double b1 = hit.b1, b2 = hit.b2;
  Surface at{};
  at.instance = hit.instance;
  at.position = p0 + b1 * e1 + b2 * e2;
  at.view = -1.0 * ray.direction;
  at.view_change = {-1.0 * ray.direction_change.right, -1.0 * ray.direction_change.down};
  const Vec3d front = unit_or(cross(e1, e2), at.view);
  at.from_behind = dot(front, at.view) < 0;
  const double side = at.from_behind ? -1 : 1;
  at.flat_normal = side * front;

  // The ray's neighbours meet the triangle's plane, and there have weights of the vertices.
  const double facing = dot(front, ray.direction);
  const double g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2), area = g11 * g22 - g12 * g12;
  const auto moved = [&](const Vec3d& origin, const Vec3d& direction) {
    const Vec3d shift = origin + static_cast<double>(hit.distance) * direction;
    return std::abs(facing) > 1e-6 ? shift - (dot(shift, front) / facing) * ray.direction : shift;
  };
  at.position_change = {moved(ray.origin_change.right, ray.direction_change.right),
                        moved(ray.origin_change.down, ray.direction_change.down)};
  const auto weights = [&](const Vec3d& shift) -> std::array<double, 2> {
    if (!(area > 0)) return {0, 0};
    const double s1 = dot(shift, e1), s2 = dot(shift, e2);
    return {(g22 * s1 - g12 * s2) / area, (g11 * s2 - g12 * s1) / area};
  };
  const auto right = weights(at.position_change.right), down = weights(at.position_change.down);

  std::array<std::array<double, 2>, 3> uv[2] = {};  // of each set: the value, its changes right and down
  std::array<double, 2> uv_e1{}, uv_e2{};
  for (std::size_t set = 0; set < 2; ++set) {
    const auto& values = mesh.mesh->uv[set];
    if (values.empty()) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      const double t0 = values[triangle[0]][c], t1 = values[triangle[1]][c] - t0,
                   t2 = values[triangle[2]][c] - t0;
      uv[set][0][c] = t0 + b1 * t1 + b2 * t2;
      uv[set][1][c] = right[0] * t1 + right[1] * t2;
      uv[set][2][c] = down[0] * t1 + down[1] * t2;
      if (set == 0) {
        uv_e1[c] = t1;
        uv_e2[c] = t2;
      }
    }
  }
  at.uv = uv[0][0];
  at.uv_right = uv[0][1];
  at.uv_down = uv[0][2];

  at.normal = at.flat_normal;
  if (!mesh.normals.empty()) {
    const Vec3d n0 = to_double(mesh.normals[triangle[0]]);
    const Vec3d d1 = to_double(mesh.normals[triangle[1]]) - n0,
                d2 = to_double(mesh.normals[triangle[2]]) - n0;
    const Vec3d sum = n0 + b1 * d1 + b2 * d2;
    const double size = length(sum);
    if (size > 1e-3) {
      const Vec3d n = (1 / size) * sum;
      const auto change = [&](const std::array<double, 2>& by) {
        const Vec3d whole = (side / size) * (by[0] * d1 + by[1] * d2);
        return whole - dot(n, whole) * n;
      };
      at.normal = side * n;
      at.normal_change = {change(right), change(down)};
    }
  }
  if (reflection == Reflection::per_vertex && !mesh.normals.empty()) {
    Vec3d sum{0, 0, 0};
    const double weight[] = {1 - b1 - b2, b1, b2};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d n = side * to_double(mesh.normals[triangle[k]]);
      const Vec3d v = unit_or(ray.origin - to_double(mesh.positions[triangle[k]]), at.view);
      sum = sum + weight[k] * (2 * dot(n, v) * n - v);
    }
    at.normal = unit_or(unit_or(sum, at.normal) + at.view, at.normal);
  }

  const double det = uv_e1[0] * uv_e2[1] - uv_e1[1] * uv_e2[0];
  Vec3d along = across(at.normal), other = {0, 0, 0};
  double handed = 1;
  if (!mesh.tangents.empty()) {
    const auto& t0 = mesh.tangents[triangle[0]];
    const auto& t1 = mesh.tangents[triangle[1]];
    const auto& t2 = mesh.tangents[triangle[2]];
    const auto mixed = [&](std::size_t c) { return t0[c] + b1 * (t1[c] - t0[c]) + b2 * (t2[c] - t0[c]); };
    along = {mixed(0), mixed(1), mixed(2)};
    handed = t0[3] < 0 ? -1 : 1;
  } else if (std::abs(det) > 1e-20) {
    along = (1 / det) * (uv_e2[1] * e1 - uv_e1[1] * e2);
    // v goes down in pictures, bitangents up.
    other = (-1 / det) * (uv_e1[0] * e2 - uv_e2[0] * e1);
    handed = dot(cross(side * at.normal, along), other) < 0 ? -1 : 1;
  }
  at.tangent = unit_or(along - dot(along, at.normal) * at.normal, across(at.normal));
  at.bitangent = (handed * side) * cross(at.normal, at.tangent);
  at.material = state_->material_at(*mesh.material, at, uv);
  if (mesh.material->normal_map) state_->bend_normal(at, uv);

  // Near outlines interpolated normals turn away from the viewer.
  constexpr double kLeastCosine = 1e-3;
  const double cosine = dot(at.normal, at.view);
  if (cosine < kLeastCosine) at.normal = normalize(at.normal + (kLeastCosine - cosine) * at.view);
  return at;
}

}  // namespace welkin::scene
