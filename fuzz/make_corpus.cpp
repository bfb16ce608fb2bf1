#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

/// Writes small files of every format, type and compression that the library writes: the seeds of the
/// fuzzers.
///
///     make_corpus FOLDER      makes FOLDER/exr/…, FOLDER/hdr/…
namespace {

using namespace welkin;
namespace fs = std::filesystem;

struct Seeds {
  std::string folder;  ///< as the fuzzer is called
  std::string extension;
  std::vector<io::PixelType> types;
  std::vector<std::string> compressions;
  std::vector<int> channels;
  std::vector<int> qualities = {95};
  bool parts = false;
  bool levels = false;
  bool cubes = false;
};

const std::vector<Seeds>& all_seeds() {
  using enum io::PixelType;
  static const std::vector<Seeds> seeds = {
      {"exr",
       "exr",
       {half, float32, uint32},
       {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "dwaa"},
       {1, 3, 4},
       {95},
       true,
       true},
      {"hdr", "hdr", {float32}, {"rle", "none"}, {1, 3}},
      {"ktx2", "ktx2", {half, float32}, {"none", "zstd"}, {1, 3, 4}, {95}, false, true, true},
      {"ktx2", "ktx2", {rgb9e5, r11g11b10}, {"none", "zstd"}, {1, 3}, {95}, false, true, true},
      {"pfm", "pfm", {float32}, {"none"}, {1, 3}},
      {"png", "png", {uint8, uint16}, {"zip", "none"}, {1, 2, 3, 4}},
      {"jpeg", "jpg", {uint8}, {""}, {1, 3}, {30, 95}},
      {"tiff",
       "tif",
       {uint8, uint16, uint32, half, float32},
       {"none", "zip", "lzw"},
       {1, 3, 4, 5},
       {95},
       true},
      {"webp", "webp", {uint8}, {""}, {3, 4}, {50, 100}},
  };
  return seeds;
}

/// A gradient with a run in each row and a bright spot.
Image test_picture(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < channels; ++k) {
        const float ramp =
            static_cast<float>(x * (k + 1) + y) / static_cast<float>(width * channels + height);
        image.at(x, y)[k] = x > width / 2 ? 0.5f : ramp;
      }
    }
  }
  image.at(width / 3, height / 3)[0] = 100;
  return image;
}

void write_seeds(const fs::path& root, const Seeds& seeds) {
  static const std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
  fs::create_directories(root / seeds.folder);
  int count = 0;
  for (const auto type : seeds.types) {
    for (const auto& compression : seeds.compressions) {
      for (const int channels : seeds.channels) {
        for (const int quality : seeds.qualities) {
          const Image image = test_picture(17, 9, channels);
          io::WritePart part{"first", image.view(), {names.begin(), names.begin() + channels}};
          if (channels <= 2)
            part.channels =
                channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"Y", "A"};
          std::vector<io::WritePart> parts = {part};
          if (seeds.parts && count % 3 == 0) {
            parts.push_back(part);
            parts.back().name = "second";
          }
          const Image coarse = test_picture(8, 4, channels), square = test_picture(4, 4, channels);
          if (seeds.levels && count % 3 == 1) {
            parts.push_back(part);
            parts.back().image = coarse.view();
            parts.back().level = 1;
          }
          if (seeds.cubes && count % 3 == 2) {
            parts.assign(6, part);
            for (int face = 0; face < 6; ++face) {
              parts[static_cast<std::size_t>(face)].image = square.view();
              parts[static_cast<std::size_t>(face)].face = face;
            }
          }
          io::WriteOptions options;
          options.type = type;
          options.compression = compression;
          options.quality = quality;
          if (count % 2 == 0) options.attributes = {{"Author", "nobody"}};
          const std::string name = std::string(io::name_of(type)) + std::to_string(count++);
          io::write(root / seeds.folder / (name + "." + seeds.extension), parts, options);
        }
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_corpus FOLDER\n");
    return 2;
  }
  try {
    for (const Seeds& seeds : all_seeds()) write_seeds(argv[1], seeds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_corpus: %s\n", error.what());
    return 1;
  }
  return 0;
}
