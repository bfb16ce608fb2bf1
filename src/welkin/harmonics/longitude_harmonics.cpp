#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/harmonics/column_sums.h"
#include "welkin/harmonics/longitude_rows.h"
#include "welkin/harmonics/texel_harmonics.h"
#include "welkin/map/row_bands.h"

namespace welkin::harmonics {
namespace {

/// The functions of a column: 1, then cos mφ and sin mφ of m = 1 … degree.
int function_count(int degree) {
  return 2 * degree + 1;
}
int order_of(int function) {
  return (function + 1) / 2;
}
bool is_sine(int function) {
  return function > 0 && function % 2 == 0;
}
/// The coefficient that a function of degree l goes with.
int index_of_function(int l, int function) {
  return index_of(l, is_sine(function) ? -order_of(function) : order_of(function));
}

class LongitudeHarmonics final : public TexelHarmonics {
 public:
  LongitudeHarmonics(const MapFrame& frame, const Longitudes& longitudes, int degree)
      : size_(frame.size),
        longitudes_(longitudes),
        degree_(degree),
        rows_(frame.parameterization, frame.size, degree) {}

  SphericalHarmonics analyse(const Map& map, const Monitor& monitor) const override;
  void write_means(const SphericalHarmonics& function, Map& map, const Monitor& monitor) const override;
  SphericalHarmonics through_texels(const SphericalHarmonics& function) const override;
  Matrix3 axes() const override { return {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}}; }

 private:
  /// Values of a column function at a column's centre times the share of its width.
  double column_value(int function, int x) const {
    const int m = order_of(function);
    const double angle = m * column_longitude(longitudes_, size_.width, x);
    return column_factor(longitudes_, size_.width, m) *
           (is_sine(function) ? std::sin(angle) : std::cos(angle));
  }
  /// Sums over bands of rows, added up in order.
  template <class Band>
  SphericalHarmonics sum_of_bands(int channels, const Monitor& monitor, const Band& band) const;

  ChartSize size_;
  Longitudes longitudes_;
  int degree_;
  RowFactors rows_;
};

template <class Band>
SphericalHarmonics LongitudeHarmonics::sum_of_bands(int channels, const Monitor& monitor,
                                                    const Band& band) const {
  const RowBands bands(size_.height);
  std::vector<SphericalHarmonics> sums(static_cast<std::size_t>(bands.count),
                                       SphericalHarmonics(degree_, channels));
  parallel_for(
      bands.count,
      [&](int i) { band(bands.first(i), bands.first(i + 1), sums[static_cast<std::size_t>(i)]); }, monitor);
  for (std::size_t i = 1; i < sums.size(); ++i) sums[0] += sums[i];
  return sums[0];
}

/// Rows made ready to be summed: where columns go all around, a column and its opposite are added for even
/// orders and subtracted for odd ones, whose functions have opposite signs there; padded with 0.
template <int kChannels>
class FoldedRows {
 public:
  FoldedRows(int width, bool fold)
      : width_(width), fold_(fold), columns_((half() + kColumns - 1) / kColumns * kColumns) {
    for (auto* values : {&even_, &odd_}) values->resize(kRows * stride());
    for (std::size_t row = 0; row < kRows; ++row) {
      even_rows_[row] = &even_[row * stride()];
      odd_rows_[row] = &odd_[row * stride()];
    }
  }

  int columns() const { return columns_; }
  int half() const { return fold_ ? width_ / 2 : width_; }

  /// Of channels c … c + kChannels − 1 of texels of `channels`; no texels make a row of 0.
  void set(std::size_t row, const float* texels, int c, int channels) {
    float* even = &even_[row * stride()];
    float* odd = &odd_[row * stride()];
    if (texels == nullptr) {
      std::fill_n(even, stride(), 0.0f);
      std::fill_n(odd, stride(), 0.0f);
      return;
    }
    if (channels == kChannels) return fold<kChannels>(texels, channels, even, odd);
    fold<0>(texels + c, channels, even, odd);
  }
  const float* const* rows(int order) const { return fold_ && order % 2 == 1 ? odd_rows_ : even_rows_; }

