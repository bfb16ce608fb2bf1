#include "welkin/filter/texel_samples.h"

#include <algorithm>
#include <cmath>

#include "welkin/filter/footprint.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

/// Points along a side of a texel that lies where neither outline nor reconstruction serve.
constexpr int kSamples = 32, kManySamples = 256;
static_assert(kBatch % kSamples == 0 && kBatch % kManySamples == 0);

/// Whether a source shows all directions within a few texels of the target's of the middle of its first
/// chart: then what it shows is no strip that could pass between points.
bool is_broad(const sphere::AnyParameterization& source, const MapFrame& target) {
  const Vec3d middle = source.to_sphere(0, 0.5, 0.5);
  const double reach = 3 * mean_texel(target.parameterization, target.size);
  if (reach > 1) return false;
  const Vec3d side = normalize(cross(middle, std::fabs(middle.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d other = cross(middle, side);
  constexpr int kAzimuths = 32;
  for (int i = 0; i < kAzimuths; ++i) {
    const double azimuth = 2 * kPi * i / kAzimuths;
    const Vec3d across = std::cos(azimuth) * side + std::sin(azimuth) * other;
    if (!source.covers(std::cos(reach) * middle + std::sin(reach) * across)) return false;
  }
  return true;
}

}  // namespace

TexelSamples::TexelSamples(const ResampleJob& job, const LevelView& level)
    : job_(job),
      view_(level),
      huge_(std::min(job.target.size.width, job.target.size.height) <= 2),
      source_is_full_(job.source.parameterization.full_charts()),
      source_is_broad_(is_broad(job.source.parameterization, job.target)) {}

bool TexelSamples::sees_many(int chart, int x, int y) const {
  if (source_is_full_ || !job_.source_is_whole) return false;
  const Footprint footprint = footprint_at(job_.source, job_.target, job_.to_source, chart, x + 0.5, y + 0.5);
  constexpr double kMany = 6;
  return std::max(footprint.right_length(), footprint.down_length()) > kMany;
}

bool TexelSamples::is_outside(int chart, int x, int y) const {
  if (job_.target_is_full) return false;
  return is_outside_texel(job_.target.parameterization, job_.target.size, chart, x, y);
}

bool TexelSamples::misses(int chart, int x, int y, Batch& batch) const {
  if (huge_ || !source_is_broad_) return false;
  constexpr int kSide = 8;
  for (int i = 0; i < kSide * kSide; ++i) {
    batch.u[i] = (static_cast<float>(x) + (static_cast<float>(i % kSide) + 0.5f) / kSide) /
                 static_cast<float>(job_.target.size.width);
    batch.v[i] = (static_cast<float>(y) + (static_cast<float>(i / kSide) + 0.5f) / kSide) /
                 static_cast<float>(job_.target.size.height);
  }
  batch.locate(chart, kSide * kSide);
  const float* covered = batch.covered(kSide * kSide);
  return std::none_of(covered, covered + kSide * kSide, [](float each) { return each > 0; });
}

void TexelSamples::leave(int chart, int x, int y, Batch& batch, float* out) const {
  if (!job_.target.parameterization.filled_to_edges()) {
    std::copy(job_.fill.begin(), job_.fill.end(), out);
    return;
  }
  TexelWalk walk;
  walk.start_x = x;
  walk.start_y = y;
  resample_rectangle(job_, job_.fetch_of(Filter::automatic), {chart, walk},
                     {out, 1, 1, view_.channels, view_.channels}, batch);
}

void TexelSamples::sample(int chart, int x, int y, Batch& batch, std::vector<double>& sum, float* out) const {
  const float across = 1.0f / static_cast<float>(job_.target.size.width),
              down = 1.0f / static_cast<float>(job_.target.size.height);
  const int side = huge_ || sees_many(chart, x, y) ? kManySamples : kSamples;
  const float step = 1.0f / static_cast<float>(side);
  const std::size_t channels = job_.channels();
  sum.assign(channels, 0.0);
  double total = 0;
  const int rows_at_once = kBatch / side;
  for (int first = 0; first < side; first += rows_at_once) {
    for (int i = 0; i < kBatch; ++i) {
      batch.u[i] = (static_cast<float>(x) + (static_cast<float>(i % side) + 0.5f) * step) * across;
      batch.v[i] = (static_cast<float>(y) + (static_cast<float>(first + i / side) + 0.5f) * step) * down;
    }
    batch.locate(chart, kBatch);
    batch.weigh(chart, kBatch);
    // Texels by their own value, which keeps their light.
    const float* value = batch.fetch(huge_ ? job_.kernels.bilinear : job_.kernels.nearest, view_, kBatch);
    for (int i = 0; i < kBatch; ++i, value += channels) {
      if (!(batch.weight[i] > 0)) continue;
      const double weight = static_cast<double>(batch.weight[i]);
      total += weight;
      for (std::size_t c = 0; c < channels; ++c) sum[c] += weight * static_cast<double>(value[c]);
    }
  }
  if (!(total > 0)) return leave(chart, x, y, batch, out);
  for (std::size_t c = 0; c < channels; ++c) out[c] = static_cast<float>(sum[c] / total);
}

}  // namespace welkin
