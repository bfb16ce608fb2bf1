#include "bake_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "bake_report.h"
#include "json_text.h"
#include "progress.h"
#include "welkin/sequence/bake_frames.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

std::string percent(double part) {
  return fmt::format("{:.3g} %", 100 * part);
}

void print_report(const FramesRequest& request, const BakeFramesOptions& options,
                  const BakeFramesReport& done) {
  const BakeLevels& made = request.made;
  const std::size_t levels = made.levels.size();
  fmt::print("{}: {}, {} of {}×{}, {} {}\n", printable(request.out), printable(bake_notes(options.bake).lobe),
             made.shape->text(), made.levels.front().size.width, made.levels.front().size.height, levels,
             levels == 1 ? "level" : "levels");
  fmt::print("frames {}: {} baked, {} interpolated", frames_text(done.frames), done.baked.size(),
             done.interpolated.size());
  if (!done.complete.empty()) fmt::print(", {} were complete", done.complete.size());
  fmt::print("\n");
  if (const HeldOutFrame* worst = done.worst()) {
    std::vector<int> frames;
    for (const HeldOutFrame& each : done.held_out) frames.push_back(each.frame);
    fmt::print("interpolating: rel. RMSE {} and max {} at worst, of frame {} (held out: {})\n",
               percent(worst->relative_rmse), percent(worst->maximum), worst->frame, frames_text(frames));
  }
  const BakeFramesSeconds& s = done.seconds;
  fmt::print("read {:.3f} s, planned {:.3f} s, filtered {:.3f} s, interpolated {:.3f} s, wrote {:.3f} s; ",
             s.read, s.plan, s.filter, s.interpolate, s.write);
  fmt::print("all in {:.3f} s\n", s.all);
}

void print_json(const FramesRequest& request, const BakeFramesOptions& options,
                const BakeFramesReport& done) {
  ordered_json report = describe_bake(request.in, request.out, request.made, bake_notes(options.bake));
  report["levels"] = describe_levels(request.made, bake_notes(options.bake), done.methods);
  report["frames"] = {
      {"first", done.frames.front()}, {"last", done.frames.back()},        {"every", options.every},
      {"baked", done.baked},          {"interpolated", done.interpolated}, {"complete", done.complete}};
  ordered_json errors = ordered_json::array();
  for (const HeldOutFrame& each : done.held_out) {
    errors.push_back(
        {{"frame", each.frame}, {"relative_rmse", each.relative_rmse}, {"max_relative", each.maximum}});
  }
  report["held_out"] = std::move(errors);
  const HeldOutFrame* worst = done.worst();
  report["worst_frame"] = worst == nullptr ? ordered_json() : ordered_json(worst->frame);
  const BakeFramesSeconds& s = done.seconds;
  report["seconds"] = {{"read", s.read},     {"plan", s.plan},
                       {"filter", s.filter}, {"interpolate", s.interpolate},
                       {"write", s.write},   {"all", s.all}};
  print_json_text(report);
}

/// What repairing did to all frames together.
struct Repairs {
  std::mutex mutex;
  SanitizeReport sum;

  void add(const SanitizeReport& report) {
    const std::scoped_lock lock(mutex);
    sum.filled += report.filled;
    sum.infinite += report.infinite;
    sum.clamped += report.clamped;
  }
};

/// The same error, with the option that helps.
Error with_remedy(const Error& error, const FramesRequest& request) {
  if (error.kind() != ErrorKind::bad_value || request.repair.any()) return error;
  return {error.kind(), error.file(),
          error.cause() + "; --sanitize repairs NaN and infinite values, --clamp large ones"};
}

}  // namespace

void FrameFlags::add(Command command) {
  command.add_option(
      "--frames", frames,
      "Of numbered frames, those from A to B: A-B, or one. Default: from the first to the last "
      "that there is");
  command
      .add_option(
          "--every", every,
          "Of numbered frames, bake the first, each N further, and the last; the others are interpolated, "
          "and need no input")
      .placeholder("N")
      .within(1, FrameNames::kLargest);
  command.add_flag("--keys-only", keys_only, "With --every: write the frames that are baked, and no other");
  command
      .add_option("--held-out", held_out,
                  "With --every: bake up to N of the interpolated frames too, and tell the error. Default: 4")
      .placeholder("N")
      .within(0, 1000000);
  command.add_flag(
      "--resume", resume,
      "Leave frames alone whose files are complete, were made by the same request, and are newer "
      "than the input");
}

void FrameFlags::check_unused() const {
  const char* option = !frames.empty() ? "--frames"
                       : every         ? "--every"
                       : keys_only     ? "--keys-only"
                       : held_out      ? "--held-out"
                       : resume        ? "--resume"
                                       : nullptr;
  if (option != nullptr)
    throw UsageError(
        fmt::format("{}: is for numbered frames: write %04d, or ####, for the number in IN and OUT", option));
}

bool names_frames(const std::string& in, const std::string& out) {
  std::error_code unknown;
  if (FrameNames::has_place(in) && !std::filesystem::exists(in, unknown)) return true;
  if (FrameNames::has_place(out) && !FrameNames::has_place(in)) {
    throw UsageError(fmt::format("{}: has a place for a frame's number, {}, but {} is one map",
                                 printable(out), FrameNames(out).place(), printable(in)));
  }
  return false;
}

std::string request_of(const Command& command) {
  const std::set<std::string> idle{"IN",          "OUT",        "--frames", "--every",
                                   "--keys-only", "--held-out", "--resume", "--json"};
  std::string text;
  for (const Option& option : command.options()) {
    if (!option.given() || idle.count(option.name()) > 0) continue;
    text += option.name();
    for (const std::string& value : option.values()) text += "=" + value;
    text += "\n";
  }
  return text;
}

void bake_numbered(const FrameFlags& flags, const FramesRequest& request) {
  const FrameNames in = parse_option("IN", [&] { return FrameNames(request.in); });
  const FrameNames out = parse_option("OUT", [&] { return FrameNames(request.out); });
  BakeFramesOptions options;
  options.bake = request.made.options;
  if (!flags.frames.empty())
    options.frames = parse_option("--frames", [&] { return frame_range_from(flags.frames); });
  options.every = flags.every.value_or(1);
  options.between = !flags.keys_only;
  options.held_out = flags.held_out.value_or(options.held_out);
  options.resume = flags.resume;
  ReadFlags read = request.read;
  read.warn = false;  // once, by `told`
  options.open = [read](const std::filesystem::path& file, bool pixels) {
    ReadFlags how = read;
    how.pixels = pixels;
    return how.open(file.string());
  };
  Repairs repaired;
  options.prepare = [&](Map& map, const std::filesystem::path&) {
    if (request.repair.any()) repaired.add(sanitize(map, request.repairs));
    turn_world(map, request.turn);
  };
  options.request = request.text;
  options.factor = static_cast<float>(request.factor);
  options.layout = request.made.shape->layout;
  options.write = request.write;
  options.told = [](const std::filesystem::path& file, const std::string& text) {
    print_warning(file.string(), text);
  };
  options.monitor = progress_monitor("bake");
  try {
    const BakeFramesReport done = bake_frames(in, out, options);
    end_progress();
    if (request.repair.any()) request.repair.print(request.in, repaired.sum, request.repairs);
    report_losses(request.out, done.losses);
    request.json ? print_json(request, options, done) : print_report(request, options, done);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw with_remedy(error, request);
  }
}

}  // namespace welkin::cli
