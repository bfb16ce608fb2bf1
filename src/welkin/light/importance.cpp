#include "welkin/light/importance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/light/importance_tables.h"
#include "welkin/light/importance_texel.h"
#include "welkin/map/luminance.h"
#include "welkin/map/texel_points.h"

namespace welkin {

using namespace light;

ImportanceMethod importance_method_from_name(std::string_view name) {
  if (name == "cdf") return ImportanceMethod::cdf;
  if (name == "alias") return ImportanceMethod::alias;
  const std::array<std::string, 2> names{"alias", "cdf"};
  throw Error(ErrorKind::bad_request, unknown_name("method", name, names));
}

std::string_view name_of(ImportanceMethod method) {
  return method == ImportanceMethod::cdf ? "cdf" : "alias";
}

namespace {

/// Mean luminance that is this close to a texel's is the texel's own: of a map of one radiance, compensation
/// leaves nothing, not rounding errors.
constexpr double kSameLuminance = 1e-5;

/// The luminance of texels, as options ask for it.
class LuminanceOf {
 public:
  LuminanceOf(const Map& map, Filter look_up)
      : map_(map), luminance_(map.channel_names), bilinear_(look_up == Filter::bilinear) {}

  struct RowFaults {
    std::uint64_t not_finite = 0, negative = 0;
  };
  RowFaults row(int chart, int y, float* out) const {
    const ImageView<const float> texels = map_.level.chart(chart);
    RowFaults faults;
    for (int x = 0; x < map_.width(); ++x) {
      const float own = luminance_(texels.at(x, y));
      if (!std::isfinite(own)) ++faults.not_finite;
      if (own < 0) ++faults.negative;
      out[x] = bilinear_ ? interpolated(texels, x, y) : std::max(own, 0.0f);
    }
    return faults;
  }

 private:
  /// The mean over a texel of bilinear interpolation. Borders of texels that aren't finite aren't either, and
  /// don't count here: those texels are refused.
  float interpolated(const ImageView<const float>& texels, int x, int y) const {
    constexpr float kShare[3] = {0.125f, 0.75f, 0.125f};
    float sum = 0;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const float each = luminance_(texels.at(x + i - 1, y + j - 1));
        if (each > 0 && std::isfinite(each)) sum += kShare[i] * kShare[j] * each;
      }
    }
    return sum;
  }

  const Map& map_;
  TexelLuminance luminance_;
  bool bilinear_;
};

void solid_angles_of_row(const MapFrame& frame, int chart, int y, float* out) {
  texel_solid_angles(frame.parameterization, frame.size.width, frame.size.height, chart, y, out);
}

/// Area of the valid part of a texel, over the texel's.
double valid_area(const MapFrame& frame, int chart, int x, int y) {
  std::vector<TexelPoint> points;
  const auto& p = frame.parameterization;
  append_points(p, texel_cell(frame.size, chart, x, y), texel_limits(p, frame.size), points);
  double area = 0;
  for (const TexelPoint& point : points) {
    const auto at = p.from_sphere(point.direction);
    area += point.solid_angle / p.solid_angle_density(chart, at.u, at.v);
  }
  return area * frame.size.width * frame.size.height;
}

}  // namespace

class ImportanceSampler::State {
 public:
  State(const Map& map, const ImportanceOptions& options, const Monitor& monitor)
      : options_(options),
        frame_(map),
        to_world_(transpose(map.orientation)),
        rows_(static_cast<std::uint32_t>(map.charts() * map.height())),
        width_(static_cast<std::uint32_t>(map.width())),
        texels_(static_cast<double>(map.width()) * map.height()),
        texel_width_(1.0 / map.width()),
        texel_height_(1.0 / map.height()) {
    std::vector<float> luminance(static_cast<std::size_t>(rows_) * width_), omega(luminance.size());
    read(map, luminance, omega, part_of(monitor, 0, 0.4));
    patterns_.emplace(frame_, omega, part_of(monitor, 0.4, 0.6));
    weigh(luminance, omega);
    tabulate(luminance, omega, part_of(monitor, 0.6, 1));
  }

