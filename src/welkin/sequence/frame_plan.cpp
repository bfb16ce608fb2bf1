#include "welkin/sequence/frame_plan.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "welkin/base/error.h"

namespace welkin::sequence {
namespace {

/// The frame between two key frames that is nearest to their middle and has a source.
std::optional<int> middle_of(int from, int to, const std::function<bool(int)>& exists) {
  const int middle = from + (to - from) / 2;
  for (int distance = 0; distance < to - from; ++distance) {
    for (const int frame : {middle + distance, middle - distance}) {
      if (frame > from && frame < to && exists(frame)) return frame;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<int> key_frames(FrameRange range, int every) {
  require(range.first >= 0 && range.first <= range.last && range.last <= FrameNames::kLargest && every >= 1,
          "key frames are of a range that goes up, every 1 or more");
  const std::int64_t count = (std::int64_t{range.last} - range.first) / every + 2;
  if (count > kMostFrames)
    throw Error(ErrorKind::too_large, "frames " + std::to_string(range.first) + " to " +
                                          std::to_string(range.last) + " are over " +
                                          std::to_string(kMostFrames) + ": ask for fewer");
  std::vector<int> keys;
  for (std::int64_t frame = range.first; frame < range.last; frame += every)
    keys.push_back(static_cast<int>(frame));
  keys.push_back(range.last);
  return keys;
}

FramePlan plan_frames(FrameRange range, const FramePlanOptions& options,
                      const std::function<bool(int)>& exists, const std::function<bool(int)>& complete) {
  const std::vector<int> keys = key_frames(range, options.every);
  FramePlan plan;
  plan.frames = options.between ? key_frames(range, 1) : keys;
  std::set<int> done;
  for (const int frame : plan.frames) {
    if (complete(frame)) done.insert(frame);
  }
  plan.complete.assign(done.begin(), done.end());
  std::map<int, BakedFrame> baked;
  for (const int key : keys) {
    if (done.count(key) == 0) baked[key] = {key};
  }

  // Between which keys there is something to make or to measure.
  std::vector<std::size_t> open;
  std::vector<std::pair<std::size_t, int>> candidates;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    bool wanted = false;
    if (options.between) {
      for (int frame = keys[i] + 1; frame < keys[i + 1]; ++frame) {
        if (done.count(frame) > 0) continue;
        wanted = true;
        plan.interpolated.push_back(frame);
      }
    } else {
      wanted = baked.count(keys[i]) + baked.count(keys[i + 1]) > 0;
    }
    if (!wanted) continue;
    if (options.between) open.push_back(i);
    if (options.held_out == 0) continue;
    if (const std::optional<int> middle = middle_of(keys[i], keys[i + 1], exists))
      candidates.emplace_back(i, *middle);
  }
  const std::size_t count = std::min(candidates.size(), static_cast<std::size_t>(options.held_out));
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [i, frame] = candidates[(2 * k + 1) * candidates.size() / (2 * count)];
    baked[frame] = {frame, false, false, false};
    open.push_back(i);
  }
  for (const std::size_t i : open) {
    for (const int key : {keys[i], keys[i + 1]}) baked.try_emplace(key, BakedFrame{key, true, false, false});
    baked[keys[i + 1]].joins = true;
  }
  for (const auto& [frame, each] : baked) plan.baked.push_back(each);
  return plan;
}

}  // namespace welkin::sequence
