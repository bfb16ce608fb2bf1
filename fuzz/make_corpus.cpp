#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "metadata_seeds.h"
#include "welkin/base/error.h"
#include "welkin/io/heif/heif_test_files.h"
#include "welkin/io/image_file.h"
#include "welkin/io/jxl/gain_map_test_files.h"

/// Writes small files of every format, type and compression that the library writes, of the formats that it
/// only reads, and some that others write: the seeds of the fuzzers.
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
  bool whole_cubes = false;  ///< all levels of a cube, and nothing else
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
      {"ktx2",
       "ktx2",
       {rgb9e5, r11g11b10, bc6h, uastc_hdr},
       {"none", "zstd"},
       {1, 3},
       {95},
       false,
       true,
       true},
      {"ktx", "ktx", {half, float32}, {"none"}, {1, 3, 4}, {95}, false, true, true},
      {"ktx", "ktx", {rgb9e5, r11g11b10, bc6h}, {"none"}, {1, 3}, {95}, false, true, true},
      {"dds", "dds", {half, float32}, {"none"}, {1, 3, 4}, {95}, false, true, true},
      {"dds", "dds", {rgb9e5, r11g11b10, bc6h}, {"none"}, {1, 3}, {95}, false, true, true},
      {"env", "env", {uint8}, {"zip"}, {1, 3}, {95}, false, false, false, true},
      {"glb", "glb", {uint8}, {"zip"}, {1, 3}, {95}, false, false, false, true},
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
          const Image half = test_picture(2, 2, channels), last = test_picture(1, 1, channels);
          if (seeds.whole_cubes) {
            parts.clear();
            for (int level = 0; level < 3; ++level) {
              for (int face = 0; face < 6; ++face) {
                parts.push_back(part);
                parts.back().image = level == 0 ? square.view() : level == 1 ? half.view() : last.view();
                parts.back().level = level;
                parts.back().face = face;
              }
            }
          }
          io::WriteOptions options;
          options.type = type;
          options.compression = compression;
          options.quality = quality;
          if (seeds.folder == "glb") options.irradiance.assign(27, 0.5);
          if (count % 2 == 0) options.attributes = {{"Author", "nobody"}};
          const std::string name = std::string(io::name_of(type)) + std::to_string(count++);
          io::write(root / seeds.folder / (name + "." + seeds.extension), parts, options);
        }
      }
    }
  }
}

