#include "welkin/measure/energy_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/map/texel_points.h"
#include "welkin/math/angles.h"
#include "welkin/measure/segment_sums.h"

namespace welkin {
namespace {

constexpr int kBatch = 256;

/// A texel that is shown in part is sampled at so many points across.
constexpr int kSamples = 8;

/// Charts of so many texels across have densities that their centres tell.
constexpr int kLargeChart = 256;

/// Texels that a cone reaches beyond its light, and over which it then falls.
constexpr double kMargin = 2, kFall = 2;

/// Directions of the frame at positions of a chart's row, a batch at a time.
struct Directions {
  alignas(64) float u[kBatch], v[kBatch], x[kBatch], y[kBatch], z[kBatch];

  void find(const MapFrame& frame, int chart, double row, double first, int count) {
    for (int i = 0; i < kBatch; ++i) {
      const double column = first + std::min(i, count - 1);
      u[i] = static_cast<float>(column / frame.size.width);
      v[i] = static_cast<float>(row / frame.size.height);
    }
    frame.parameterization.kernels().to_sphere(frame.parameterization.self(), chart, u, v, x, y, z,
                                               static_cast<std::size_t>(count));
  }

  Vec3d at(int i) const {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
  }
};

/// How much of each texel of a row another map shows.
class CommonPart {
 public:
  CommonPart(const MapFrame& frame, const EnergyFrame::Other& other) : frame_(frame), other_(other) {}

  std::vector<double> of_row(int chart, int y) {
    const int width = frame_.size.width;
    const std::vector<float> above = covers(chart, y, 0, width + 1),
                             below = covers(chart, y + 1, 0, width + 1),
                             middle = covers(chart, y + 0.5, 0.5, width);
    std::vector<double> parts(static_cast<std::size_t>(width));
    for (std::size_t x = 0; x < parts.size(); ++x) {
      const float sum = above[x] + above[x + 1] + below[x] + below[x + 1] + middle[x];
      parts[x] = sum == 0 ? 0 : sum == 5 ? 1 : sampled(chart, static_cast<int>(x), y);
    }
    return parts;
  }

 private:
  /// 1 or 0 at `count` positions of a row.
  std::vector<float> covers(int chart, double row, double first, int count) {
    std::vector<float> mask(static_cast<std::size_t>(count) + kBatch);
    for (int from = 0; from < count; from += kBatch) {
      const int size = std::min(kBatch, count - from);
      directions_.find(frame_, chart, row, first + from, size);
      for (int i = 0; i < size; ++i) {
        const Vec3d d = other_.turn * directions_.at(i);
        directions_.x[i] = static_cast<float>(d.x);
        directions_.y[i] = static_cast<float>(d.y);
        directions_.z[i] = static_cast<float>(d.z);
      }
      const auto& p = other_.parameterization;
      p.kernels().covers(p.self(), directions_.x, directions_.y, directions_.z, mask.data() + from,
                         static_cast<std::size_t>(size));
    }
    return mask;
  }

  double sampled(int chart, int x, int y) const {
    const auto& p = frame_.parameterization;
    double shown = 0, all = 0;
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const double u = (x + (k % kSamples + 0.5) / kSamples) / frame_.size.width,
                   v = (y + (k / kSamples + 0.5) / kSamples) / frame_.size.height;
      if (!p.valid(chart, u, v)) continue;
      const double density = p.solid_angle_density(chart, u, v);
      all += density;
      if (other_.parameterization.covers(other_.turn * p.to_sphere(chart, u, v))) shown += density;
    }
    return all > 0 ? shown / all : 0;
  }

