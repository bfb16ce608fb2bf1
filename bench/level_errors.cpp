// How far a pre-filtered level is from brute force in float64, whoever made it.
//
// level_errors SOURCE LOBE FILE [LEVEL [SHAPE]]     prints `RELATIVE_RMSE MAXIMUM`, in percent

#include <cstdio>
#include <exception>
#include <string>

#include "lighting.h"
#include "welkin/base/error.h"
#include "welkin/map_file/map_file.h"

int main(int argc, char** argv) try {
  using namespace welkin;
  if (argc < 4) throw Error(ErrorKind::bad_request, "level_errors SOURCE LOBE FILE [LEVEL [SHAPE]]");
  const Map source = read_map(argv[1]).map;
  const lobe::AnyLobe lobe = lobe::AnyLobe::make(argv[2]);
  ReadMapOptions options;
  options.channels = {"R", "G", "B"};
  if (argc > 4) options.level = std::stoi(argv[4]);
  if (argc > 5) options.shape = argv[5];
  const Map level = read_map(argv[3], options).map;
  const bench::LevelErrors errors = bench::errors_of(PrefilterReference(source), level, lobe);
  std::printf("%.4f %.4f\n", 100 * errors.relative_rmse, 100 * errors.maximum);
} catch (const std::exception& error) {
  std::fprintf(stderr, "level_errors: %s\n", error.what());
  return 1;
}
