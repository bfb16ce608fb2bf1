// Writes the picture that other programs are compared on.
//
// make_picture OUT WIDTH     OUT.tif: clipped to 0…¾, 16 bits, linear, uncompressed. OUT.exr: half, ZIP.
//                            OUT.pfm: as it is where the width is the map's own. None has negative values.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <span>
#include <string>

#include "lighting.h"
#include "pictures.h"
#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

int main(int argc, char** argv) try {
  using namespace welkin;
  if (argc != 3) throw Error(ErrorKind::bad_request, "make_picture OUT WIDTH");
  const std::filesystem::path path = argv[1];
  const int width = std::stoi(argv[2]);
  const bool is_tiff = path.extension() == ".tif", is_exr = path.extension() == ".exr";
  Map map = is_tiff || is_exr ? bench::detailed_picture(width) : bench::lighting_picture(width);
  const float maximum = is_tiff ? 0.75f : std::numeric_limits<float>::max();
  for (int y = 0; y < map.height(); ++y) {
    float* row = map.level.chart(0).row(y);
    for (int i = 0; i < 3 * map.width(); ++i) row[i] = std::clamp(row[i], 0.0f, maximum);
  }
  const io::WritePart part{"", map.level.chart(0), {"R", "G", "B"}};
  io::WriteOptions options;
  if (is_tiff) {
    options.type = io::PixelType::uint16;
    options.colour = io::Colour::linear;
    options.compression = "none";
  } else if (is_exr) {
    options.type = io::PixelType::half;
    options.compression = "zip";
  }
  io::write(path, std::span(&part, 1), options);
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_picture: %s\n", error.what());
  return 1;
}
