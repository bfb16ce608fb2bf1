// What it costs to run a program: the median over several runs of its processor time, wall time, peak memory
// and page faults.
//
// process_cost RUNS PROGRAM [ARGUMENT…]     prints `CPU_SECONDS WALL_SECONDS PEAK_MEGABYTES PAGE_FAULTS`,
//                                           after one run to warm up unless RUNS is 1
//
// The program's standard output is dropped. Fails when the program does. Children of the program count too,
// as far as it waits for them; memory is that of the largest of them.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "harness.h"

namespace {

struct Cost {
  double cpu, wall, megabytes, faults;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Cost run(char** command) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) {
    std::perror("process_cost: fork");
    std::exit(1);
  }
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    execvp(command[0], command);
    std::perror(command[0]);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::fprintf(stderr, "process_cost: %s failed\n", command[0]);
    std::exit(1);
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), wall,
          static_cast<double>(usage.ru_maxrss) * 1024e-6,
          static_cast<double>(usage.ru_minflt + usage.ru_majflt)};
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 2 ? std::atoi(argv[1]) : 0;
  if (runs < 1) {
    std::fprintf(stderr, "process_cost RUNS PROGRAM [ARGUMENT…]\n");
    return 2;
  }
  if (runs > 1) run(argv + 2);
  std::vector<double> cpu, wall, megabytes, faults;
  for (int i = 0; i < runs; ++i) {
    const Cost cost = run(argv + 2);
    cpu.push_back(cost.cpu);
    wall.push_back(cost.wall);
    megabytes.push_back(cost.megabytes);
    faults.push_back(cost.faults);
  }
  using welkin::bench::median_of;
  std::printf("%.5f %.5f %.1f %.0f\n", median_of(cpu), median_of(wall), median_of(megabytes),
              median_of(faults));
}