  Choice choose(double u1, double u2) const {
    return cdf_ ? cdf_->choose(limited(u1), limited(u2)) : alias_->choose(limited(u1), limited(u2));
  }

  ImportanceDraw place(const Choice& choice) const {
    ImportanceDraw draw;
    draw.x = static_cast<int>(choice.column);
    draw.y = static_cast<int>(choice.row);
    // No division for the few charts that there are.
    while (draw.y >= frame_.size.height) {
      draw.y -= frame_.size.height;
      ++draw.chart;
    }
    PlaceInTexel place{inset(choice.s), inset(choice.t), 1};
    if (const TexelPattern* pattern = patterns_->find(choice.row, choice.column))
      place = pattern->place(frame_, draw.chart, draw.x, draw.y, choice.s, choice.t);
    const double u = (draw.x + place.x) * texel_width_, v = (draw.y + place.y) * texel_height_;
    draw.direction = to_world_ * frame_.parameterization.to_sphere(draw.chart, u, v);
    draw.pdf = per_solid_angle(choice.probability * place.density, draw.chart, u, v);
    return draw;
  }

  double pdf(const Vec3d& direction) const {
    const double longest = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
    if (!std::isfinite(direction.x + direction.y + direction.z) || longest == 0) return 0;
    const Vec3d d = frame_.orientation * normalize((1 / longest) * direction);
    const auto& p = frame_.parameterization;
    if (!p.covers(d)) return 0;
    const auto at = p.from_sphere(d);
    const int chart = static_cast<int>(at.chart);
    const double column = at.u * frame_.size.width, row = at.v * frame_.size.height;
    const int x = std::clamp(static_cast<int>(column), 0, frame_.size.width - 1);
    const int y = std::clamp(static_cast<int>(row), 0, frame_.size.height - 1);
    const double probability = probability_of(chart, x, y);
    if (probability == 0) return 0;
    double density = 1;
    if (const TexelPattern* pattern = patterns_->find(row_of(chart, y), static_cast<std::uint32_t>(x)))
      density = pattern->density(frame_, chart, x, y, clamp(column - x, 0.0, 1.0), clamp(row - y, 0.0, 1.0));
    return per_solid_angle(probability * density, chart, at.u, at.v);
  }

  double probability_of(int chart, int x, int y) const {
    const std::uint32_t row = row_of(chart, y), column = static_cast<std::uint32_t>(x);
    return cdf_ ? cdf_->probability(row, column) : alias_->probability(row, column);
  }

  const ImportanceOptions& options() const { return options_; }
  const MapFrame& frame() const { return frame_; }
  bool is_uniform() const { return uniform_; }
  std::uint64_t negative() const { return negative_; }
  double mean() const { return integral_ / covered_; }
  double integral() const { return integral_; }
  std::uint32_t rows() const { return rows_; }
  std::uint32_t width() const { return width_; }
  const RowColumnTable& cdf() const {
    require(cdf_.has_value(), "importance sampling: the sampler draws by alias table and has no cdf");
    return *cdf_;
  }
  const AliasTable& alias() const {
    require(alias_.has_value(), "importance sampling: the sampler draws by cdf and has no alias table");
    return *alias_;
  }

 private:
  static double limited(double u) { return u > 0 ? std::min(u, kBelowOne) : 0; }
  std::uint32_t row_of(int chart, int y) const {
    return static_cast<std::uint32_t>(chart * frame_.size.height + y);
  }
  double per_solid_angle(double probability, int chart, double u, double v) const {
    const double density = frame_.parameterization.solid_angle_density(chart, u, v);
    return density > 0 ? probability * texels_ / density : 0;
  }

