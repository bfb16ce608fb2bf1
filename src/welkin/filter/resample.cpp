#include "welkin/filter/resample.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample_job.h"
#include "welkin/map/borders.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

/// The source's own texels.
class CopyMaker final : public TexelMaker {
 public:
  explicit CopyMaker(ResampleJob job) : job_(std::move(job)) {}

  int rows() const override { return 8; }

  void make(const ChartPart& part, ImageView<float> out) const override {
    copy_walked(job_.source.level.chart(part.chart), part.walk, out);
    const auto& p = job_.target.parameterization;
    if (p.full_charts() || p.filled_to_edges()) return;
    // The fill in every texel that is not valid anywhere.
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        if (is_outside_texel(p, job_.target.size, part.chart, part.walk.image_x(x, y),
                             part.walk.image_y(x, y)))
          std::copy(job_.fill.begin(), job_.fill.end(), out.at(x, y));
      }
    }
  }

 private:
  const ResampleJob job_;
};

/// But for what rounding leaves of turns that add up to none.
bool are_alike(const Matrix3& a, const Matrix3& b) {
  double largest = 0;
  for (std::size_t i = 0; i < 9; ++i)
    largest = std::max(largest, std::fabs(a.rows[i / 3][i % 3] - b.rows[i / 3][i % 3]));
  return largest < 1e-12;
}

}  // namespace

std::unique_ptr<TexelMaker> make_texels(const Map& source, const MapFrame& target,
                                        const ResampleOptions& options) {
  if (options.positions && !options.positions->fit(source, target, options.rotation))
    throw Error(ErrorKind::mismatch, "positions were found for maps of another shape or orientation");
  ResampleJob job(source, target, options);
  const bool same = source.parameterization == target.parameterization &&
                    source.width() == target.size.width && source.height() == target.size.height &&
                    are_alike(source.orientation * transpose(options.rotation), target.orientation);
  if (same) return std::make_unique<CopyMaker>(std::move(job));
  if (options.filter == Filter::automatic) {
    job.options.positions = nullptr;
    return make_means(std::move(job));
  }
  const Fetch kernel = job.fetch_of(options.filter);
  return make_by_points(std::move(job), kernel);
}

void resample(const Map& source, Map& target, const ResampleOptions& options) {
  source.check();
  target.check();
  require(&source != &target, "a map is resampled into another");
  require(source.channels() == target.channels(),
          "the maps to resample between have other numbers of channels");
  require(is_orthonormal(options.rotation), "a world is turned by a rotation or a reflection");
  const auto maker = make_texels(source, target, options);
  const int bands = (target.height() + maker->rows() - 1) / maker->rows();
  parallel_for(
      target.charts() * bands,
      [&](int i) {
        ChartPart part;
        part.chart = i / bands;
        part.walk.start_y = i % bands * maker->rows();
        const int rows = std::min(maker->rows(), target.height() - part.walk.start_y);
        maker->make(part, target.level.chart(part.chart).part(0, part.walk.start_y, target.width(), rows));
      },
      options.monitor);
  if (options.borders) fill_borders(target, RimTexels::kept);
}

ChartSize default_chart_size(const Map& map, const sphere::AnyParameterization& parameterization) {
  // The valid part of its charts' area, on a grid fine enough for a few per mille.
  const auto used = [](const sphere::AnyParameterization& p) {
    constexpr int kGrid = 64;
    int valid = 0;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      if (p.valid(0, (i % kGrid + 0.5) / kGrid, (i / kGrid + 0.5) / kGrid)) ++valid;
    }
    return static_cast<double>(valid) / (kGrid * kGrid) * p.charts();
  };
  const double per_steradian =
      used(map.parameterization) * map.width() * map.height() / map.parameterization.coverage();
  const double texels = per_steradian * parameterization.coverage() / used(parameterization);
  const int width =
      std::max(2, 2 * static_cast<int>(std::lround(0.5 * std::sqrt(texels * parameterization.aspect()))));
  return {width, std::max(1, static_cast<int>(std::lround(width / parameterization.aspect())))};
}

}  // namespace welkin