 private:
  std::size_t stride() const { return static_cast<std::size_t>(columns_) * kChannels; }

  /// kStep, or `step` where that is 0, values from one texel to the next.
  template <int kStep>
  void fold(const float* texels, int step, float* even, float* odd) const {
    const std::ptrdiff_t apart = kStep > 0 ? kStep : step;
    const float* opposite = texels + half() * apart;
    for (int x = 0; x < half(); ++x) {
      for (int c = 0; c < kChannels; ++c) {
        const float value = texels[x * apart + c];
        if (fold_) {
          const float other = opposite[x * apart + c];
          even[x * kChannels + c] = value + other;
          odd[x * kChannels + c] = value - other;
        } else {
          even[x * kChannels + c] = value;
        }
      }
    }
  }

  int width_;
  bool fold_;
  int columns_;
  std::vector<float> even_, odd_;
  const float* even_rows_[kRows];
  const float* odd_rows_[kRows];
};

/// Adds a group of kChannels channels from c on, of the rows from … to − 1.
template <int kChannels, class Value>
class GroupSums {
 public:
  GroupSums(ChartSize size, bool fold, int degree, const Value& value)
      : size_(size), fold_(fold), degree_(degree) {
    const FoldedRows<kChannels> shape(size.width, fold);
    stride_ = static_cast<std::size_t>(shape.columns()) * kChannels;
    tables_.resize(static_cast<std::size_t>(function_count(degree)) * stride_);
    for (int f = 0; f < function_count(degree); ++f) {
      float* table = &tables_[static_cast<std::size_t>(f) * stride_];
      for (int x = 0; x < shape.half(); ++x)
        std::fill_n(table + x * kChannels, kChannels, static_cast<float>(value(f, x)));
    }
  }

  void add(const Map& map, int c, int from, int to, const RowFactors& factors,
           SphericalHarmonics& sums) const {
    FoldedRows<kChannels> folded(size_.width, fold_);
    const RowIndex index(degree_);
    std::vector<double> row_factors(index.count() * kRows);
    const ImageView<const float> chart = map.level.chart(0);
    for (int y = from; y < to; y += kRows) {
      const int count = std::min(kRows, to - y);
      for (int row = 0; row < kRows; ++row) {
        folded.set(static_cast<std::size_t>(row), row < count ? chart.row(y + row) : nullptr, c,
                   map.channels());
        if (row < count) factors.of_row(y + row, &row_factors[static_cast<std::size_t>(row) * index.count()]);
      }
      for (int f = 0; f < function_count(degree_); ++f) {
        double columns[static_cast<std::size_t>(kRows) * kChannels];
        const int m = order_of(f);
        sum_columns<kChannels>(folded.rows(m), &tables_[static_cast<std::size_t>(f) * stride_],
                               folded.columns(), columns);
        for (int row = 0; row < count; ++row) {
          const double* factor = &row_factors[static_cast<std::size_t>(row) * index.count() + index.first(m)];
          for (int l = m; l <= degree_; ++l) {
            double* sum =
                &sums.values()[static_cast<std::size_t>(index_of_function(l, f) * sums.channels() + c)];
            for (int k = 0; k < kChannels; ++k) sum[k] += factor[l - m] * columns[row * kChannels + k];
          }
        }
      }
    }
  }

