#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/harmonics/recurrence.h"
#include "welkin/harmonics/texel_harmonics.h"
#include "welkin/harmonics/texel_quadrature.h"
#include "welkin/map/row_bands.h"

namespace welkin::harmonics {
namespace {

/// Texels whose points are kept at most.
constexpr double kMostKept = 2e5;

/// Points with a value for each channel, which are added up, or found, a batch at a time.
class PointSums {
 public:
  PointSums(const Recurrence& recurrence, int channels)
      : recurrence_(recurrence),
        channels_(static_cast<std::size_t>(channels)),
        values_(channels_ * kPoints) {}

  /// `sums` += Σ weight · value · Y.
  void add(const TexelPoint& point, const double* values, SphericalHarmonics& sums) {
    if (batch_.count == kPoints) flush(sums);
    const std::size_t i = static_cast<std::size_t>(batch_.count++);
    set(i, point.direction);
    for (std::size_t c = 0; c < channels_; ++c) values_[c * kPoints + i] = point.solid_angle * values[c];
  }

  void flush(SphericalHarmonics& sums) {
    for (std::size_t i = static_cast<std::size_t>(batch_.count); i < kPoints; ++i) {
      set(i, {0, 0, 1});
      for (std::size_t c = 0; c < channels_; ++c) values_[c * kPoints + i] = 0;
    }
    if (batch_.count > 0) {
      visit_functions(recurrence_, batch_, [&](int index, const double* y) {
        double* sum = &sums.values()[static_cast<std::size_t>(index) * channels_];
        for (std::size_t c = 0; c < channels_; ++c) sum[c] += dot_points(y, &values_[c * kPoints]);
      });
    }
    batch_.count = 0;
  }

  /// out[i·channels + c] of `count` ≤ kPoints points.
  void evaluate(const TexelPoint* points, int count, const SphericalHarmonics& function, double* out) {
    for (int i = 0; i < kPoints; ++i)
      set(static_cast<std::size_t>(i), points[std::min(i, count - 1)].direction);
    std::fill(values_.begin(), values_.end(), 0.0);
    visit_functions(recurrence_, batch_, [&](int index, const double* y) {
      const double* coefficient = &function.values()[static_cast<std::size_t>(index) * channels_];
      for (std::size_t c = 0; c < channels_; ++c) {
        double* value = &values_[c * kPoints];
        for (int i = 0; i < kPoints; ++i) value[i] += coefficient[c] * y[i];
      }
    });
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      for (std::size_t c = 0; c < channels_; ++c) out[i * channels_ + c] = values_[c * kPoints + i];
    }
  }

 private:
  void set(std::size_t i, const Vec3d& d) {
    batch_.x[i] = d.x;
    batch_.y[i] = d.y;
    batch_.z[i] = d.z;
  }

  const Recurrence& recurrence_;
  std::size_t channels_;
  PointBatch batch_;
  std::vector<double> values_;
};

class PointHarmonics final : public TexelHarmonics {
 public:
  PointHarmonics(const MapFrame& frame, int degree)
      : charts_(frame.parameterization.charts()),
        size_(frame.size),
        recurrence_(degree),
        quadrature_(frame.parameterization, frame.size, degree) {}

  void keep_points() override {
    if (static_cast<double>(charts_) * size_.width * size_.height > kMostKept) return;
    std::vector<RowPoints> rows(static_cast<std::size_t>(charts_ * size_.height));
    parallel_for(charts_ * size_.height, [&](int i) {
      quadrature_.of_row(i / size_.height, i % size_.height, rows[static_cast<std::size_t>(i)]);
    });
    kept_ = std::move(rows);
  }

  SphericalHarmonics analyse(const Map& map, const Monitor& monitor) const override {
    return sum_of_rows(map.channels(), monitor, [&](int chart, int y, Row& row, SphericalHarmonics& sums) {
      const float* texel = map.level.chart(chart).row(y);
      std::vector<double> value(static_cast<std::size_t>(map.channels()));
      for_each_texel(row.points, [&](int x, int first, int last) {
        std::copy_n(texel + std::ptrdiff_t{x} * map.channels(), map.channels(), value.begin());
        add(row, first, last, value.data(), sums);
      });
      row.sums.flush(sums);
    });
  }

