#include "welkin/io/exr/library.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfTiledInputPart.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

#include "welkin/base/error.h"

namespace welkin::io::exr {
namespace {

class SpanStream final : public Imf::IStream {
 public:
  SpanStream(std::span<const std::byte> bytes, const std::string& name)
      : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || offset_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - offset_)
      throw Error(ErrorKind::damaged, "the file ends early");
    std::memcpy(to, bytes_.data() + offset_, static_cast<std::size_t>(count));
    offset_ += static_cast<std::size_t>(count);
    return offset_ < bytes_.size();
  }
  std::uint64_t tellg() override { return offset_; }
  void seekg(std::uint64_t offset) override { offset_ = offset; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0;
};

Window window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x, box.max.y};
}

/// The library parses the header again: its result must be what was checked.
void check_same(const Part& part, const Imf::Header& header) {
  bool same = window_of(header.dataWindow()) == part.data &&
              static_cast<int>(header.compression()) == static_cast<int>(part.compression) &&
              header.hasTileDescription() >= part.tiled;
  if (same && part.tiled) {
    const Imf::TileDescription& tiles = header.tileDescription();
    same = static_cast<int>(tiles.xSize) == part.tile_width &&
           static_cast<int>(tiles.ySize) == part.tile_height &&
           static_cast<int>(tiles.mode) == static_cast<int>(part.level_mode) &&
           (tiles.roundingMode == Imf::ROUND_UP) == part.round_up;
  }
  std::size_t index = 0;
  for (auto i = header.channels().begin(); same && i != header.channels().end(); ++i, ++index) {
    same = index < part.channels.size() && part.channels[index].name == i.name() &&
           static_cast<int>(part.channels[index].type) == static_cast<int>(i.channel().type);
  }
  if (!same || index != part.channels.size())
    throw Error(ErrorKind::damaged, "the header contradicts itself");
}

}  // namespace

std::string cause_of(const std::exception& error) {
  std::string text = error.what();
  if (const auto quote = text.rfind("\". "); quote != std::string::npos) text.erase(0, quote + 3);
  while (!text.empty() && text.back() == '.') text.pop_back();
  return text;
}

struct LibraryPart::State {
  const Part& part;
  SpanStream stream;
  Imf::MultiPartInputFile file;
  std::optional<Imf::InputPart> lines;
  std::optional<Imf::TiledInputPart> tiles;
  std::vector<float> buffer;

  State(std::span<const std::byte> bytes, const std::string& name, const File& parsed, std::size_t index)
      : part(parsed.parts[index]), stream(bytes, name), file(stream, 0, false) {
    const int number = static_cast<int>(index);
    if (file.parts() != static_cast<int>(parsed.parts.size()))
      throw Error(ErrorKind::damaged, "the header contradicts itself");
    check_same(part, file.header(number));
    if (part.tiled) {
      tiles.emplace(file, number);
    } else {
      lines.emplace(file, number);
    }
  }

  /// The row of chunks that is number `row` of the level.
  Window chunk_row(int level, std::uint64_t row) const {
    Window window = part.chunk_window(row * part.columns());
    window.max_x = part.data.max_x;
    if (level == 0) return window;
    const Window whole = part.level_window(level);
    if (window_of(tiles->dataWindowForLevel(level)) != whole)
      throw Error(ErrorKind::damaged, "the header contradicts itself");
    // The level's tiles lie where those of level 0 do, and there are no more of them.
    return intersection(window, whole);
  }

  /// Decodes the rows of `window` to texels of `channels` values, the first at `to`.
  void read(int level, std::uint64_t row, const Window& window, const std::vector<int>& channels, float* to,
            std::ptrdiff_t row_stride) {
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto& stored = part.channels[static_cast<std::size_t>(channels[c])];
      frame.insert(stored.name,
                   Imf::Slice::Make(Imf::FLOAT, to + c, {window.min_x, window.min_y}, window.width(),
                                    window.height(), channels.size() * sizeof(float),
                                    static_cast<std::size_t>(row_stride) * sizeof(float)));
    }
    if (tiles) {
      tiles->setFrameBuffer(frame);
      tiles->readTiles(0, tiles->numXTiles(level) - 1, static_cast<int>(row), static_cast<int>(row), level);
    } else {
      lines->setFrameBuffer(frame);
      lines->readPixels(window.min_y, window.max_y);
    }
  }
};

LibraryPart::LibraryPart(std::span<const std::byte> bytes, const std::string& name, const File& file,
                         std::size_t part)
    : state_(std::make_unique<State>(bytes, name, file, part)) {}

LibraryPart::~LibraryPart() = default;

void LibraryPart::read(int level, std::uint64_t row, const Destination& destination) {
  const Part& part = state_->part;
  const Window window = state_->chunk_row(level, row);
  const Window seen = intersection(window, part.display);
  if (seen.empty()) return;

  const ImageView<float>& out = destination.out;
  float* const first = out.at(seen.min_x - part.display.min_x, seen.min_y - part.display.min_y);
  const std::set<int> different(destination.channels.begin(), destination.channels.end());
  if (seen == window && different.size() == destination.channels.size()) {
    state_->read(level, row, window, destination.channels, first, out.row_stride);
    return;
  }

  // Crop through a buffer that holds each channel once.
  const std::vector<int> stored(different.begin(), different.end());
  const auto width = static_cast<std::size_t>(window.width()),
             height = static_cast<std::size_t>(window.height());
  std::vector<float>& buffer = state_->buffer;
  buffer.resize(width * height * stored.size());
  const auto line = static_cast<std::ptrdiff_t>(width * stored.size());
  state_->read(level, row, window, stored, buffer.data(), line);
  for (std::size_t c = 0; c < destination.channels.size(); ++c) {
    const auto at = std::find(stored.begin(), stored.end(), destination.channels[c]) - stored.begin();
    for (int y = 0; y < seen.height(); ++y) {
      const float* from = buffer.data() + (seen.min_y - window.min_y + y) * line +
                          (seen.min_x - window.min_x) * static_cast<std::ptrdiff_t>(stored.size()) + at;
      float* to = first + y * out.row_stride + static_cast<std::ptrdiff_t>(c);
      for (int x = 0; x < seen.width(); ++x, from += stored.size(), to += out.channels) *to = *from;
    }
  }
}

void read_luminance_chroma(std::span<const std::byte> bytes, const std::string& name, const File& file,
                           const Destination& destination, int& row) {
  if (file.multi_part)
    throw Error(
        ErrorKind::unsupported,
        "luminance and subsampled chroma are read in files of one part only; `exrmultipart -separate` "
        "makes such files");
  const Part& part = file.parts[0];
  SpanStream stream(bytes, name);
  Imf::RgbaInputFile input(stream, 0);
  if (window_of(input.dataWindow()) != part.data)
    throw Error(ErrorKind::damaged, "the header contradicts itself");

  std::vector<Imf::Rgba> line(static_cast<std::size_t>(part.data.width()));
  input.setFrameBuffer(line.data() - part.data.min_x, 1, 0);
  const Window seen = intersection(part.data, part.display);
  for (row = seen.min_y; row <= seen.max_y && !seen.empty(); ++row) {
    input.readPixels(row);
    float* to = destination.out.at(seen.min_x - part.display.min_x, row - part.display.min_y);
    for (int x = seen.min_x; x <= seen.max_x; ++x) {
      const Imf::Rgba& texel = line[static_cast<std::size_t>(x - part.data.min_x)];
      const float values[4] = {texel.r, texel.g, texel.b, texel.a};
      for (const int channel : destination.channels) *to++ = values[channel];
    }
  }
}

}  // namespace welkin::io::exr
