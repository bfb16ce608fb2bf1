// Writes the picture that other programs are compared on.
//
// make_picture OUT WIDTH     OUT.tif: clipped to 0…1, 16 bits, linear, uncompressed. OUT.exr: half, ZIP.

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
  const Map map = bench::detailed_picture(std::stoi(argv[2]));
  const io::WritePart part{"", map.level.chart(0), {"R", "G", "B"}};
  io::WriteOptions options;
  if (path.extension() == ".tif") {
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
