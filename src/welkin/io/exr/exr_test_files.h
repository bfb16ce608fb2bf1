#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputPart.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/image_file.h"

/// Files for the tests of EXR, made and read back with OpenEXR's C++ library.
namespace welkin::io::exr_test {

/// A folder that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "welkin-exr-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline std::vector<std::byte> bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> chars(std::istreambuf_iterator<char>(file), {});
  std::vector<std::byte> bytes(chars.size());
  std::memcpy(bytes.data(), chars.data(), chars.size());
  return bytes;
}

/// What a channel holds at a pixel: smooth over the picture, with whole numbers for integer channels.
inline double value_at(int x, int y, std::size_t channel, Imf::PixelType type) {
  const double wave = 3.0 + std::sin(0.05 * x + static_cast<double>(channel)) + std::cos(0.07 * y);
  return type == Imf::UINT ? std::floor(8e8 * wave) : 0.25 * wave;
}

struct TestPart {
  Imf::Header header;
  bool tiled = false;
};

/// A header with channels of the given types, `R` `G` `B` `A` unless named.
inline TestPart part_of(Imath::Box2i display, Imath::Box2i data, Imf::Compression compression,
                        const std::map<std::string, Imf::PixelType>& channels) {
  TestPart part{Imf::Header(display, data, 1, {0, 0}, 1, Imf::INCREASING_Y, compression)};
  for (const auto& [name, type] : channels) part.header.channels().insert(name, Imf::Channel(type));
  return part;
}

inline void make_tiled(TestPart& part, unsigned width, unsigned height, Imf::LevelMode mode = Imf::ONE_LEVEL,
                       Imf::LevelRoundingMode rounding = Imf::ROUND_DOWN) {
  part.tiled = true;
  part.header.setTileDescription({width, height, mode, rounding});
}

/// What channels hold: value_at; random bits, so that every kind of NaN and subnormal occurs; or 0.
enum class Fill { smooth, noise, zero };

inline std::uint32_t word_of(double value, Imf::PixelType type) {
  if (type == Imf::HALF) return Imath::half(static_cast<float>(value)).bits();
  if (type == Imf::FLOAT) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return static_cast<std::uint32_t>(value);
}

/// Values of all channels over one window, in the types of the file.
struct Planes {
  std::vector<std::vector<std::uint32_t>> words;  ///< one per pixel; a half is in the lower 16 bits
  Imf::FrameBuffer frame;

  Planes(const Imf::ChannelList& channels, const Imath::Box2i& window, Fill fill) {
    const int width = window.max.x - window.min.x + 1;
    std::uint32_t seed = 1;
    for (auto i = channels.begin(); i != channels.end(); ++i) {
      auto& plane = words.emplace_back();
      const Imf::PixelType type = i.channel().type;
      for (int y = window.min.y; y <= window.max.y; ++y)
        for (int x = window.min.x; x <= window.max.x; ++x) {
          seed = seed * 1664525u + 1013904223u;
          plane.push_back(fill == Fill::zero    ? 0
                          : fill == Fill::noise ? seed ^ seed >> 13
                                                : word_of(value_at(x, y, words.size() - 1, type), type));
        }
      frame.insert(i.name(), Imf::Slice::Make(type, plane.data(), window, std::size_t{4},
                                              static_cast<std::size_t>(width) * 4));
    }
  }
};

/// Writes all levels of all parts.
inline void write_file(const std::string& path, const std::vector<TestPart>& parts,
                       Fill fill = Fill::smooth) {
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts) {
    headers.push_back(part.header);
    headers.back().setType(part.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Imath::Box2i data = headers[i].dataWindow();
    if (!parts[i].tiled) {
      Planes planes(headers[i].channels(), data, fill);
      Imf::OutputPart output(file, static_cast<int>(i));
      output.setFrameBuffer(planes.frame);
      output.writePixels(data.max.y - data.min.y + 1);
      continue;
    }
    Imf::TiledOutputPart output(file, static_cast<int>(i));
    for (int ly = 0; ly < output.numYLevels(); ++ly)
      for (int lx = 0; lx < output.numXLevels(); ++lx) {
        if (!output.isValidLevel(lx, ly)) continue;
        Planes planes(headers[i].channels(), output.dataWindowForLevel(lx, ly), fill);
        output.setFrameBuffer(planes.frame);
        output.writeTiles(0, output.numXTiles(lx) - 1, 0, output.numYTiles(ly) - 1, lx, ly);
      }
  }
}

/// One channel of a part as OpenEXR's C++ library reads it, cut or padded with zeros to the display window.
inline Image read_by_library(const std::string& path, int part, const std::string& channel) {
  Imf::MultiPartInputFile file(path.c_str());
  Imf::InputPart input(file, part);
  const Imath::Box2i data = input.header().dataWindow(), display = input.header().displayWindow();
  const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
  Image whole(width, height, 1);
  Imf::FrameBuffer frame;
  frame.insert(channel, Imf::Slice::Make(Imf::FLOAT, whole.at(0, 0), data, std::size_t{4},
                                         static_cast<std::size_t>(whole.view().row_stride) * 4));
  input.setFrameBuffer(frame);
  input.readPixels(data.min.y, data.max.y);
  Image seen(display.max.x - display.min.x + 1, display.max.y - display.min.y + 1, 1);
  for (int y = 0; y < seen.height(); ++y)
    for (int x = 0; x < seen.width(); ++x) {
      const Imath::V2i pixel = display.min + Imath::V2i(x, y);
      if (data.intersects(pixel)) *seen.at(x, y) = *whole.at(pixel.x - data.min.x, pixel.y - data.min.y);
    }
  return seen;
}

/// All channels of a part, as this library reads them.
inline Image read_all(Reader& reader, std::size_t part = 0) {
  const PartInfo& info = reader.info().parts[part];
  Image image(info.width, info.height, static_cast<int>(info.channels.size()));
  std::vector<int> channels;
  for (std::size_t i = 0; i < info.channels.size(); ++i) channels.push_back(static_cast<int>(i));
  for (int y = 0; y < info.height; ++y) std::fill_n(image.at(0, y), info.width * image.channels(), 777.0f);
  reader.read(part, channels, image.view());
  return image;
}

inline std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

/// Every texel of every channel, bit for bit; of levels, the finest.
inline void expect_equals_library(const std::string& path) {
  SCOPED_TRACE(path);
  const auto reader = open(std::filesystem::path(path));
  for (std::size_t part = 0; part < reader->info().parts.size(); ++part) {
    if (reader->info().parts[part].level > 0) continue;
    const Image image = read_all(*reader, part);
    const auto& names = reader->info().parts[part].channels;
    for (std::size_t c = 0; c < names.size(); ++c) {
      const Image expected = read_by_library(path, static_cast<int>(part), names[c]);
      ASSERT_EQ(image.width(), expected.width());
      ASSERT_EQ(image.height(), expected.height());
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
          ASSERT_EQ(bits(image.at(x, y)[c]), bits(*expected.at(x, y)))
              << "part " << part << " channel " << names[c] << " texel " << x << ", " << y;
    }
  }
}

}  // namespace welkin::io::exr_test
