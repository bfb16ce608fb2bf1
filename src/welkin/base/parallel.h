#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "welkin/base/error.h"
#include "welkin/base/monitor.h"

namespace welkin {

/// Progress of a part of the work: its 0…1 is from…to of the whole. Refers to `whole`, which must outlive it.
inline Monitor part_of(const Monitor& whole, double from, double to) {
  Monitor part;
  part.cancelled = whole.cancelled;
  if (whole.progress) {
    part.progress = [&whole, from, to](double fraction) { whole.progress(from + fraction * (to - from)); };
  }
  return part;
}

/// The same work, silent.
inline Monitor without_progress(const Monitor& monitor) {
  return {nullptr, monitor.cancelled};
}

/// body(i) for i in 0…count−1 on TBB's workers; After each, `monitor` gets the progress and may cancel.
template <class Body>
void parallel_for(int count, const Body& body, const Monitor& monitor = {}) {
  std::atomic<int> done{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 1), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i != range.end(); ++i) {
      if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
      body(i);
      const int now = ++done;
      if (monitor.progress) monitor.progress(static_cast<double>(now) / count);
    }
  });
}

}  // namespace welkin
