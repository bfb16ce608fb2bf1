#pragma once

#include <tbb/global_control.h>

#include <functional>
#include <string>
#include <vector>

/// How the benchmarks time, and how they print. Results go to standard output as Markdown tables.
namespace welkin::bench {

/// Limits TBB to two threads, or to WELKIN_BENCH_THREADS of them, as long as it lives.
class Threads {
 public:
  Threads();
  /// To so many, and no more than one that lives longer allows.
  explicit Threads(int count);
  int count() const { return count_; }

 private:
  int count_;
  tbb::global_control limit_;
};

/// Seconds that a job took in one run: of the process's processor time (all threads together), and of the
/// clock on the wall.
struct Seconds {
  double cpu = 0;
  double wall = 0;
};

struct Timing {
  std::vector<Seconds> runs;

  Seconds median() const;  ///< each of its own
  Seconds best() const;
};

/// Runs a job once.
Seconds time_once(const std::function<void()>& job);

/// Runs each job once to warm up, then all of them in turn, `rounds` times. Jobs that are to be compared are
/// timed together, so that whatever else the machine does meets them alike.
std::vector<Timing> time_jobs(const std::vector<std::function<void()>>& jobs, int rounds = 7);

/// The median over rounds of a's processor time divided by b's in the same round.
double ratio(const Timing& a, const Timing& b);

/// The median over rounds of a's processor seconds less b's in the same round.
double difference(const Timing& a, const Timing& b);

double median_of(std::vector<double> values);

/// A Markdown table, printed row by row, so that a long benchmark shows where it is.
class Table {
 public:
  explicit Table(const std::vector<std::string>& columns);
  void row(const std::vector<std::string>& cells) const;

 private:
  std::size_t columns_;
};

/// A number with so many digits after the point.
std::string fixed(double value, int digits);
/// `0.071 (0.069)`: the median and the best of processor seconds.
std::string cpu_cell(const Timing& timing);
std::string wall_cell(const Timing& timing);
/// `31.2 (30.8)`: the same in milliseconds.
std::string cpu_milliseconds(const Timing& timing);
std::string wall_milliseconds(const Timing& timing);
/// `yes`, or `**no**`.
std::string met(bool is_met);

void heading(const std::string& text);
void paragraph(const std::string& text);

/// An environment variable, or `otherwise` when it is unset or empty.
std::string setting(const char* name, const std::string& otherwise = {});

}  // namespace welkin::bench
