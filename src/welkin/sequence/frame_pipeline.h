#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "welkin/base/export.h"

/// @file
/// Frames that are read, made and written at the same time.
namespace welkin::sequence {

/// What is done with each frame, of a type of the caller's that is made by its default constructor.
template <class Frame>
struct FrameStages {
  /// Fills in the next frame, or returns false where there is none. In order, one at a time.
  std::function<bool(Frame& frame)> take;
  /// Several frames at the same time; may run parallel loops of its own.
  std::function<void(Frame& frame)> make;
  /// In order, one at a time.
  std::function<void(Frame& frame)> put;
};

/// @cond INTERNAL
struct AnyFrameStages {
  std::function<std::shared_ptr<void>()> take;  ///< null: there are no more
  std::function<void(void*)> make, put;
};
WELKIN_API void run_any_frames(std::size_t at_once, const AnyFrameStages& stages, int& put_frames);
/// @endcond

/// Frames in work at once that keep all threads busy while others are read and written.
WELKIN_API std::size_t usual_frames_at_once();

/// All frames, up to `at_once` of them in work. When one fails, no other is begun; those before it are put,
/// those after it are not, and what it threw is thrown after all work. `put_frames` counts those that were
/// put, then too.
template <class Frame>
void run_frames(std::size_t at_once, const FrameStages<Frame>& stages, int& put_frames) {
  const auto frame_of = [](void* frame) -> Frame& { return *static_cast<Frame*>(frame); };
  run_any_frames(
      at_once,
      {[&]() -> std::shared_ptr<void> {
         auto frame = std::make_shared<Frame>();
         return stages.take(*frame) ? frame : nullptr;
       },
       [&](void* frame) { stages.make(frame_of(frame)); }, [&](void* frame) { stages.put(frame_of(frame)); }},
      put_frames);
}

}  // namespace welkin::sequence
