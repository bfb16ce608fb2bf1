#include "welkin/render/probes/probe_grid.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/render/project/texel_matrix.h"
#include "welkin/render/project/texel_rays.h"

namespace welkin::scene {
namespace {

constexpr int kMostProbes = 1 << 24, kLongestSide = 1 << 20;
constexpr double kMostBytes = 8.0 * 1024 * 1024 * 1024;
/// Chebyshev's test divides by a variance, the small difference of two moments.
constexpr double kDepthTolerance = 1e-5;

sphere::AnyParameterization octahedral() {
  return sphere::AnyParameterization::make("octahedral");
}

/// An atlas that has no pixels yet, and what it is filtered from.
struct Planned {
  ProbeAtlas atlas;
  bool of_depth = false;
};

std::vector<Planned> planned_atlases(const ProbeGridOptions& options) {
  const std::vector<std::string> rgb{"R", "G", "B"};
  std::vector<Planned> list;
  const auto add = [&](std::string name, const std::string& lobe, int size, bool of_depth) {
    list.push_back({{std::move(name), lobe, of_depth ? std::vector<std::string>{"Z", "Z2"} : rgb, size,
                     options.border, Image()},
                    of_depth});
  };
  if (options.radiance) add("radiance", "mirror", options.size, false);
  if (options.diffuse_size > 0) add("diffuse", "lambert", options.diffuse_size, false);
  for (const double roughness : options.roughness)
    add("specular-" + number_text(roughness), "ggx,roughness=" + number_text(roughness), options.size, false);
  if (options.depth_size > 0)
    add("depth", "phong,exponent=" + number_text(options.depth_exponent), options.depth_size, true);
  return list;
}

ChartSize atlas_size(const ProbeBox& probes, const ProbeAtlas& atlas) {
  return {probes.counts[0] * atlas.pitch(), probes.counts[1] * probes.counts[2] * atlas.pitch()};
}

void check(const ProbeBox& probes, const ProbeGridOptions& options) {
  double count = 1;
  for (const int along : probes.counts) {
    require(along >= 1, "a grid has one probe at least along each axis");
    count *= along;
  }
  if (count > kMostProbes) throw Error(ErrorKind::too_large, "a grid has 2²⁴ probes at most");
  const Vec3d size = probes.box.most - probes.box.least;
  const auto side = [&](double least, double most, double extent, int along) {
    require(std::abs(least) <= 1e30 && std::abs(most) <= 1e30, "the box of a grid is finite, 1e30 at most");
    require(extent > 0 || (extent == 0 && along == 1),
            "the box of a grid has no size along an axis with several probes");
  };
  side(probes.box.least.x, probes.box.most.x, size.x, probes.counts[0]);
  side(probes.box.least.y, probes.box.most.y, size.y, probes.counts[1]);
  side(probes.box.least.z, probes.box.most.z, size.z, probes.counts[2]);
  require(options.size >= 4 && options.size <= 1024, "a probe is of 4 to 1024 texels along a side");
  require(options.diffuse_size >= 0 && options.diffuse_size <= 1024 && options.depth_size >= 0 &&
              options.depth_size <= 1024,
          "a tile is of 1 to 1024 texels along a side");
  require(options.border >= 1 && options.border <= kBorder, "tiles have a border of 1 to 4 texels");
  require(options.samples >= 1 && options.samples <= 64, "a texel has 1 to 64 samples along each axis");
  require(options.roughness.size() <= 32, "a grid has 32 levels of roughness at most");
  for (const double roughness : options.roughness)
    require(roughness > 0 && roughness <= 1, "roughness is over 0, and at most 1");
  require(std::adjacent_find(options.roughness.begin(), options.roughness.end(), std::greater_equal<>()) ==
              options.roughness.end(),
          "each level's roughness is over that of the one before");
  require(options.depth_exponent >= 1 && options.depth_exponent <= 1e4,
          "the exponent of depths is of 1 to 10,000");
  require(!options.farthest || (*options.farthest > 0 && *options.farthest <= 1e30),
          "the farthest distance is over 0, and at most 1e30");
  require(is_orthonormal(options.orientation), "the orientation of a map must be a rotation or a reflection");
  for (const Planned& each : planned_atlases(options)) {
    const double pitch = each.atlas.pitch();
    if (pitch * probes.counts[0] > kLongestSide || pitch * probes.counts[1] * probes.counts[2] > kLongestSide)
      throw Error(ErrorKind::too_large,
                  "an atlas of these probes has a side of over 2²⁰ texels: take fewer, or smaller ones");
  }
  if (probe_grid_bytes(probes, options) > kMostBytes)
    throw Error(ErrorKind::too_large,
                "the atlases of these probes need over 8 GiB: take fewer, or smaller ones");
}

/// A thread that waits inside must not begin another probe.
template <class Work>
auto alone(const Work& work) {
  return tbb::this_task_arena::isolate(work);
}

/// No variance is negative.
void limit_moments(Map& moments) {
  const ImageView<float> chart = moments.level.chart(0);
  for (int y = -kBorder; y < chart.height + kBorder; ++y) {
    for (int x = -kBorder; x < chart.width + kBorder; ++x) {
      float* texel = chart.at(x, y);
      texel[1] = std::max(texel[1], texel[0] * texel[0]);
    }
  }
}

/// Makes the tiles of one probe after the other.
class GridMaker {
 public:
  GridMaker(const ShadedScene& seen, ProbeGrid& grid, const ProbeGridOptions& options);

