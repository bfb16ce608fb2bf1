#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>
#include <memory>

#include "welkin/sequence/failures.h"

/// Frames that are read, made and written at the same time.
namespace welkin::sequence {

/// What is done with each frame.
template <class Frame>
struct FrameStages {
  /// The next frame, or false where there is none. In order, one at a time.
  std::function<bool(Frame& frame)> take;
  /// Several frames at the same time.
  std::function<void(Frame& frame)> make;
  /// In order, one at a time.
  std::function<void(Frame& frame)> put;
};

/// All frames, up to `at_once` of them in work. When one fails, no other is begun; those before it are put,
/// those after it are not, and what it threw is thrown after all work. `put_frames` counts those that were
/// put, then too.
template <class Frame>
void run_frames(std::size_t at_once, const FrameStages<Frame>& stages, int& put_frames) {
  struct Travelling {
    Frame frame;
    int number = 0;
    bool failed = false;
  };
  using Traveller = std::shared_ptr<Travelling>;
  Failures failures;
  int taken = 0;
  bool broken = false;  // of a stream that is put, what follows a gap is not
  const auto take = [&](tbb::flow_control& control) -> Traveller {
    auto next = std::make_shared<Travelling>();
    next->number = taken++;
    bool any = false;
    if (!failures.any()) failures.guard(next->number, [&] { any = stages.take(next->frame); });
    if (any) return next;
    control.stop();
    return nullptr;
  };
  const auto make = [&](Traveller traveller) {
    traveller->failed = true;
    failures.guard(traveller->number, [&] {
      // A thread that waits for the loops of this frame doesn't begin another.
      tbb::this_task_arena::isolate([&] { stages.make(traveller->frame); });
      traveller->failed = false;
    });
    return traveller;
  };
  const auto put = [&](const Traveller& traveller) {
    broken = broken || traveller->failed;
    if (broken) return;
    broken = true;
    failures.guard(traveller->number, [&] {
      stages.put(traveller->frame);
      broken = false;
      ++put_frames;
    });
  };
  // Isolated: not cancelled with a caller's tasks, see Failures.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  tbb::parallel_pipeline(at_once,
                         tbb::make_filter<void, Traveller>(tbb::filter_mode::serial_in_order, take) &
                             tbb::make_filter<Traveller, Traveller>(tbb::filter_mode::parallel, make) &
                             tbb::make_filter<Traveller, void>(tbb::filter_mode::serial_in_order, put),
                         context);
  failures.rethrow();
}

}  // namespace welkin::sequence
