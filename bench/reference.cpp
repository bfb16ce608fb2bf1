// Resamples in float64, slowly, for comparison with what other programs make.
//
// reference IN OUT FACE [bilinear | SAMPLES] [native | openexr]
//
// A lat-long to the six faces of a cube, as EXR (cube:layers): interpolated between texels, or the mean of
// SAMPLES × SAMPLES points over every texel. `openexr` takes both the way OpenEXR's own tools lay texels out.

#include <cstdio>
#include <exception>
#include <string>

#include "welkin/base/error.h"
#include "welkin/filter/resample_reference.h"
#include "welkin/map_file/layout.h"
#include "welkin/map_file/map_file.h"

int main(int argc, char** argv) try {
  using namespace welkin;
  if (argc < 4)
    throw Error(ErrorKind::bad_request, "reference IN OUT FACE [bilinear | SAMPLES] [native | openexr]");
  const int face = std::stoi(argv[3]);
  const std::string manner = argc > 4 ? argv[4] : "bilinear", world = argc > 5 ? argv[5] : "native";
  const std::string prefix = world == "openexr" ? "openexr-" : "";
  ReadMapOptions from;
  from.shape = prefix + "latlong";
  const Map source = read_map(argv[1], from).map;
  const MapShape shape = parse_map_shape(prefix + "cube:layers");
  Map target(shape.parameterization, face, face, source.channels());
  ResampleOptions options;
  options.filter = manner == "bilinear" ? Filter::bilinear : Filter::automatic;
  resample_reference(source, target, options, manner == "bilinear" ? 1 : std::stoi(manner));
  write_map(argv[2], target, shape.layout);
} catch (const std::exception& error) {
  std::fprintf(stderr, "reference: %s\n", error.what());
  return 1;
}
