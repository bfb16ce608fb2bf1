// How far look-ups are from the whole integral of a surface's BRDF: along the reflected direction as engines
// do, by rules of thumb, in stacks of angles of view, and by sums of a few look-ups of one chain.

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "harness.h"
#include "lighting.h"
#include "pictures.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/sampler.h"
#include "welkin/prefilter/lobe_sum_bake.h"
#include "welkin/prefilter/view_bake.h"
#include "welkin/prefilter/view_reference.h"
#include "welkin/prefilter/view_stack.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kPairs = 200, kFace = 256;
const std::vector<double> kRoughness{0.25, 0.5, 0.75}, kCosines{0.1, 0.2, 0.5};
const std::vector<int> kLobes{1, 2, 4};

using Look = std::function<void(const Vec3d& normal, const Vec3d& view, std::span<float> radiance)>;

struct Way {
  std::string name;
  Look look;
};

/// n and v, uniform over the sphere and about n.
std::vector<std::pair<Vec3d, Vec3d>> pairs_at(double cosine) {
  std::mt19937 random(20261126);
  std::normal_distribution<double> component;
  const auto direction = [&] {
    return normalize(Vec3d{component(random), component(random), component(random)});
  };
  std::vector<std::pair<Vec3d, Vec3d>> pairs;
  for (int i = 0; i < kPairs; ++i) {
    const Vec3d normal = direction(), level = normalize(cross(normal, direction()));
    pairs.push_back({normal, cosine * normal + std::sqrt(1 - cosine * cosine) * level});
  }
  return pairs;
}

Vec3d reflected(const Vec3d& normal, const Vec3d& view) {
  return 2 * dot(normal, view) * normal - view;
}

/// The dominant direction of Lagarde & de Rousiers 2014, §4.9.3, α = roughness².
Vec3d dominant(const Vec3d& normal, const Vec3d& view, double alpha) {
  const double smooth = 1 - alpha, part = smooth * (std::sqrt(smooth) + alpha);
  return normalize((1 - part) * normal + part * reflected(normal, view));
}

/// The exact results for all pairs, found once.
std::vector<double> exact_of(const ViewReference& reference, const brdf::AnyBrdf& brdf,
                             const std::vector<std::pair<Vec3d, Vec3d>>& pairs) {
  std::vector<double> all(3 * pairs.size());
  parallel_for(static_cast<int>(pairs.size()), [&](int i) {
    const auto& [normal, view] = pairs[static_cast<std::size_t>(i)];
    reference.evaluate(brdf, normal, view, std::span(all).subspan(3 * static_cast<std::size_t>(i), 3), 1e-6);
  });
  return all;
}

double relative_rmse(const std::vector<double>& exact, const std::vector<std::pair<Vec3d, Vec3d>>& pairs,
                     const Look& look) {
  double error = 0, whole = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::array<float, 3> found;
    look(pairs[i].first, pairs[i].second, found);
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = static_cast<double>(found[c]) - exact[3 * i + c];
      error += off * off;
      whole += exact[3 * i + c] * exact[3 * i + c];
    }
  }
  return std::sqrt(error / whole);
}

void map_tables(const NamedMap& named, const std::vector<LobeSums>& sums) {
  const Map& map = named.map;
  ViewBakeOptions stack_options;
  stack_options.bake.size = {kFace, kFace};
  const auto stack_of = [&](brdf::LobeAxis axis) {
    stack_options.axis = axis;
    return ViewStack(bake_views(map, stack_options));
  };
  const ViewStack about_r = stack_of(brdf::LobeAxis::reflected), fitted = stack_of(brdf::LobeAxis::fitted);
  BakeOptions chain_options;
  chain_options.size = {kFace, kFace};
  const auto chain = std::make_shared<const Chain>(bake(map, chain_options));
  const Sampler sampler(chain);
  std::vector<LobeSumSampler> added;
  for (const LobeSums& each : sums) added.emplace_back(LobeSumChain{bake(map, chain_options), each});

  heading(named.name);
  std::vector<std::string> columns{"roughness, n·v", "N = V = R", "dominant direction", "stack about r",
                                   "stack, fitted axis"};
  for (const int count : kLobes) columns.push_back(std::to_string(count) + (count == 1 ? " lobe" : " lobes"));
  columns.insert(columns.end(), {"× fitted axis", "× 4 lobes"});
  const Table table(columns);
  const ViewReference reference(map);
  for (const double roughness : kRoughness) {
    const brdf::AnyBrdf brdf = brdf::AnyBrdf::make("ggx").with_roughness(roughness);
    const double level = roughness * 8, alpha = roughness * roughness;
    std::vector<Look> ways{
        [&](const Vec3d& n, const Vec3d& v, std::span<float> to) {
          sampler.look_up(reflected(n, v), to, level);
        },
        [&](const Vec3d& n, const Vec3d& v, std::span<float> to) {
          sampler.look_up(dominant(n, v, alpha), to, level);
        },
        [&](const Vec3d& n, const Vec3d& v, std::span<float> to) { about_r.look_up(n, v, to, level); },
        [&](const Vec3d& n, const Vec3d& v, std::span<float> to) { fitted.look_up(n, v, to, level); }};
    for (const LobeSumSampler& each : added) {
      ways.push_back(
          [&](const Vec3d& n, const Vec3d& v, std::span<float> to) { each.look_up(n, v, roughness, to); });
    }
    for (const double cosine : kCosines) {
      const auto pairs = pairs_at(cosine);
      const std::vector<double> exact = exact_of(reference, brdf, pairs);
      std::vector<double> errors;
      for (const Look& way : ways) errors.push_back(relative_rmse(exact, pairs, way));
      std::vector<std::string> cells{fixed(roughness, 2) + ", " + fixed(cosine, 1)};
      for (const double error : errors) cells.push_back(fixed(100 * error, 1) + " %");
      cells.push_back(fixed(errors[0] / errors[3], 1));
      cells.push_back(fixed(errors[0] / errors[6], 1));
      table.row(cells);
    }
  }
}

}  // namespace

int main() {
  const Threads threads;
  heading("Lobes that turn with the view: errors");
  paragraph(
      "GGX (height-correlated masking, no Fresnel), relative RMSE of the mean radiance in the lobe against "
      "the "
      "whole integral in float64, over 200 random normals and viewers at each n·v. The chain has nine levels "
      "of "
      "roughness 0, ⅛ … 1 in cubes of 6×256, the stacks 16 angles of view. *N = V = R* is what engines look "
      "up, "
      "along the reflected direction; *dominant direction* moves that towards the normal (Lagarde & de "
      "Rousiers "
      "2014); *lobes* are sums of so many look-ups of the same chain.");
  std::vector<LobeSums> sums;
  for (const int count : kLobes) {
    LobeSumOptions options;
    options.count = count;
    options.bake.size = {kFace, kFace};
    sums.push_back(fit_lobe_sums(options));
  }
  std::vector<NamedMap> maps;
  const auto latlong = sphere::AnyParameterization::make("latlong");
  for (const char* name : {"studio", "sky", "room"})
    maps.push_back({std::string("Built-in ") + name, render(synth::make(name), latlong, 512, 256)});
  if (!setting("WELKIN_BENCH_HDRI").empty()) {
    HighDynamicRange picture = high_dynamic_range();
    maps.push_back({picture.name, std::move(picture.map)});
  }
  for (const NamedMap& each : maps) map_tables(each, sums);
}
