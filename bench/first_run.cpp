// What the first chain in a process costs, and the tenth: a plan and its run, GGX on a cube of 6×256 and 8
// smaller levels.
//
// first_run MAP     prints `FIRST_CPU_SECONDS TENTH_CPU_SECONDS FIRST_FAULTS TENTH_FAULTS`; faults are page
//                   faults of all threads. The map is read before.

#include <sys/resource.h>

#include <cstdio>
#include <exception>

#include "harness.h"
#include "lighting.h"
#include "welkin/base/error.h"
#include "welkin/map_file/map_file.h"

namespace {

struct Cost {
  double cpu;
  long faults;
};

Cost spent() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), usage.ru_minflt + usage.ru_majflt};
}

Cost cost_of_chain(const welkin::Map& source) {
  const Cost before = spent();
  welkin::PrefilterOptions options;
  options.borders = false;  // as `welkin bake` has it
  welkin::prefilter_map(source, welkin::sphere::AnyParameterization::make("cube"),
                        welkin::bench::ggx_chain(256, 9), options);
  const Cost after = spent();
  return {after.cpu - before.cpu, after.faults - before.faults};
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw welkin::Error(welkin::ErrorKind::mismatch, "first_run MAP");
  const welkin::bench::Threads threads;
  const welkin::Map source = welkin::read_map(argv[1]).map;
  const Cost first = cost_of_chain(source);
  for (int i = 2; i < 10; ++i) cost_of_chain(source);
  const Cost tenth = cost_of_chain(source);
  std::printf("%.5f %.5f %ld %ld\n", first.cpu, tenth.cpu, first.faults, tenth.faults);
} catch (const std::exception& error) {
  std::fprintf(stderr, "first_run: %s\n", error.what());
  return 1;
}
