#pragma once

#include <functional>

/// @file
/// Progress and cancelling.
namespace welkin {

/// How work tells how far it is, and can be stopped. Default: silent and never cancelled. Callbacks are
/// called from any of the threads that work, from several at once, and must be safe for that. What a callback
/// throws ends the work, and comes out of the call.
struct Monitor {
  /// Told how much of the work is done, from 0 to 1.
  std::function<void(double fraction)> progress;
  /// Asked now and then; true makes the work throw Cancelled before its next piece, a band of rows.
  std::function<bool()> cancelled;
};

}  // namespace welkin
