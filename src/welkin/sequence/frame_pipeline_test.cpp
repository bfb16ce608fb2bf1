#include "welkin/sequence/frame_pipeline.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "welkin/base/error.h"

namespace welkin::sequence::test {
namespace {

struct Numbered {
  int number = 0, square = 0;
};

struct Ran {
  std::vector<int> put;
  int counted = 0;
  int taken = 0;
  std::string error;
};

/// Squares of 0 … 49; a stage fails at a number.
Ran run(int failing_take = -1, int failing_make = -1, int failing_put = -1) {
  Ran ran;
  FrameStages<Numbered> stages;
  stages.take = [&](Numbered& frame) {
    if (ran.taken == failing_take) throw Error(ErrorKind::damaged, "take");
    frame.number = ran.taken++;
    return frame.number < 50;
  };
  stages.make = [&](Numbered& frame) {
    if (frame.number == failing_make) throw Error(ErrorKind::damaged, "make");
    frame.square = frame.number * frame.number;
  };
  stages.put = [&](Numbered& frame) {
    if (frame.number == failing_put) throw Error(ErrorKind::damaged, "put");
    ran.put.push_back(frame.square);
  };
  try {
    run_frames<Numbered>(4, stages, ran.counted);
  } catch (const Error& error) {
    ran.error = error.cause();
  }
  EXPECT_EQ(ran.counted, static_cast<int>(ran.put.size()));
  for (std::size_t i = 0; i < ran.put.size(); ++i) EXPECT_EQ(ran.put[i], static_cast<int>(i * i));
  return ran;
}

TEST(FramePipeline, PutsAllInOrder) {
  const Ran ran = run();
  EXPECT_EQ(ran.error, "");
  EXPECT_EQ(ran.put.size(), 50u);
}

TEST(FramePipeline, AFailureKeepsWhatIsBeforeIt) {
  for (const auto& [ran, stage] :
       {std::pair{run(7), "take"}, {run(-1, 7), "make"}, {run(-1, -1, 7), "put"}}) {
    EXPECT_EQ(ran.error, stage);
    EXPECT_EQ(ran.put.size(), 7u) << stage;
    EXPECT_LE(ran.taken, 7 + 6) << stage << ": no more are begun";
  }
}

}  // namespace
}  // namespace welkin::sequence::test
