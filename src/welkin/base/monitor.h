#pragma once

#include <functional>

namespace welkin {

/// How work tells how far it is, and can be stopped. Default: silent and never cancelled. Called from any of
/// the threads that work, from several at once. What a callback throws ends the work, and comes out of it.
struct Monitor {
  /// Told how much of the work is done, 0…1.
  std::function<void(double fraction)> progress;
  /// Asked now and then; true makes the work throw Cancelled before its next piece, a band of rows.
  std::function<bool()> cancelled;
};

}  // namespace welkin
