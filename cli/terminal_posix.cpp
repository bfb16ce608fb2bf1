// The command line's POSIX-only code: signals, and whether stderr is a terminal.
#include "terminal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

#include "command.h"
#include "welkin/io/output_file.h"

namespace welkin::cli {
namespace {

ProgressMode progress_mode = ProgressMode::automatic;
std::atomic<bool> bar_shown{false};

void end_process(int signal) {
  io::remove_unfinished_outputs();
  _exit(128 + signal);
}

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
    tell(fmt::format("\r{} [{:=<{}}{: <{}}] {:3.0f} %", what_, "", filled, "", 30 - filled, 100 * fraction));
    if (fraction > 0.02) tell(fmt::format(", {:.0f} s left ", seconds * (1 - fraction) / fraction));
    std::fflush(stderr);
    bar_shown = true;
  }

 private:
  std::string what_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace

void tell(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void set_progress_mode(ProgressMode mode) { progress_mode = mode; }

void hold_standard_streams() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    // The lowest free number is taken: the closed one's, as those below are open by now.
    if (fcntl(descriptor, F_GETFD) < 0) open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void remove_outputs_on_signals() {
  signal(SIGXFSZ, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = end_process;
  for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
    // A signal that the caller ignores (nohup) stays ignored.
    struct sigaction before {};
    sigaction(each, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(each, &action, nullptr);
  }
}

Monitor progress_monitor(std::string what) {
  const bool shown =
      progress_mode == ProgressMode::always || (progress_mode == ProgressMode::automatic && isatty(STDERR_FILENO) != 0);
  if (!shown) return {};
  auto bar = std::make_shared<Bar>(std::move(what));
  return {[bar](double fraction) { bar->show(fraction); }, nullptr};
}

void end_progress() {
  if (bar_shown.exchange(false)) tell("\n");
}

}  // namespace welkin::cli