  void make(int index);

 private:
  /// An atlas, and what makes its tiles of all probes: a matrix, or where that is none a plan.
  struct Filtered {
    std::size_t atlas;
    bool of_depth;
    std::optional<TexelMatrix> matrix;
    std::optional<PrefilterPlan> plan;
  };

  void project(int index, Map& light, Map* depth);
  void copy(const Map& map, ProbeAtlas& atlas, int index) const;

  const ShadedScene& seen_;
  ProbeGrid& grid_;
  const ProbeGridOptions& options_;
  MapFrame frame_;
  std::optional<FineSky> sky_;
  std::vector<TexelBlock> blocks_;
  std::vector<TexelRays> rays_;      // of each block
  std::vector<float> solid_angles_;  // of each texel
  std::vector<Filtered> filtered_;
  tbb::enumerable_thread_specific<TexelEye> eyes_;
};

GridMaker::GridMaker(const ShadedScene& seen, ProbeGrid& grid, const ProbeGridOptions& options)
    : seen_(seen),
      grid_(grid),
      options_(options),
      frame_(octahedral(), {options.size, options.size}, options.orientation),
      sky_(sky_of(seen.background, frame_, options.samples)),
      blocks_(texel_blocks(1, frame_.size, options.samples)),
      eyes_(
          [this] { return TexelEye(seen_, sky_ ? &*sky_ : nullptr, grid_.farthest, options_.shade_once); }) {
  for (const TexelBlock& block : blocks_) rays_.push_back(texel_rays(frame_, block, options.samples));
  solid_angles_.resize(static_cast<std::size_t>(options.size * options.size));
  for (int y = 0; y < options.size; ++y)
    texel_solid_angles(frame_.parameterization, options.size, options.size, 0, y,
                       solid_angles_.data() + y * options.size);
  for (std::size_t i = 0; i < grid.atlases.size(); ++i) {
    const ProbeAtlas& atlas = grid.atlases[i];
    if (atlas.name == "radiance") continue;
    const auto lobe = lobe::AnyLobe::make(atlas.lobe);
    const ChartSize size{atlas.size, atlas.size};
    Filtered& filtered = filtered_.emplace_back(Filtered{i, atlas.name == "depth", {}, {}});
    filtered.matrix = TexelMatrix::make(frame_.parameterization, frame_.size, size, lobe);
    if (filtered.matrix) continue;
    PrefilterOptions how;
    how.orientation = options.orientation;
    if (filtered.of_depth) how.tolerance = kDepthTolerance;
    filtered.plan.emplace(PrefilterShape{frame_.parameterization, frame_.size, filtered.of_depth ? 2 : 3},
                          frame_.parameterization, std::vector{PrefilterLevel{size, lobe}}, how);
  }
}

void GridMaker::project(int index, Map& light, Map* depth) {
  const auto& counts = grid_.probes.counts;
  const int x = index % counts[0], z = index / counts[0] % counts[2], y = index / counts[0] / counts[2];
  const Vec3d position = grid_.probes.position(x, y, z);
  double behind = 0;
  std::vector<SeenTexel> texels;
  TexelEye& eye = eyes_.local();
  const ImageView<float> to = light.level.chart(0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const TexelBlock& block = blocks_[k];
    texels.resize(static_cast<std::size_t>(block.width * block.height));
    eye.see(rays_[k], position, texels);
    for (int row = 0; row < block.height; ++row) {
      for (int column = 0; column < block.width; ++column) {
        const SeenTexel& texel = texels[static_cast<std::size_t>(row * block.width + column)];
        const int tx = block.x + column, ty = block.y + row;
        const float* sky =
            texel.all_sky && sky_ ? std::as_const(sky_->texels).level.chart(0).at(tx, ty) : nullptr;
        float* out = to.at(tx, ty);
        for (int c = 0; c < 3; ++c)
          out[c] = texel.radiance[static_cast<std::size_t>(c)] +
                   (sky != nullptr ? sky[sky_->texels.channels() >= 3 ? c : 0] : 0);
        behind += static_cast<double>(texel.behind) *
                  static_cast<double>(solid_angles_[static_cast<std::size_t>(ty * options_.size + tx)]);
        if (depth == nullptr) continue;
        float* far = depth->level.chart(0).at(tx, ty);
        far[0] = texel.depth;
        far[1] = texel.depth_square;
      }
    }
  }
  grid_.behind[static_cast<std::size_t>(index)] = static_cast<float>(behind / (4 * kPi));
}

void GridMaker::copy(const Map& map, ProbeAtlas& atlas, int index) const {
  const int columns = grid_.probes.counts[0], pitch = atlas.pitch();
  const int x = index % columns * pitch, y = index / columns * pitch;
  const ImageView<const float> from = map.level.chart(0);
  for (int row = 0; row < pitch; ++row)
    std::copy_n(from.at(-atlas.border, row - atlas.border), pitch * map.channels(),
                atlas.image.at(x, y + row));
}

void GridMaker::make(int index) {
  const auto empty = [&](int channels) {
    Map map(frame_.parameterization, options_.size, options_.size, channels, PixelContents::unset);
    map.orientation = frame_.orientation;
    return map;
  };
  Map light = empty(3);
  std::optional<Map> depth;
  if (options_.depth_size > 0) depth.emplace(empty(2));
  project(index, light, depth ? &*depth : nullptr);
  fill_borders(light);
  if (depth) fill_borders(*depth);
  if (options_.radiance) copy(light, grid_.atlases[0], index);
  for (const Filtered& filtered : filtered_) {
    const Map& from = filtered.of_depth ? *depth : light;
    Map level = filtered.matrix ? filtered.matrix->apply(from)
                                : std::move(alone([&] { return filtered.plan->run(from); })[0]);
    if (filtered.of_depth) limit_moments(level);
    copy(level, grid_.atlases[filtered.atlas], index);
  }
}

}  // namespace

Vec3d ProbeBox::spacing() const {
  const Vec3d size = box.most - box.least;
  return {size.x / counts[0], size.y / counts[1], size.z / counts[2]};
}

Vec3d ProbeBox::position(int x, int y, int z) const {
  const Vec3d step = spacing();
  return box.least + Vec3d{(x + 0.5) * step.x, (y + 0.5) * step.y, (z + 0.5) * step.z};
}

ProbeBox probes_in(const Scene& scene, const std::array<int, 3>& counts) {
  const auto box = bounds_of(scene);
  require(box.has_value(), "the scene has no triangles, so a grid of probes needs a box");
  return {*box, counts};
}

bool ProbeGrid::inside(int index) const {
  return static_cast<double>(behind[static_cast<std::size_t>(index)]) > kInsideShare;
}

int ProbeGrid::inside_count() const {
  return static_cast<int>(std::count_if(
      behind.begin(), behind.end(), [](float share) { return static_cast<double>(share) > kInsideShare; }));
}

const ProbeAtlas* ProbeGrid::atlas(std::string_view name) const {
  for (const ProbeAtlas& each : atlases)
    if (each.name == name) return &each;
  return nullptr;
}

double probe_grid_bytes(const ProbeBox& probes, const ProbeGridOptions& options) {
  double bytes = 0;
  for (const Planned& each : planned_atlases(options))
    bytes += 1.0 * each.atlas.pitch() * each.atlas.pitch() * static_cast<double>(each.atlas.channels.size()) *
             sizeof(float);
  return bytes * probes.counts[0] * probes.counts[1] * probes.counts[2];
}

ProbeGrid project_grid(const ShadedScene& seen, const ProbeBox& probes, const ProbeGridOptions& options) {
  check(probes, options);
  ProbeGrid grid{
      probes, options.orientation, options.farthest.value_or(1.5 * length(probes.spacing())), {}, {}};
  if (!(grid.farthest > 0)) grid.farthest = farthest_distance(seen.scene.scene(), probes.position(0, 0, 0));
  for (Planned& each : planned_atlases(options)) {
    const ChartSize size = atlas_size(probes, each.atlas);
    each.atlas.image =
        Image(size.width, size.height, static_cast<int>(each.atlas.channels.size()), PixelContents::unset);
    grid.atlases.push_back(std::move(each.atlas));
  }
  grid.behind.resize(static_cast<std::size_t>(probes.count()));
  GridMaker maker(seen, grid, options);
  parallel_for(
      probes.count(), [&](int index) { maker.make(index); }, options.monitor);
  return grid;
}

}  // namespace welkin::scene