  /// Throws for values that aren't finite.
  void read(const Map& map, std::vector<float>& luminance, std::vector<float>& omega,
            const Monitor& monitor) {
    const LuminanceOf luminance_of(map, options_.look_up);
    std::vector<LuminanceOf::RowFaults> faults(rows_);
    parallel_for(
        static_cast<int>(rows_),
        [&](int row) {
          const int chart = row / map.height(), y = row % map.height();
          const std::size_t first = static_cast<std::size_t>(row) * width_;
          solid_angles_of_row(frame_, chart, y, &omega[first]);
          faults[static_cast<std::size_t>(row)] = luminance_of.row(chart, y, &luminance[first]);
        },
        monitor);
    std::uint64_t not_finite = 0;
    for (const auto& row : faults) {
      not_finite += row.not_finite;
      negative_ += row.negative;
    }
    if (not_finite > 0)
      throw Error(ErrorKind::bad_value,
                  "importance sampling: " + std::to_string(not_finite) +
                      " texels have luminance that is NaN or infinite; replace them first");
  }

  /// Luminance becomes weight per solid angle.
  void weigh(std::vector<float>& luminance, const std::vector<float>& omega) {
    for (std::uint32_t row = 0; row < rows_; ++row) {
      double integral = 0, covered = 0;
      const std::size_t first = static_cast<std::size_t>(row) * width_;
      for (std::size_t i = first; i < first + width_; ++i) {
        integral += static_cast<double>(luminance[i]) * static_cast<double>(omega[i]);
        covered += static_cast<double>(omega[i]);
      }
      integral_ += integral;
      covered_ += covered;
    }
    if (!(covered_ > 0)) throw Error(ErrorKind::bad_value, "importance sampling: the map shows no direction");
    bool any = false;
    const double above = options_.compensate ? mean() * (1 + kSameLuminance) : 0;
    for (std::size_t i = 0; i < luminance.size(); ++i) {
      const double value = static_cast<double>(luminance[i]);
      luminance[i] = value > above ? static_cast<float>(value - (options_.compensate ? mean() : 0)) : 0.0f;
      any |= luminance[i] > 0 && omega[i] > 0;
    }
    uniform_ = !any;
    if (uniform_) std::fill(luminance.begin(), luminance.end(), 1.0f);
  }

  void tabulate(const std::vector<float>& weight, const std::vector<float>& omega, const Monitor& monitor) {
    const auto of_row = [&](int row, double* out) {
      const std::size_t first = static_cast<std::size_t>(row) * width_;
      for (std::size_t x = 0; x < width_; ++x)
        out[x] = static_cast<double>(weight[first + x]) * static_cast<double>(omega[first + x]);
    };
    if (options_.method == ImportanceMethod::alias) {
      std::vector<double> weights(weight.size());
      parallel_for(
          static_cast<int>(rows_),
          [&](int row) { of_row(row, &weights[static_cast<std::size_t>(row) * width_]); }, monitor);
      alias_.emplace(width_, std::move(weights));
      return;
    }
    cdf_.emplace(rows_, width_);
    std::vector<double> row_weights(rows_);
    parallel_for(
        static_cast<int>(rows_),
        [&](int row) {
          std::vector<double> weights(width_);
          of_row(row, weights.data());
          cdf_->set_row(static_cast<std::uint32_t>(row), weights);
          double sum = 0;
          for (const double each : weights) sum += each;
          row_weights[static_cast<std::size_t>(row)] = sum;
        },
        monitor);
    cdf_->finish(row_weights);
  }

  ImportanceOptions options_;
  MapFrame frame_;
  Matrix3 to_world_;
  std::uint32_t rows_, width_;
  double texels_;  ///< of a chart
  double texel_width_, texel_height_;
  std::optional<TexelPatterns> patterns_;
  std::optional<RowColumnTable> cdf_;
  std::optional<AliasTable> alias_;
  bool uniform_ = false;
  std::uint64_t negative_ = 0;
  double covered_ = 0, integral_ = 0;
};

namespace {

const ImportanceOptions& checked(const Map& map, const ImportanceOptions& options) {
  map.check();
  require(options.look_up == Filter::nearest || options.look_up == Filter::bilinear,
          "importance sampling: radiance is looked up by nearest or bilinear");
  const double texels = static_cast<double>(map.charts()) * map.width() * map.height();
  if (!(texels < 0x1p31))
    throw Error(ErrorKind::too_large, "importance sampling: the map has 2³¹ texels or more");
  return options;
}

}  // namespace

