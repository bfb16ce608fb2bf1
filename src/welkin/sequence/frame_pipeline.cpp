#include "welkin/sequence/frame_pipeline.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "welkin/sequence/failures.h"

namespace welkin::sequence {

std::size_t usual_frames_at_once() {
  return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
}

void run_any_frames(std::size_t at_once, const AnyFrameStages& stages, int& put_frames) {
  struct Travelling {
    std::shared_ptr<void> frame;
    int number = 0;
    bool failed = false;
  };
  using Traveller = std::shared_ptr<Travelling>;
  Failures failures;
  int taken = 0;
  bool broken = false;  // what follows a gap is not put
  const auto take = [&](tbb::flow_control& control) -> Traveller {
    auto next = std::make_shared<Travelling>();
    next->number = taken++;
    if (!failures.any()) failures.guard(next->number, [&] { next->frame = stages.take(); });
    if (next->frame) return next;
    control.stop();
    return nullptr;
  };
  const auto make = [&](Traveller traveller) {
    traveller->failed = true;
    failures.guard(traveller->number, [&] {
      // A thread that waits for the loops of this frame doesn't begin another.
      tbb::this_task_arena::isolate([&] { stages.make(traveller->frame.get()); });
      traveller->failed = false;
    });
    return traveller;
  };
  const auto put = [&](const Traveller& traveller) {
    broken = broken || traveller->failed;
    if (broken) return;
    broken = true;
    failures.guard(traveller->number, [&] {
      stages.put(traveller->frame.get());
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
