#include "harness.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace welkin::bench {
namespace {

double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int thread_count() {
  const int asked = std::atoi(setting("WELKIN_BENCH_THREADS", "2").c_str());
  return std::clamp(asked, 1, 1024);
}

std::vector<double> column(const std::vector<Seconds>& runs, double Seconds::*member) {
  std::vector<double> values;
  for (const Seconds& each : runs) values.push_back(each.*member);
  return values;
}

std::string time_cell(const Timing& timing, double Seconds::*member) {
  const double median = timing.median().*member, best = timing.best().*member;
  const int digits = median < 0.01 ? 5 : median < 0.1 ? 4 : 3;
  return fixed(median, digits) + " (" + fixed(best, digits) + ")";
}

std::string milliseconds_cell(const Timing& timing, double Seconds::*member) {
  const double median = 1e3 * timing.median().*member, best = 1e3 * timing.best().*member;
  const int digits = median < 10 ? 2 : median < 1000 ? 1 : 0;
  return fixed(median, digits) + " (" + fixed(best, digits) + ")";
}

}  // namespace

Threads::Threads() : Threads(thread_count()) {}

Threads::Threads(int count)
    : count_(count), limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)) {}

Seconds Timing::median() const {
  return {median_of(column(runs, &Seconds::cpu)), median_of(column(runs, &Seconds::wall))};
}

Seconds Timing::best() const {
  const auto minimum = [&](double Seconds::*member) {
    const std::vector<double> values = column(runs, member);
    return *std::min_element(values.begin(), values.end());
  };
  return {minimum(&Seconds::cpu), minimum(&Seconds::wall)};
}

Seconds time_once(const std::function<void()>& job) {
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = process_seconds();
  job();
  return {process_seconds() - cpu,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
}

std::vector<Timing> time_jobs(const std::vector<std::function<void()>>& jobs, int rounds) {
  for (const auto& job : jobs) job();
  std::vector<Timing> timings(jobs.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < jobs.size(); ++i) timings[i].runs.push_back(time_once(jobs[i]));
  }
  return timings;
}

double ratio(const Timing& a, const Timing& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(a.runs.size(), b.runs.size()); ++i) {
    ratios.push_back(a.runs[i].cpu / b.runs[i].cpu);
  }
  return median_of(ratios);
}

double difference(const Timing& a, const Timing& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(a.runs.size(), b.runs.size()); ++i) {
    differences.push_back(a.runs[i].cpu - b.runs[i].cpu);
  }
  return median_of(differences);
}

double median_of(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Table::Table(const std::vector<std::string>& columns) : columns_(columns.size()) {
  row(columns);
  row(std::vector<std::string>(columns_, "---"));
}

void Table::row(const std::vector<std::string>& cells) const {
  assert(cells.size() == columns_);
  for (const std::string& cell : cells) std::printf("| %s ", cell.c_str());
  std::printf("|\n");
  std::fflush(stdout);
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string cpu_cell(const Timing& timing) {
  return time_cell(timing, &Seconds::cpu);
}
std::string wall_cell(const Timing& timing) {
  return time_cell(timing, &Seconds::wall);
}

std::string cpu_milliseconds(const Timing& timing) {
  return milliseconds_cell(timing, &Seconds::cpu);
}
std::string wall_milliseconds(const Timing& timing) {
  return milliseconds_cell(timing, &Seconds::wall);
}

std::string met(bool is_met) {
  return is_met ? "yes" : "**no**";
}

void heading(const std::string& text) {
  std::printf("\n## %s\n\n", text.c_str());
}

void paragraph(const std::string& text) {
  std::printf("%s\n\n", text.c_str());
  std::fflush(stdout);
}

std::string setting(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

}  // namespace welkin::bench
