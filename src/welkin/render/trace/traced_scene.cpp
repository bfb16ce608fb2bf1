#include "welkin/render/trace/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/math/unit_vector.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/trace/traced_scene_state.h"

namespace welkin::scene {
namespace {

constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 31;
/// Rays that are handed to Embree at once.
constexpr std::size_t kStream = 256;

using Float3 = Vec3<float>;

WorldMesh world_mesh(const Scene& scene, const Instance& instance, const Transform& to) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
  WorldMesh world{&mesh, &material_of(scene, instance), {}, {}, {}, mesh.triangles};
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

}  // namespace welkin::scene
