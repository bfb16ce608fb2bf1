#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/lookup/chart_unfolding.h"
#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/gaussian_boxes.h"
#include "welkin/lookup/summed_area.h"
#include "welkin/lookup/texel_shape.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

class SummedAreaLookUp final : public ConeLookUp {
 public:
  SummedAreaLookUp(const SharedMap& map, int boxes)
      : map_(map),
        unfolding_(map->parameterization, {map->width(), map->height()}),
        table_(*map),
        mean_(mean_over_sphere(*map)),
        boxes_(boxes) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    for (const AimedCone& cone : cones) {
      look_up_one(cone, radiance);
      radiance += map_->channels();
    }
  }

 private:
  void look_up_one(const AimedCone& cone, float* out) const {
    const auto& p = map_->parameterization;
    const ChartSize size{map_->width(), map_->height()};
    const TangentPlane plane(normalize(to_double(cone.direction)), to_double(cone.axis));
    const double wide = static_cast<double>(cone.wide), narrow = static_cast<double>(cone.narrow);
    const Covariance texels =
        texel_sides(p, size, plane).to_texels(Covariance{wide * wide, 0, narrow * narrow});
    const auto position = p.from_sphere(plane.normal);
    const double x = std::clamp(position.u, 0.0, 1.0) * size.width,
                 y = std::clamp(position.v, 0.0, 1.0) * size.height;
    std::array<double, kMaxChannels> sum{};
    for (int k = 0; k < boxes_; ++k) {
      const GaussianBox& box = kGaussianBoxes[boxes_ - 1][k];
      add_box(static_cast<int>(position.chart), x, y, box.half * std::sqrt(texels.xx),
              box.half * std::sqrt(texels.yy), box.share, sum.data());
    }
    for (int c = 0; c < map_->channels(); ++c) out[c] = static_cast<float>(sum[static_cast<std::size_t>(c)]);
  }

  /// Adds share × the mean over a box, at least a texel wide. The part of its variance that a box as wide as
  /// a chart lacks is made up by the mean over the sphere.
  void add_box(int chart, double x, double y, double half_x, double half_y, double share, double* sum) const {
    const double most_x = 0.5 * map_->width(), most_y = 0.5 * map_->height();
    const double over = std::max(half_y / most_y, unfolding_.goes_around() ? 0 : half_x / most_x);
    const double mean = over > 1 ? 1 - 1 / (over * over) : 0;
    half_x = std::clamp(half_x, 0.5, most_x);
    half_y = std::clamp(half_y, 0.5, most_y);
    std::array<double, kMaxChannels + 1> box{};
    const auto parts = unfolding_.parts_of({chart, x - half_x, y - half_y, x + half_x, y + half_y});
    for (int i = 0; i < parts.count; ++i) table_.add(parts.list[i], 1, box.data());
    const std::size_t channels = static_cast<std::size_t>(map_->channels());
    const double scale = (1 - mean) * share / box[channels];
    for (std::size_t c = 0; c < channels; ++c) {
      sum[c] += scale * box[c] + mean * share * static_cast<double>(mean_[c]);
    }
  }

  SharedMap map_;
  ChartUnfolding unfolding_;
  SummedArea table_;
  std::vector<float> mean_;
  int boxes_;
};

}  // namespace

ConeLookUpPtr make_summed_area(const SharedMap& map, const ConeSamplerOptions& options) {
  if (options.boxes < 1 || options.boxes > kMostBoxes) {
    throw Error(ErrorKind::bad_request, "look-up: " + std::to_string(options.boxes) +
                                            " boxes; there can be 1 to " + std::to_string(kMostBoxes));
  }
  return std::make_unique<SummedAreaLookUp>(map, options.boxes);
}

}  // namespace welkin
