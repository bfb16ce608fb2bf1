#include "welkin/prefilter/view_stack.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// A level and the next, of which the second counts for `part`.
struct LevelPosition {
  std::size_t below;
  double part;
};

LevelPosition split(double level, int levels) {
  const double below = std::min(std::floor(level), std::max(0.0, levels - 2.0));
  return {static_cast<std::size_t>(below), level - below};
}

double between(const ViewTable& table, const ViewPosition& view, std::size_t level) {
  const double a = table.at(view.below, level), b = table.at(view.above, level);
  return a + view.part * (b - a);
}

}  // namespace

ViewStack::ViewStack(ViewChains stack, const SamplerOptions& options) {
  stack.check();
  notes_ = std::move(stack.notes);
  roughness_ = stack.views.front().notes.roughness;
  channels_ = stack.views.front().levels.front().channels();
  levels_ = static_cast<int>(stack.views.front().levels.size());
  for (Chain& chain : stack.views) samplers_.emplace_back(std::move(chain), options);
}

Vec3d ViewStack::look_up_direction(const Vec3d& normal, const Vec3d& view, double lift) {
  const Vec3d reflected = 2 * dot(normal, view) * normal - view;
  // Turned towards the normal; r and n hold the angle between them, whatever the side of v.
  const double angle = angle_between(reflected, normal), sine = std::sin(angle);
  if (!(sine > 1e-9)) return reflected;
  const double a = std::sin((1 - lift) * angle) / sine, b = std::sin(lift * angle) / sine;
  return a * reflected + b * normal;
}

void ViewStack::check_level(double level) const {
  if (level >= 0 && level <= levels_ - 1) return;
  throw Error(ErrorKind::bad_request,
              "level " + number_text(level) + " is not in 0…" + std::to_string(levels_ - 1));
}

void ViewStack::look_up(const Vec3d& normal, const Vec3d& view, std::span<float> radiance,
                        double level) const {
  check_level(level);
  require(radiance.size() >= static_cast<std::size_t>(channels_), "a look-up has room for all channels");
  const ViewPosition at = view_position(notes_.view_cosines, dot(normal, view));
  const LevelPosition where = split(level, levels_);
  std::array<float, kMaxChannels> values;
  std::array<double, kMaxChannels> sums{};
  const auto count = static_cast<std::size_t>(channels_);
  for (std::size_t k = 0; k < 2; ++k) {
    const double level_part = k == 0 ? 1 - where.part : where.part;
    if (level_part == 0) continue;
    const std::size_t which = where.below + k;
    const Vec3d direction = look_up_direction(normal, view, between(notes_.lift, at, which));
    for (std::size_t i = 0; i < 2; ++i) {
      const double part = level_part * (i == 0 ? 1 - at.part : at.part);
      if (part == 0) continue;
      samplers_[i == 0 ? at.below : at.above].look_up(direction, values, static_cast<double>(which));
      for (std::size_t c = 0; c < count; ++c) sums[c] += part * static_cast<double>(values[c]);
    }
  }
  for (std::size_t c = 0; c < count; ++c) radiance[c] = static_cast<float>(sums[c]);
}

std::array<float, 3> ViewStack::rgb(const Vec3d& normal, const Vec3d& view, double level) const {
  require(channels_ >= 3, "the stack has fewer than three channels");
  std::array<float, kMaxChannels> values;
  look_up(normal, view, values, level);
  return {values[0], values[1], values[2]};
}

double ViewStack::albedo(double view_cosine, double level) const {
  check_level(level);
  const ViewPosition at = view_position(notes_.view_cosines, view_cosine);
  const LevelPosition where = split(level, levels_);
  const double below = between(notes_.albedo, at, where.below);
  if (where.part == 0) return below;
  return below + where.part * (between(notes_.albedo, at, where.below + 1) - below);
}

double ViewStack::level_of(double roughness) const {
  if (roughness_.empty() || static_cast<int>(roughness_.size()) != levels_)
    throw Error(ErrorKind::bad_request, "the stack's levels have no roughness");
  if (!(roughness >= roughness_.front() && roughness <= roughness_.back()))
    throw Error(ErrorKind::bad_request, "the roughness " + number_text(roughness) +
                                            " is not in the stack's " + number_text(roughness_.front()) +
                                            "…" + number_text(roughness_.back()));
  const auto next = std::upper_bound(roughness_.begin(), roughness_.end(), roughness);
  if (next == roughness_.end()) return levels_ - 1;
  const auto above = static_cast<std::size_t>(next - roughness_.begin());
  return static_cast<double>(above) - 1 +
         (roughness - roughness_[above - 1]) / (roughness_[above] - roughness_[above - 1]);
}

}  // namespace welkin
