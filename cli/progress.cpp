#include "progress.h"

#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <set>

#include "command.h"
#include "hints.h"
#include "welkin/io/process.h"

namespace welkin::cli {
namespace {

ProgressMode progress_mode = ProgressMode::automatic;
bool quiet = false;
std::set<std::string> warned;
std::atomic<bool> bar_shown{false};

/// One line, redrawn at most ten times a second.
class Bar {
 public:
  explicit Bar(std::string what) : what_(std::move(what)) {}

  void show(double fraction) {
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (now - start_ < 1s && progress_mode != ProgressMode::always) return;
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || (now - last_ < 100ms && fraction < 1)) return;
    last_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const int filled = static_cast<int>(fraction * 30);
    print_message(
        fmt::format("\r{} [{:=<{}}{: <{}}] {:3.0f} %", what_, "", filled, "", 30 - filled, 100 * fraction));
    if (fraction > 0.02) print_message(fmt::format(", {:.0f} s left ", seconds * (1 - fraction) / fraction));
    std::fflush(stderr);
    bar_shown = true;
  }

 private:
  std::string what_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace

void print_message(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void set_progress_mode(ProgressMode mode) {
  progress_mode = mode;
}

Monitor progress_monitor(std::string what) {
  const bool shown = progress_mode == ProgressMode::always ||
                     (progress_mode == ProgressMode::automatic && io::standard_error_is_terminal());
  if (!shown) return {};
  auto bar = std::make_shared<Bar>(std::move(what));
  return {[bar](double fraction) { bar->show(fraction); }, nullptr};
}

void end_progress() {
  if (bar_shown.exchange(false)) print_message("\n");
}

void print_warnings(const std::string& path, const std::vector<std::string>& warnings) {
  if (quiet || !warned.insert(path).second) return;
  for (const std::string& warning : warnings) print_warning(path, warning);
}

void print_warning(const std::string& path, const std::string& warning) {
  if (!quiet)
    print_message(
        fmt::format("welkin: {}: {}\n", printable(path), printable(with_option(warning), kLongestWarning)));
}

void set_quiet(bool is_quiet) {
  quiet = is_quiet;
}

}  // namespace welkin::cli
