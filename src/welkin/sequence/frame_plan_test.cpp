#include "welkin/sequence/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin::sequence {
namespace {

const auto kAll = [](int) { return true; };
const auto kNone = [](int) { return false; };

std::vector<int> frames_of(const std::vector<BakedFrame>& baked, bool (*which)(const BakedFrame&)) {
  std::vector<int> frames;
  for (const BakedFrame& each : baked) {
    if (which(each)) frames.push_back(each.frame);
  }
  return frames;
}
bool any(const BakedFrame&) {
  return true;
}
bool is_key(const BakedFrame& each) {
  return each.key;
}
bool is_held_out(const BakedFrame& each) {
  return !each.key;
}
bool is_written(const BakedFrame& each) {
  return each.write;
}
bool is_joined(const BakedFrame& each) {
  return each.joins;
}

using Frames = std::vector<int>;

TEST(KeyFrames, BeginWithTheFirstAndEndWithTheLast) {
  EXPECT_EQ(key_frames({1, 30}, 10), (Frames{1, 11, 21, 30}));
  EXPECT_EQ(key_frames({1, 31}, 10), (Frames{1, 11, 21, 31}));
  EXPECT_EQ(key_frames({5, 7}, 10), (Frames{5, 7}));
  EXPECT_EQ(key_frames({5, 5}, 10), (Frames{5}));
  EXPECT_EQ(key_frames({5, 8}, 1), (Frames{5, 6, 7, 8}));
  EXPECT_EQ(key_frames({0, FrameNames::kLargest}, FrameNames::kLargest), (Frames{0, FrameNames::kLargest}));
  EXPECT_THROW(key_frames({0, FrameNames::kLargest}, 1), Error);
  EXPECT_THROW(key_frames({2, 1}, 1), Error);
  EXPECT_THROW(key_frames({1, 2}, 0), Error);
}

TEST(FramePlan, EveryFrameIsBakedOrInterpolated) {
  for (const int every : {1, 2, 3, 10, 100}) {
    const FramePlan plan = plan_frames({3, 40}, {every, true, 4}, kAll, kNone);
    Frames made = frames_of(plan.baked, is_written);
    EXPECT_EQ(made, key_frames({3, 40}, every));
    made.insert(made.end(), plan.interpolated.begin(), plan.interpolated.end());
    std::sort(made.begin(), made.end());
    EXPECT_EQ(made, plan.frames);
    EXPECT_EQ(plan.frames, key_frames({3, 40}, 1));
  }
}

TEST(FramePlan, HeldOutFramesAreMiddlesSpreadEvenly) {
  const FramePlan plan = plan_frames({0, 100}, {10, true, 2}, kAll, kNone);
  EXPECT_EQ(frames_of(plan.baked, is_held_out), (Frames{25, 75}));
  EXPECT_EQ(frames_of(plan_frames({0, 100}, {10, true, 100}, kAll, kNone).baked, is_held_out).size(), 10u);
  // Where there is a source, and never a key frame.
  const auto even = [](int frame) { return frame % 2 == 0; };
  EXPECT_EQ(frames_of(plan_frames({0, 100}, {10, true, 2}, even, kNone).baked, is_held_out),
            (Frames{26, 76}));
  const auto keys = [](int frame) { return frame % 10 == 0; };
  EXPECT_TRUE(frames_of(plan_frames({0, 100}, {10, true, 2}, keys, kNone).baked, is_held_out).empty());
  EXPECT_TRUE(frames_of(plan_frames({0, 100}, {1, true, 2}, kAll, kNone).baked, is_held_out).empty());
}

TEST(FramePlan, KeysAloneAreJoinedWhereOneIsHeldOut) {
  const FramePlan plan = plan_frames({0, 30}, {10, false, 1}, kAll, kNone);
  EXPECT_EQ(plan.frames, (Frames{0, 10, 20, 30}));
  EXPECT_TRUE(plan.interpolated.empty());
  EXPECT_EQ(frames_of(plan.baked, is_held_out), (Frames{15}));
  EXPECT_EQ(frames_of(plan.baked, is_joined), (Frames{20}));
}

// Of what is complete nothing is made again but the keys that others need.
TEST(FramePlan, ResumesWhereFramesAreMissing) {
  const auto complete = [](int frame) { return frame != 14 && frame != 20; };
  const FramePlan plan = plan_frames({0, 40}, {10, true, 0}, kAll, complete);
  EXPECT_EQ(plan.interpolated, (Frames{14}));
  EXPECT_EQ(frames_of(plan.baked, any), (Frames{10, 20}));
  EXPECT_EQ(frames_of(plan.baked, is_written), (Frames{20}));
  EXPECT_EQ(frames_of(plan.baked, is_key), (Frames{10, 20}));
  EXPECT_EQ(frames_of(plan.baked, is_joined), (Frames{20}));
  EXPECT_EQ(plan.complete.size(), 39u);
  EXPECT_TRUE(plan_frames({0, 40}, {10, true, 4}, kAll, kAll).baked.empty());
}

}  // namespace
}  // namespace welkin::sequence
