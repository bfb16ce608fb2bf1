#include "welkin/io/exr/levels.h"

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/io/exr/attributes.h"
#include "welkin/io/exr/convert.h"
#include "welkin/io/part_rows.h"

namespace welkin::io::exr {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

/// Averages of 2×2 texels; along a side of 1, of 2.
Image halved(ImageView<const float> fine) {
  Image coarse(std::max(1, fine.width / 2), std::max(1, fine.height / 2), fine.channels);
  for (int y = 0; y < coarse.height(); ++y) {
    for (int x = 0; x < coarse.width(); ++x) {
      for (int c = 0; c < fine.channels; ++c) {
        double sum = 0;
        for (int i = 0; i < 4; ++i)
          sum +=
              fine.at(std::min(2 * x + i % 2, fine.width - 1), std::min(2 * y + i / 2, fine.height - 1))[c];
        coarse.at(x, y)[c] = static_cast<float>(sum / 4);
      }
    }
  }
  return coarse;
}

void write_level(Imf::TiledOutputFile& output, int level, const WritePart& names,
                 ImageView<const float> image, StoredType type, WriteReport& report) {
  const auto row_values = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  const std::size_t value_bytes = bytes_of(type);
  const void* first = image.data;
  std::size_t row_bytes = static_cast<std::size_t>(image.row_stride) * sizeof(float);
  std::vector<std::byte> converted;
  if (type != StoredType::float32) {
    row_bytes = row_values * value_bytes;
    converted.resize(row_bytes * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y)
      convert_from_float({image.row(y), row_values}, type,
                         converted.data() + row_bytes * static_cast<std::size_t>(y), report);
    first = converted.data();
  }
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < names.channels.size(); ++c)
    frame.insert(
        names.channels[c],
        Imf::Slice::Make(static_cast<Imf::PixelType>(type), static_cast<const char*>(first) + c * value_bytes,
                         {0, 0}, image.width, image.height, names.channels.size() * value_bytes, row_bytes));
  output.setFrameBuffer(frame);
  output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
}

}  // namespace

bool are_levels(std::span<const WritePart> parts) {
  return std::any_of(parts.begin(), parts.end(), [](const WritePart& part) { return part.level > 0; });
}

std::vector<WritePart> ordered_levels(std::span<const WritePart> parts) {
  std::vector<WritePart> levels(parts.begin(), parts.end());
  std::stable_sort(levels.begin(), levels.end(),
                   [](const WritePart& a, const WritePart& b) { return a.level < b.level; });
  for (std::size_t i = 0; i < levels.size(); ++i) {
    WritePart& part = levels[i];
    part.name.clear();
    const std::string name = "level " + std::to_string(i);
    if (part.layer != 0 || part.face != 0)
      throw Error(ErrorKind::unsupported, "EXR's levels are of one picture, not layers or faces");
    if (part.level != static_cast<int>(i))
      throw Error(ErrorKind::bad_request, part.level < static_cast<int>(i)
                                              ? "two pictures for level " + std::to_string(part.level)
                                              : "no picture for " + name);
    if (i == 0) continue;
    const ImageView<const float>& before = levels[i - 1].image;
    const int width = std::max(1, before.width / 2), height = std::max(1, before.height / 2);
    if (before.width == 1 && before.height == 1)
      throw Error(ErrorKind::bad_request, "levels after that of 1×1 texels");
    if (part.image.width != width || part.image.height != height)
      throw Error(ErrorKind::bad_request, name + " is " + size_text(part.image.width, part.image.height) +
                                              ", not " + size_text(width, height));
    if (part.channels != levels[0].channels)
      throw Error(ErrorKind::bad_request, name + " has other channels than level 0");
  }
  return levels;
}

WriteReport write_levels(Imf::OStream& stream, Imf::Header header, std::span<const WritePart> levels,
                         StoredType type, int threads) {
  constexpr unsigned kTile = 64;
  header.setType(Imf::TILEDIMAGE);
  header.setTileDescription({kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN});
  const auto given = static_cast<int>(levels.size());
  const int maximum = level_count(levels[0].image.width, levels[0].image.height);
  if (given < maximum) header.insert(std::string(kOwnLevels), Imf::IntAttribute(given));

  Imf::TiledOutputFile output(stream, header, threads);
  WriteReport report, of_averages;
  Image drawn, average;
  ImageView<const float> finer;
  for (int level = 0; level < given; ++level) {
    const WritePart& part = levels[static_cast<std::size_t>(level)];
    drawn = {};
    finer = draw_rows(part, 0, part.image.height, drawn);
    write_level(output, level, levels[0], finer, type, report);
  }
  for (int level = given; level < maximum; ++level) {
    average = halved(finer);
    finer = average.view();
    write_level(output, level, levels[0], finer, type, of_averages);
  }
  return report;
}

}  // namespace welkin::io::exr