  const MapFrame& frame_;
  const EnergyFrame::Other& other_;
  Directions directions_;
};

/// Solid angles of a row's texels, sr.
std::vector<float> solid_angles(const MapFrame& frame, int chart, int y) {
  std::vector<float> omega(static_cast<std::size_t>(frame.size.width));
  texel_solid_angles(frame.parameterization, frame.size.width, frame.size.height, chart, y, omega.data());
  return omega;
}

/// The mean of a cone's weight over a texel.
double mean_weight(const MapFrame& frame, const Cone& cone, int chart, int x, int y) {
  const auto& p = frame.parameterization;
  double sum = 0, all = 0;
  for (int k = 0; k < 4; ++k) {
    const double u = (x + kGauss[k % 2]) / frame.size.width, v = (y + kGauss[k / 2]) / frame.size.height;
    if (!p.valid(chart, u, v)) continue;
    const double density = p.solid_angle_density(chart, u, v);
    all += density;
    sum += density * cone.weight(p.to_sphere(chart, u, v));
  }
  return all > 0 ? sum / all : 0;
}

/// Density at the texels' centres times their area.
std::vector<float> centre_solid_angles(const MapFrame& frame, int chart, int y) {
  const int width = frame.size.width, height = frame.size.height;
  alignas(64) float u[kBatch], v[kBatch], density[kBatch];
  const float area = 1.0f / (static_cast<float>(width) * static_cast<float>(height));
  const float step = 1.0f / static_cast<float>(width);
  std::fill(std::begin(v), std::end(v), static_cast<float>((y + 0.5) / height));
  std::vector<float> omega(static_cast<std::size_t>(width));
  for (int from = 0; from < width; from += kBatch) {
    const int size = std::min(kBatch, width - from);
    for (int i = 0; i < kBatch; ++i)
      u[i] = std::min((static_cast<float>(from + i) + 0.5f) * step, 1 - 0.5f * step);
    const auto& p = frame.parameterization;
    p.kernels().density(p.self(), chart, u, v, density, static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) omega[static_cast<std::size_t>(from + i)] = density[i] * area;
  }
  return omega;
}

bool is_finite(const float* texel, const std::vector<int>& channels) {
  float zero = 0;
  for (const int c : channels) zero += texel[c] * 0.0f;
  return zero == 0;
}

/// Which segments of a row come near which cone, 1 or 0, the cones of a segment together: those that may by
/// how far their middle is from it and their ends from the middle. Chords are shorter than arcs, so none is
/// missed.
std::vector<std::uint8_t> segments_near(const MapFrame& frame, const std::vector<Cone>& cones, double margin,
                                        int chart, int y) {
  const int width = frame.size.width, count = segments_of(width);
  std::vector<std::uint8_t> near(static_cast<std::size_t>(count) * cones.size());
  // Two points to a segment, and the end.
  std::vector<Vec3d> points;
  alignas(64) float u[kBatch], v[kBatch], x[kBatch], z[kBatch], up[kBatch];
  std::fill(std::begin(v), std::end(v), static_cast<float>((y + 0.5) / frame.size.height));
  for (int from = 0; from <= 2 * count; from += kBatch) {
    const int size = std::min(kBatch, 2 * count + 1 - from);
    for (int i = 0; i < kBatch; ++i) {
      const int column = std::min((from + i) * (kSegment / 2), width);
      u[i] = static_cast<float>(static_cast<double>(column) / width);
    }
    const auto& p = frame.parameterization;
    p.kernels().to_sphere(p.self(), chart, u, v, x, up, z, static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i)
      points.push_back({static_cast<double>(x[i]), static_cast<double>(up[i]), static_cast<double>(z[i])});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Vec3d& middle = points[2 * i + 1];
    // As arcs, which are π/2 times as long at most.
    const double reach =
        kPi / 2 * (length(points[2 * i] - middle) + length(points[2 * i + 2] - middle)) + margin;
    for (std::size_t k = 0; k < cones.size(); ++k)
      near[i * cones.size() + k] = length(middle - cones[k].axis) <= cones[k].outer + reach ? 1 : 0;
  }
  return near;
}

}  // namespace

double Cone::weight(const Vec3d& direction) const {
  return 1 - smooth_step(inner, outer, angle_between(axis, direction));
}

double texel_side(const MapFrame& frame, const Vec3d& direction) {
  const auto& p = frame.parameterization;
  if (!p.covers(direction)) return 0;
  const auto at = p.from_sphere(direction);
  const int width = frame.size.width, height = frame.size.height;
  const double x = std::clamp(std::floor(at.u * width), 0.0, width - 1.0),
               y = std::clamp(std::floor(at.v * height), 0.0, height - 1.0);
  const auto corner = [&](int right, int down) {
    return p.to_sphere(static_cast<int>(at.chart), (x + right) / width, (y + down) / height);
  };
  const Vec3d corners[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
  double longest = 0;
  for (int k = 0; k < 4; ++k) longest = std::max(longest, angle_between(corners[k], corners[(k + 1) % 4]));
  return longest;
}

Cone cone_of(const Light& light, const Vec3d& axis, double texel) {
  const double inner = light.radius + kMargin * texel;
  return {axis, inner, inner + kFall * texel};
}

void EnergySum::resize(std::size_t count) {
  values.resize(count);
  magnitudes.resize(count);
}

void EnergySum::add(const EnergySum& other) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] += other.values[i];
    magnitudes[i] += other.magnitudes[i];
  }
}

void RowSums::add(const RowSums& other) {
  solid_angle += other.solid_angle;
  common += other.common;
  skipped += other.skipped;
  whole.add(other.whole);
  for (std::size_t i = 0; i < in_cones.size(); ++i) in_cones[i].add(other.in_cones[i]);
}

