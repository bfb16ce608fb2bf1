#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace welkin::sequence {

/// What went wrong with frames that are in work at the same time: the failure of the lowest. Nothing may be
/// thrown in tasks of TBB: that would cancel the parallel loops of the other frames, silently, and they would
/// be written unfinished.
class Failures {
 public:
  bool any() const { return any_; }

  /// Does the work of a frame, and keeps what it throws.
  template <class Work>
  void guard(int frame, const Work& work) {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_ || frame < frame_) {
        failure_ = std::current_exception();
        frame_ = frame;
      }
      any_ = true;
    }
  }

  /// Throws it, where there is one. After all work.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
  int frame_ = 0;
  std::atomic<bool> any_{false};
};

}  // namespace welkin::sequence