ImportanceSampler::ImportanceSampler(const Map& map, const ImportanceOptions& options, const Monitor& monitor)
    : state_(std::make_shared<const State>(map, checked(map, options), monitor)) {}

ImportanceDraw ImportanceSampler::draw(double u1, double u2) const {
  return state_->place(state_->choose(u1, u2));
}

void ImportanceSampler::draw(std::span<const double> u1, std::span<const double> u2,
                             std::span<ImportanceDraw> draws) const {
  require(u1.size() == u2.size() && u1.size() == draws.size(),
          "importance sampling: as many draws as pairs of numbers");
  constexpr std::size_t kBatch = 64;
  std::array<Choice, kBatch> choices;
  for (std::size_t from = 0; from < draws.size(); from += kBatch) {
    const std::size_t count = std::min(kBatch, draws.size() - from);
    for (std::size_t i = 0; i < count; ++i) choices[i] = state_->choose(u1[from + i], u2[from + i]);
    for (std::size_t i = 0; i < count; ++i) draws[from + i] = state_->place(choices[i]);
  }
}
double ImportanceSampler::pdf(const Vec3d& direction) const {
  return state_->pdf(direction);
}
const ImportanceOptions& ImportanceSampler::options() const {
  return state_->options();
}
const MapFrame& ImportanceSampler::frame() const {
  return state_->frame();
}
bool ImportanceSampler::is_uniform() const {
  return state_->is_uniform();
}
std::uint64_t ImportanceSampler::negative_texels() const {
  return state_->negative();
}
double ImportanceSampler::mean_luminance() const {
  return state_->mean();
}
double ImportanceSampler::integral() const {
  return state_->integral();
}

double ImportanceSampler::probability(int chart, int x, int y) const {
  const MapFrame& map = state_->frame();
  require(chart >= 0 && chart < map.parameterization.charts() && x >= 0 && x < map.size.width && y >= 0 &&
              y < map.size.height,
          "importance sampling: there is no such texel");
  return state_->probability_of(chart, x, y);
}

namespace {

void check_row(int row, std::uint32_t rows) {
  require(row >= 0 && static_cast<std::uint32_t>(row) < rows, "importance sampling: there is no such row");
}

std::vector<double> ends_of(const Cdf& cdf, std::uint32_t which, std::uint32_t count) {
  std::vector<double> ends(count);
  for (std::uint32_t i = 0; i < count; ++i) ends[i] = cdf.end(which, i);
  return ends;
}

}  // namespace

std::vector<double> ImportanceSampler::marginal_cdf() const {
  return ends_of(state_->cdf().marginal(), 0, state_->rows());
}

std::vector<double> ImportanceSampler::conditional_cdf(int row) const {
  check_row(row, state_->rows());
  return ends_of(state_->cdf().conditional(), static_cast<std::uint32_t>(row), state_->width());
}

std::vector<ImportanceSampler::Alias> ImportanceSampler::alias_row(int row) const {
  check_row(row, state_->rows());
  std::vector<Alias> entries(state_->width());
  for (std::uint32_t x = 0; x < state_->width(); ++x) {
    const AliasTable::Entry& entry = state_->alias().entry(static_cast<std::uint32_t>(row), x);
    entries[x] = {entry.threshold, entry.alias};
  }
  return entries;
}

std::vector<double> ImportanceSampler::valid_areas(int row) const {
  check_row(row, state_->rows());
  const MapFrame& map = state_->frame();
  const int chart = row / map.size.height, y = row % map.size.height;
  std::vector<double> areas(state_->width(), 1);
  if (map.parameterization.full_charts()) return areas;
  const std::vector<TexelKind> kinds = texel_kinds(map.parameterization, map.size, chart, y);
  for (std::size_t x = 0; x < areas.size(); ++x) {
    if (kinds[x] == TexelKind::outside) areas[x] = 0;
    if (kinds[x] == TexelKind::irregular)
      areas[x] = std::min(1.0, valid_area(map, chart, static_cast<int>(x), y));
  }
  return areas;
}

}  // namespace welkin
