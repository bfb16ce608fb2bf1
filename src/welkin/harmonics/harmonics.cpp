#include "welkin/harmonics/harmonics.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/harmonics/recurrence.h"
#include "welkin/map/map.h"

namespace welkin::harmonics {

Recurrence::Recurrence(int max_degree) : degree(max_degree) {
  double value = std::sqrt(1 / (4 * kPi));
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) value *= std::sqrt((2.0 * m + 1) / (2.0 * m)) * (m == 1 ? std::sqrt(2.0) : 1);
    first.push_back(value);
    double last = 0;  // 1/a of the degree before; Q of degree m − 1 is 0
    for (int l = m + 1; l <= degree; ++l) {
      const double factor =
          std::sqrt((4.0 * l * l - 1) / (static_cast<double>(l) * l - static_cast<double>(m) * m));
      a.push_back(factor);
      b.push_back(last);
      last = 1 / factor;
    }
  }
}

void evaluate_functions(int degree, const Vec3d& direction, std::span<double> out) {
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  require(out.size() == static_cast<std::size_t>(count_of(degree)),
          "there is one value for each spherical harmonic");
  const Recurrence r(degree);
  double real = 1, imaginary = 0;
  std::size_t k = 0;
  for (int m = 0; m <= degree; ++m) {
    double now = r.first[static_cast<std::size_t>(m)], before = 0;
    for (int l = m;; ++l) {
      out[static_cast<std::size_t>(index_of(l, -m))] = now * imaginary;
      out[static_cast<std::size_t>(index_of(l, m))] = now * real;
      if (l == degree) break;
      const double next = r.a[k] * (direction.z * now - r.b[k] * before);
      before = now;
      now = next;
      ++k;
    }
    const double next = real * direction.x - imaginary * direction.y;
    imaginary = real * direction.y + imaginary * direction.x;
    real = next;
  }
}

SphericalHarmonics::SphericalHarmonics(int degree, int channels) : degree_(degree), channels_(channels) {
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  require(channels >= 1 && channels <= kMaxChannels, "there are 1 to 64 channels");
  channel_names = default_channel_names(channels);
  values_.resize(static_cast<std::size_t>(count()) * static_cast<std::size_t>(channels));
}

void SphericalHarmonics::evaluate(const Vec3d& direction, std::span<double> out) const {
  require(out.size() == static_cast<std::size_t>(channels_), "there is one value for each channel");
  std::vector<double> functions(static_cast<std::size_t>(count()));
  evaluate_functions(degree_, direction, functions);
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    for (std::size_t c = 0; c < out.size(); ++c) out[c] += functions[i] * values_[i * out.size() + c];
  }
}

void SphericalHarmonics::evaluate(std::span<const Vec3d> directions, std::span<double> out) const {
  const std::size_t channels = static_cast<std::size_t>(channels_);
  require(out.size() == directions.size() * channels, "there is one value for each direction and channel");
  const Recurrence recurrence(degree_);
  const int batches = static_cast<int>((directions.size() + kPoints - 1) / kPoints);
  parallel_for(batches, [&](int batch) {
    const std::size_t from = static_cast<std::size_t>(batch) * kPoints;
    PointBatch points;
    points.count = static_cast<int>(std::min<std::size_t>(kPoints, directions.size() - from));
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Vec3d& d = directions[std::min(from + i, directions.size() - 1)];
      points.x[i] = d.x;
      points.y[i] = d.y;
      points.z[i] = d.z;
    }
    std::vector<double> sums(channels * kPoints);
    visit_functions(recurrence, points, [&](int index, const double* y) {
      for (std::size_t c = 0; c < channels; ++c) {
        const double coefficient = values_[static_cast<std::size_t>(index) * channels + c];
        double* sum = &sums[c * kPoints];
        for (int i = 0; i < kPoints; ++i) sum[i] += coefficient * y[i];
      }
    });
    for (std::size_t i = 0; i < static_cast<std::size_t>(points.count); ++i) {
      for (std::size_t c = 0; c < channels; ++c) out[(from + i) * channels + c] = sums[c * kPoints + i];
    }
  });
}

double SphericalHarmonics::norm() const {
  double sum = 0;
  for (const double value : values_) sum += value * value;
  return std::sqrt(sum);
}

double SphericalHarmonics::norm(int l, int channel) const {
  double sum = 0;
  for (int m = -l; m <= l; ++m) sum += at(l, m, channel) * at(l, m, channel);
  return std::sqrt(sum);
}

SphericalHarmonics& SphericalHarmonics::operator+=(const SphericalHarmonics& other) {
  if (other.channels_ != channels_)
    throw Error(ErrorKind::mismatch, "spherical harmonics of " + std::to_string(channels_) +
                                         " channels and of " + std::to_string(other.channels_) +
                                         " cannot be added");
  if (other.degree_ > degree_) *this = with_degree(*this, other.degree_);
  for (std::size_t i = 0; i < other.values_.size(); ++i) values_[i] += other.values_[i];
  return *this;
}

SphericalHarmonics& SphericalHarmonics::operator*=(double factor) {
  for (double& value : values_) value *= factor;
  return *this;
}

SphericalHarmonics with_degree(const SphericalHarmonics& harmonics, int degree) {
  SphericalHarmonics result(degree, harmonics.channels());
  result.channel_names = harmonics.channel_names;
  const std::span<const double> from = harmonics.values();
  std::copy_n(from.begin(), std::min(from.size(), result.values().size()), result.values().begin());
  return result;
}

}  // namespace welkin::harmonics
