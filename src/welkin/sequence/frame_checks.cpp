#include "welkin/sequence/frame_checks.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <set>
#include <system_error>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin::sequence {
namespace {

namespace fs = std::filesystem;

std::string text_of(const PrefilterShape& shape) {
  return std::to_string(shape.size.width) + "×" + std::to_string(shape.size.height);
}

/// Where a file is, or would be, links followed.
fs::path place_of(const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(file, error);
  return error ? fs::absolute(file).lexically_normal() : place;
}

/// Throws Error for values that can't be filtered.
void check_values(const SourceFaults& faults) {
  if (faults.not_finite > 0)
    throw Error(ErrorKind::bad_value,
                std::to_string(faults.not_finite) + " texels have NaN or infinite values");
  if (faults.excessive > 0)
    throw Error(ErrorKind::bad_value, std::to_string(faults.excessive) + " texels have values of over " +
                                          number_text(kMaxRadiance) + ", too large to filter");
}

}  // namespace

MapReader open_frame(const fs::path& file, const BakeFramesOptions& options, bool pixels) {
  if (options.open) return options.open(file, pixels);
  ReadMapOptions read = options.read;
  read.join_faces = read.join_faces && pixels;
  return MapReader(file, read);
}

void check_sources_there(const FrameNames& in, const std::vector<int>& needed,
                         const std::vector<int>& there) {
  std::vector<int> missing;
  std::set_difference(needed.begin(), needed.end(), there.begin(), there.end(), std::back_inserter(missing));
  if (missing.empty()) return;
  const bool all = needed.back() - needed.front() + 1 == static_cast<int>(needed.size());
  throw Error(ErrorKind::not_found, in.name().string(),
              (missing.size() == 1 ? "frame " : "frames ") + frames_text(missing) +
                  (missing.size() == 1 ? " is missing of " : " are missing of ") +
                  (all ? "" : "key frames ") + frames_text(needed) + ": ask for a range without gaps");
}

void check_shape(const fs::path& file, const PrefilterShape& shape, const fs::path& first_file,
                 const PrefilterShape& first) {
  const std::string than = ", but " + first_file.filename().string() + " is ";
  if (shape.size.width != first.size.width || shape.size.height != first.size.height)
    throw Error(ErrorKind::mismatch, file.string(),
                "is " + text_of(shape) + than + text_of(first) + ": frames have one size");
  if (!(shape.parameterization == first.parameterization))
    throw Error(ErrorKind::mismatch, file.string(),
                "is " + shape.parameterization.spec() + than + first.parameterization.spec());
  if (shape.channels != first.channels)
    throw Error(ErrorKind::mismatch, file.string(),
                "has " + std::to_string(shape.channels) + " channels, but " + first_file.filename().string() +
                    " has " + std::to_string(first.channels));
}

PrefilterShape check_source_shapes(const FrameNames& in, const std::vector<BakedFrame>& frames,
                                   const BakeFramesOptions& options) {
  const auto shape_of = [&](const BakedFrame& each) {
    const MapReader reader = open_frame(in.file(each.frame), options, false);
    const MapShape& shape = reader.shape();
    const ChartSize size = reader.info().chart;
    return PrefilterShape{shape.parameterization.at_size(size.width, size.height), size, 0};
  };
  const PrefilterShape first = shape_of(frames.front());
  // The error of the lowest frame, whichever is found first.
  std::vector<std::exception_ptr> failures(frames.size());
  parallel_for(
      static_cast<int>(frames.size()),
      [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        try {
          if (i > 0)
            check_shape(in.file(frames[k].frame), shape_of(frames[k]), in.file(frames.front().frame), first);
        } catch (...) {
          failures[k] = std::current_exception();
        }
      },
      without_progress(options.monitor));
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return first;
}

void check_apart(const FrameNames& in, const FrameNames& out, const std::vector<int>& sources,
                 const std::vector<int>& frames, const sphere::AnyParameterization& target) {
  std::set<fs::path> read;
  for (const int frame : sources) read.insert(place_of(in.file(frame)));
  for (const int frame : frames) {
    std::vector<fs::path> written = files_of(out.file(frame), target);
    written.push_back(out.file(frame));  // with its %s, as sources are named
    for (const fs::path& file : written) {
      if (read.count(place_of(file)) > 0)
        throw Error(ErrorKind::bad_request, file.string(),
                    "would be written over a source: give the results names of their own");
    }
  }
}

Chain filter_frame(const BakePlan& plan, const Map& source, const std::filesystem::path& file,
                   std::vector<std::string>& told, const Monitor& monitor) {
  SourceFaults faults;
  try {
    try {
      Chain chain = plan.run(source, faults, monitor);
      if (faults.negative > 0)
        told.push_back("has negative values; they darken what is filtered, at most to 0");
      return chain;
    } catch (const Error&) {
      check_values(faults);
      throw;
    }
  } catch (const Error& error) {
    throw in_file(file.string(), error);
  }
}

}  // namespace welkin::sequence