  void write_means(const SphericalHarmonics& function, Map& map, const Monitor& monitor) const override {
    const int channels = map.channels();
    parallel_for(
        charts_ * size_.height,
        [&](int i) {
          Row row(recurrence_, channels);
          find_points(i, row);
          float* texels = map.level.chart(i / size_.height).row(i % size_.height);
          std::fill_n(texels, std::ptrdiff_t{size_.width} * channels, 0.0f);
          find_means(function, row);
          for_each_texel(row.points, [&](int x, int, int) {
            for (int c = 0; c < channels; ++c)
              texels[std::ptrdiff_t{x} * channels + c] =
                  static_cast<float>(row.means[static_cast<std::size_t>(x * channels + c)]);
          });
        },
        monitor);
  }

  SphericalHarmonics through_texels(const SphericalHarmonics& function) const override {
    const int channels = function.channels();
    return sum_of_rows(channels, {}, [&](int, int, Row& row, SphericalHarmonics& sums) {
      find_means(function, row);
      for_each_texel(row.points, [&](int x, int first, int last) {
        add(row, first, last, &row.means[static_cast<std::size_t>(x * channels)], sums);
      });
      row.sums.flush(sums);
    });
  }

 private:
  /// What a row needs.
  struct Row {
    Row(const Recurrence& recurrence, int channels) : sums(recurrence, channels) {}
    RowPoints points;
    PointSums sums;
    std::vector<double> values, means;
  };

  /// Of row i of all charts.
  void find_points(int i, Row& row) const {
    if (kept_.empty()) return quadrature_.of_row(i / size_.height, i % size_.height, row.points);
    row.points = kept_[static_cast<std::size_t>(i)];
  }

  /// body(x, first, last) for all texels that have points.
  template <class Body>
  static void for_each_texel(const RowPoints& row, const Body& body) {
    int first = 0;
    for (std::size_t x = 0; x < row.ends.size(); ++x) {
      if (row.ends[x] > first) body(static_cast<int>(x), first, row.ends[x]);
      first = row.ends[x];
    }
  }

  static void add(Row& row, int first, int last, const double* value, SphericalHarmonics& sums) {
    for (int i = first; i < last; ++i)
      row.sums.add(row.points.points[static_cast<std::size_t>(i)], value, sums);
  }

  /// row.means, from row.points.
  void find_means(const SphericalHarmonics& function, Row& row) const {
    const std::size_t channels = static_cast<std::size_t>(function.channels());
    const std::vector<TexelPoint>& points = row.points.points;
    row.values.resize(points.size() * channels);
    for (std::size_t from = 0; from < points.size(); from += kPoints) {
      const int count = static_cast<int>(std::min<std::size_t>(kPoints, points.size() - from));
      row.sums.evaluate(&points[from], count, function, &row.values[from * channels]);
    }
    row.means.assign(static_cast<std::size_t>(size_.width) * channels, 0.0);
    for_each_texel(row.points, [&](int x, int first, int last) {
      double* mean = &row.means[static_cast<std::size_t>(x) * channels];
      double all = 0;
      for (std::size_t i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
        all += points[i].solid_angle;
        for (std::size_t c = 0; c < channels; ++c)
          mean[c] += points[i].solid_angle * row.values[i * channels + c];
      }
      for (std::size_t c = 0; c < channels; ++c) mean[c] = all > 0 ? mean[c] / all : 0;
    });
  }

  /// body(chart, y, row, sums) for all rows, row.points found; sums of bands added up in order.
  template <class Body>
  SphericalHarmonics sum_of_rows(int channels, const Monitor& monitor, const Body& body) const {
    const RowBands bands(charts_ * size_.height);
    std::vector<SphericalHarmonics> sums(static_cast<std::size_t>(bands.count),
                                         SphericalHarmonics(recurrence_.degree, channels));
    parallel_for(
        bands.count,
        [&](int band) {
          Row row(recurrence_, channels);
          for (int i = bands.first(band); i < bands.first(band + 1); ++i) {
            find_points(i, row);
            body(i / size_.height, i % size_.height, row, sums[static_cast<std::size_t>(band)]);
          }
        },
        monitor);
    for (std::size_t i = 1; i < sums.size(); ++i) sums[0] += sums[i];
    return sums[0];
  }

  int charts_;
  ChartSize size_;
  Recurrence recurrence_;
  TexelQuadrature quadrature_;
  std::vector<RowPoints> kept_;
};

}  // namespace

std::unique_ptr<TexelHarmonics> make_point_harmonics(const MapFrame& frame, int degree) {
  return std::make_unique<PointHarmonics>(frame, degree);
}

std::unique_ptr<TexelHarmonics> make_texel_harmonics(const MapFrame& frame, int degree) {
  std::unique_ptr<TexelHarmonics> result = make_longitude_harmonics(frame, degree);
  return result ? std::move(result) : make_point_harmonics(frame, degree);
}

}  // namespace welkin::harmonics