/// Solid angles of a row's texels that count, by what the other map shows of them. Unless they are to be
/// `exact`, those of large charts are the density at the centre times the area: the sum of all is right to
/// 1e-5.
std::vector<float> EnergyFrame::weights(int chart, int y, bool exact) const {
  const auto& p = frame.parameterization;
  const int width = frame.size.width, height = frame.size.height;
  std::vector<float> omega;
  if (!exact && p.full_charts() && !p.density_by_row() && std::min(width, height) >= kLargeChart) {
    omega = centre_solid_angles(frame, chart, y);
  } else {
    omega = solid_angles(frame, chart, y);
  }
  if (!other) return omega;
  const std::vector<double> parts = CommonPart(frame, *other).of_row(chart, y);
  for (std::size_t x = 0; x < omega.size(); ++x) omega[x] *= static_cast<float>(parts[x]);
  return omega;
}

void EnergyFrame::add_texel(EnergySum& sum, const float* texel, double weight) const {
  const auto add = [&](std::size_t i, float value) {
    const double energy = weight * static_cast<double>(value);
    sum.values[i] += energy;
    sum.magnitudes[i] += std::fabs(energy);
  };
  for (std::size_t i = 0; i < channels.size(); ++i) add(i, texel[channels[i]]);
  add(channels.size(), luminance(texel));
}

RowSums EnergyFrame::whole(int chart, int y, const float* texels, int texel_channels, float* maxima) const {
  const int width = frame.size.width;
  RowSums row;
  row.whole.resize(channels.size() + 1);
  row.in_cones.resize(cones.size());
  for (EnergySum& each : row.in_cones) each.resize(channels.size() + 1);
  const std::vector<float> omega = weights(chart, y, false);
  for (const float each : omega) row.common += static_cast<double>(each);
  row.solid_angle = row.common;
  if (other) {
    row.solid_angle = 0;
    for (const float each : solid_angles(frame, chart, y)) row.solid_angle += static_cast<double>(each);
  }
  for (int from = 0; from < width; from += kSegment) {
    const int size = std::min(kSegment, width - from);
    const float* segment = texels + std::ptrdiff_t{from} * texel_channels;
    const float* weight = &omega[static_cast<std::size_t>(from)];
    const SegmentSums sums = sum_segment(segment, weight, size, texel_channels);
    if (maxima != nullptr) *maxima++ = sums.plain ? sums.maximum : std::numeric_limits<float>::infinity();
    if (sums.plain) {
      const auto add = [&](std::size_t i, double energy) {
        row.whole.values[i] += energy;
        row.whole.magnitudes[i] += energy;
      };
      for (std::size_t i = 0; i < channels.size(); ++i) add(i, sums.channels[channels[i]]);
      add(channels.size(), luminance.of_sums(sums.channels));
      continue;
    }
    for (int x = 0; x < size; ++x, segment += texel_channels) {
      if (!(weight[x] > 0)) continue;
      if (is_finite(segment, channels)) {
        add_texel(row.whole, segment, static_cast<double>(weight[x]));
      } else {
        ++row.skipped;
      }
    }
  }
  return row;
}

void EnergyFrame::add_cones(int chart, int y, const float* texels, int texel_channels, RowSums& sums) const {
  if (cones.empty()) return;
  const int width = frame.size.width;
  const std::vector<std::uint8_t> near = segments_near(frame, cones, margin, chart, y);
  std::vector<float> omega;
  Directions directions;
  for (int from = 0; from < width; from += kSegment) {
    const std::uint8_t* which = &near[static_cast<std::size_t>(from / kSegment) * cones.size()];
    if (std::none_of(which, which + cones.size(), [](std::uint8_t each) { return each > 0; })) continue;
    const int size = std::min(kSegment, width - from);
    if (omega.empty()) omega = weights(chart, y, true);
    directions.find(frame, chart, y + 0.5, from + 0.5, size);
    for (std::size_t k = 0; k < cones.size(); ++k) {
      if (which[k] == 0) continue;
      const Cone& cone = cones[k];
      for (int i = 0; i < size; ++i) {
        const double angle = angle_between(cone.axis, directions.at(i));
        if (angle > cone.outer + margin) continue;
        const float weight = omega[static_cast<std::size_t>(from + i)];
        const float* texel = texels + std::ptrdiff_t{from + i} * texel_channels;
        if (!(weight > 0) || !is_finite(texel, channels)) continue;
        const bool within = angle + margin < cone.inner;
        const double mean = within ? 1 : mean_weight(frame, cone, chart, from + i, y);
        if (mean > 0) add_texel(sums.in_cones[k], texel, static_cast<double>(weight) * mean);
      }
    }
  }
}

RowSums total_of(const std::vector<RowSums>& rows, double coverage) {
  RowSums total = rows.front();
  for (std::size_t i = 1; i < rows.size(); ++i) total.add(rows[i]);
  const double scale = total.solid_angle > 0 ? coverage / total.solid_angle : 0;
  total.solid_angle *= scale;
  total.common *= scale;
  for (double& value : total.whole.values) value *= scale;
  for (double& value : total.whole.magnitudes) value *= scale;
  return total;
}

}  // namespace welkin