std::string contents(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

void write_file(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Headers of other writers before flat pixels, of which some look like run codes.
void write_other_hdr(const fs::path& folder) {
  const std::vector<std::string> heads = {
      "Xim format\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 9\n", "oconv a.rad\n\n+X 9 -Y 2\n",
      "#?RGBE\r\nGAMMA=2.2\r\nPRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\r\n\r\n-Y 2 +X 9\r\n",
      "#?RADIANCE\nFORMAT = 32-bit_rle_xyze\nEXPOSURE=2\nPIXASPECT=2\n\n-Y 2 -X 9\n"};
  std::string pixels;
  for (int i = 0; i < 18; ++i)
    pixels += i == 9 ? std::string("\2\2\0\x09", 4) : std::string(3, i % 5 == 1 ? 1 : 9) + '\x7f';
  int count = 0;
  for (const std::string& head : heads)
    write_file(folder / ("other" + std::to_string(count++) + ".hdr"), head + pixels);
}

/// Written textures under the numbers of other formats whose texels have as many bytes.
void write_other_ktx2(const fs::path& folder) {
  constexpr std::size_t kFormatAt = 12;
  int count = 0;
  for (const auto& [type, formats] :
       {std::pair{io::PixelType::rgb9e5, std::vector<std::uint32_t>{51, 52, 57, 58, 59, 64, 65}},
        {io::PixelType::half, {91, 92}}}) {
    const Image image = test_picture(8, 4, 3);
    const io::WritePart part{"", image.view(), {"R", "G", "B"}};
    io::WriteOptions options;
    options.type = type;
    options.attributes = {{"wTXswizzle", count % 2 == 0 ? "bgr1" : "rrrg"}};
    const fs::path path = folder / "other.ktx2";
    io::write(path, {&part, 1}, options);
    std::string bytes = contents(path);
    fs::remove(path);
    const std::size_t key = bytes.find("wTXswizzle");
    if (key != std::string::npos) bytes[key] = 'K';
    for (const std::uint32_t format : formats) {
      std::memcpy(&bytes[kFormatAt], &format, sizeof format);
      write_file(folder / ("other" + std::to_string(count++) + ".ktx2"), bytes);
    }
  }
}

void save(const fs::path& path, const std::vector<std::byte>& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream.good()) throw std::runtime_error(path.string() + " cannot be written");
}

void write_jxl_seeds(const fs::path& folder) {
  using io::test::JxlOptions;
  fs::create_directories(folder);
  JxlOptions lossy, floats = io::test::linear_float(), packet, ten_bits;
  lossy.distance = 1;
  packet.xmp = "<x/>";
  packet.brotli = true;
  packet.orientation = 6;
  ten_bits.bits = 10;
  ten_bits.colour = io::test::jxl_colour(JXL_TRANSFER_FUNCTION_PQ, JXL_PRIMARIES_2100);
  int count = 0;
  for (const JxlOptions& options : {JxlOptions(), lossy, floats, packet, ten_bits}) {
    for (const int channels : {1, 3, 4}) {
      save(folder / ("seed" + std::to_string(count++) + ".jxl"),
           io::test::encoded_jxl(test_picture(17, 9, channels), options));
    }
  }
  save(folder / "gain_map.jxl",
       io::test::jxl_with_box(test_picture(17, 9, 3), "jhgm",
                              io::test::gain_map_box(io::test::gain_map_metadata_bytes(),
                                                     io::test::encoded_jxl(test_picture(5, 3, 1)))));
}

/// Written pages whose samples are said to be of other bits and formats, no longer ones.
void write_other_tiff(const fs::path& folder) {
  const Image image = test_picture(17, 9, 1);
  const io::WritePart part{"", image.view(), {"Y"}};
  int count = 0;
  for (const auto type : {io::PixelType::uint16, io::PixelType::float32}) {
    io::WriteOptions options;
    options.type = type;
    options.compression = "none";
    const fs::path path = folder / "other.tif";
    io::write(path, {&part, 1}, options);
    const std::string bytes = contents(path);
    fs::remove(path);
    // Entries of one SHORT: BitsPerSample and SampleFormat.
    const std::size_t bits = bytes.find(std::string("\2\1\3\0\1\0\0\0", 8)),
                      format = bytes.find(std::string("\x53\1\3\0\1\0\0\0", 8));
    if (bits == std::string::npos || format == std::string::npos)
      throw std::runtime_error("no fields to change");
    for (const int of : {1, 2, 3}) {
      for (const int size : {1, 4, 10, 12, 16, 24, 32}) {
        std::string other = bytes;
        other[bits + 8] = static_cast<char>(size);
        other[format + 8] = static_cast<char>(of);
        write_file(folder / ("other" + std::to_string(count++) + ".tif"), other);
      }
    }
  }
}

void write_heif_seeds(const fs::path& folder) {
  using io::test::HeifOptions;
  fs::create_directories(folder);
  int count = 0;
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    for (const auto space : {heif_colorspace_monochrome, heif_colorspace_YCbCr, heif_colorspace_RGB}) {
      for (const bool more : {false, true}) {
        const heif_chroma chroma = space == heif_colorspace_monochrome ? heif_chroma_monochrome
                                   : space == heif_colorspace_YCbCr    ? heif_chroma_420
                                                                       : heif_chroma_444;
        const io::test::HeifPicture picture{
            17, 9, more ? 12 : 8, space, chroma, more, [](heif_channel channel, int x, int y) {
              return (20 * x + 9 * y + 30 * static_cast<int>(channel)) & 255;
            }};
        HeifOptions options;
        options.codec = codec;
        options.lossless = !more;
        if (more) {
          options.orientation = heif_orientation_rotate_90_cw;
          options.xmp = "<x/>";
          options.premultiplied = true;
          options.grid = true;
          options.transfer = 16;
        }
        save(folder / ("seed" + std::to_string(count++) + ".heif"), io::test::encoded_heif(picture, options));
      }
    }
  }
}

}  // namespace

/// What x265 leaves behind is its own; under AddressSanitizer it would make the seeds look failed.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libx265";
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_corpus FOLDER\n");
    return 2;
  }
  try {
    const fs::path root = argv[1];
    for (const Seeds& seeds : all_seeds()) write_seeds(root, seeds);
    write_other_hdr(root / "hdr");
    write_other_ktx2(root / "ktx2");
    write_other_tiff(root / "tiff");
    write_jxl_seeds(root / "jxl");
    write_heif_seeds(root / "heif");
    fuzz::write_metadata_seeds(root);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_corpus: %s\n", error.what());
    return 1;
  }
  return 0;
}
