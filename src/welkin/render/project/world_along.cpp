#include "welkin/render/project/world_along.h"

#include "welkin/base/error.h"

namespace welkin::scene {

WorldAlong::WorldAlong(const ShadedScene& seen, std::function<Vec3d(double frame)> place,
                       const WorldAlongOptions& options)
    : seen_(seen), place_(std::move(place)), options_(options) {
  require(options.every >= 1 && options.every <= 100'000, "a world is projected every 1 to 100,000 frames");
  require(place_ != nullptr, "an object is somewhere");
}

const Map& WorldAlong::key(int frame, const Monitor& monitor) {
  if (const auto found = keys_.find(frame); found != keys_.end()) return found->second;
  const MapFrame to(sphere::AnyParameterization::make("latlong"), options_.size);
  Map made = project(seen_, place_(frame), to, {.samples = options_.samples, .monitor = monitor});
  ++made_;
  return keys_.emplace(frame, std::move(made)).first->second;
}

Map WorldAlong::at(int frame, const Monitor& monitor) {
  const int every = options_.every;
  int before = frame / every * every;
  if (before > frame) before -= every;
  // Of frames that go on, what lies behind is not needed any more.
  while (!keys_.empty() && keys_.begin()->first < before) keys_.erase(keys_.begin());
  const Map& first = key(before, monitor);
  if (before == frame) return first.clone();
  const Map& second = key(before + every, monitor);
  const float t = static_cast<float>(frame - before) / static_cast<float>(every);
  Map between = first.clone();
  const ImageView<float> to = between.level.chart(0);
  const ImageView<const float> from = second.level.chart(0);
  for (int y = -kBorder; y < between.height() + kBorder; ++y)
    for (int x = -kBorder; x < between.width() + kBorder; ++x)
      for (int c = 0; c < between.channels(); ++c) to.at(x, y)[c] += t * (from.at(x, y)[c] - to.at(x, y)[c]);
  return between;
}

}  // namespace welkin::scene
