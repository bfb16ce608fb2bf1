// Writes the picture that other programs are compared on.
//
// make_picture OUT WIDTH     OUT.tif: clipped to 0…¾, 16 bits, linear, uncompressed. OUT.exr: half, ZIP.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string>

#include "pictures.h"
#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

int main(int argc, char** argv) try {
  using namespace welkin;
  if (argc != 3) throw Error("make_picture OUT WIDTH");
  const std::filesystem::path path = argv[1];
  Map map = bench::detailed_picture(std::stoi(argv[2]));
  const bool is_tiff = path.extension() == ".tif";
  for (int y = 0; is_tiff && y < map.height(); ++y) {
    float* row = map.level.chart(0).row(y);
    for (int i = 0; i < 3 * map.width(); ++i) row[i] = std::clamp(row[i], 0.0f, 0.75f);
  }
  const io::WritePart part{"", map.level.chart(0), {"R", "G", "B"}};
  io::WriteOptions options;
  if (is_tiff) {
    options.type = io::PixelType::uint16;
    options.colour = io::Colour::linear;
    options.compression = "none";
  } else {
    options.type = io::PixelType::half;
    options.compression = "zip";
  }
  io::write(path, std::span(&part, 1), options);
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_picture: %s\n", error.what());
  return 1;
}