 private:
  ChartSize size_;
  bool fold_;
  int degree_;
  std::size_t stride_ = 0;
  std::vector<float> tables_;
};

SphericalHarmonics LongitudeHarmonics::analyse(const Map& map, const Monitor& monitor) const {
  const bool fold = longitudes_.around && size_.width % 2 == 0;
  const auto value = [this](int function, int x) { return column_value(function, x); };
  const auto sums = [&]<int kChannels>() {
    const GroupSums<kChannels, decltype(value)> group(size_, fold, degree_, value);
    return sum_of_bands(map.channels(), monitor, [&](int from, int to, SphericalHarmonics& sum) {
      for (int c = 0; c < map.channels(); c += kChannels) group.add(map, c, from, to, rows_, sum);
    });
  };
  switch (map.channels()) {
    case 2:
      return sums.template operator()<2>();
    case 3:
      return sums.template operator()<3>();
    case 4:
      return sums.template operator()<4>();
    default:
      return sums.template operator()<1>();
  }
}

void LongitudeHarmonics::write_means(const SphericalHarmonics& function, Map& map,
                                     const Monitor& monitor) const {
  const int functions = function_count(degree_), width = size_.width, channels = function.channels();
  const std::size_t stride = static_cast<std::size_t>(channels);
  std::vector<double> columns(static_cast<std::size_t>(functions) * static_cast<std::size_t>(width));
  for (int f = 0; f < functions; ++f) {
    for (int x = 0; x < width; ++x) columns[static_cast<std::size_t>(f * width + x)] = column_value(f, x);
  }
  ImageView<float> chart = map.level.chart(0);
  parallel_for(
      size_.height,
      [&](int y) {
        const RowIndex index(degree_);
        std::vector<double> factors(index.count()), values(static_cast<std::size_t>(width) * stride),
            along(stride);
        rows_.of_row(y, factors.data());
        // Q_00 is constant: its integral gives the row's solid angle.
        const double scale = width * std::sqrt(1 / (4 * kPi)) / factors[0];
        for (int f = 0; f < functions; ++f) {
          const int m = order_of(f);
          std::fill(along.begin(), along.end(), 0.0);
          for (int l = m; l <= degree_; ++l) {
            const double factor = scale * factors[index.first(m) + static_cast<std::size_t>(l - m)];
            const double* coefficient =
                &function.values()[static_cast<std::size_t>(index_of_function(l, f)) * stride];
            for (std::size_t c = 0; c < stride; ++c) along[c] += factor * coefficient[c];
          }
          const double* column = &columns[static_cast<std::size_t>(f * width)];
          for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            for (std::size_t c = 0; c < stride; ++c) values[x * stride + c] += column[x] * along[c];
          }
        }
        std::transform(values.begin(), values.end(), chart.row(y),
                       [](double v) { return static_cast<float>(v); });
      },
      monitor);
}

/// All around and for degrees below half the columns, functions of different orders are orthogonal over the
/// columns: Σ_x cos² mφ_x = columns/2.
SphericalHarmonics LongitudeHarmonics::through_texels(const SphericalHarmonics& function) const {
  const std::size_t channels = static_cast<std::size_t>(function.channels());
  return sum_of_bands(function.channels(), {}, [&](int from, int to, SphericalHarmonics& sums) {
    const RowIndex index(degree_);
    std::vector<double> factors(index.count()), along(channels);
    for (int y = from; y < to; ++y) {
      rows_.of_row(y, factors.data());
      const double scale = size_.width * std::sqrt(1 / (4 * kPi)) / factors[0];
      for (int f = 0; f < function_count(degree_); ++f) {
        const int m = order_of(f);
        const double* factor = &factors[index.first(m)];
        const double share = column_factor(longitudes_, size_.width, m);
        const double squares = share * share * size_.width * (m == 0 ? 1 : 0.5);
        std::fill(along.begin(), along.end(), 0.0);
        for (int l = m; l <= degree_; ++l) {
          const double* coefficient =
              &function.values()[static_cast<std::size_t>(index_of_function(l, f)) * channels];
          for (std::size_t c = 0; c < channels; ++c) along[c] += factor[l - m] * coefficient[c];
        }
        for (int l = m; l <= degree_; ++l) {
          double* sum = &sums.values()[static_cast<std::size_t>(index_of_function(l, f)) * channels];
          for (std::size_t c = 0; c < channels; ++c) sum[c] += scale * squares * factor[l - m] * along[c];
        }
      }
    }
  });
}

}  // namespace

std::unique_ptr<TexelHarmonics> make_longitude_harmonics(const MapFrame& frame, int degree) {
  const std::optional<Longitudes> longitudes = longitudes_of(frame.parameterization);
  if (!longitudes) return nullptr;
  return std::make_unique<LongitudeHarmonics>(frame, *longitudes, degree);
}

}  // namespace welkin::harmonics
