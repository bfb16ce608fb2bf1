#include "welkin/io/exr/pack.h"

#include <ImfChannelList.h>
#include <ImfVersion.h>
#include <libdeflate.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>

#include "welkin/base/error.h"
#include "welkin/io/exr/convert.h"

namespace welkin::io::exr {
namespace {

/// Above it time doubles for 1% of size; below it the file grows by 2%.
constexpr int kDeflateLevel = 4;

/// In place of a part's number: chunks of single-part files have none.
constexpr int kOnlyPart = -1;

template <class T>
void put(Imf::OStream& stream, T number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  stream.write(bytes, sizeof number);
}

/// Names of more than 31 characters need a flag in the version.
bool has_long_name(const Imf::Header& header) {
  constexpr std::size_t kLongest = 31;
  for (auto i = header.begin(); i != header.end(); ++i)
    if (std::strlen(i.name()) > kLongest || std::strlen(i.attribute().typeName()) > kLongest) return true;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    if (std::strlen(i.name()) > kLongest) return true;
  return false;
}

/// A part as chunks of lines.
struct Layout {
  const WritePart& part;
  StoredType type;
  int lines;               ///< of a chunk
  std::vector<int> order;  ///< channels of the image by name

  Layout(const WritePart& written, StoredType stored, Compression compression)
      : part(written), type(stored), lines(lines_of_chunk(compression)), order(part.channels.size()) {
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return part.channels[static_cast<std::size_t>(a)] < part.channels[static_cast<std::size_t>(b)];
    });
  }
  int chunks() const { return (part.image.height - 1) / lines + 1; }
};

/// A chunk while it is made, and what the file will hold of it.
struct Chunk {
  std::vector<float> line;
  std::vector<std::byte> raw, packed;
  WriteReport report;
};

void fill(const Layout& layout, int first_line, Chunk& chunk) {
  const ImageView<const float>& image = layout.part.image;
  const int lines = std::min(layout.lines, image.height - first_line);
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t channel_bytes = width * bytes_of(layout.type);
  chunk.line.resize(width);
  chunk.raw.resize(static_cast<std::size_t>(lines) * layout.order.size() * channel_bytes);
  chunk.report = {};
  std::byte* to = chunk.raw.data();
  for (int y = first_line; y < first_line + lines; ++y)
    for (const int channel : layout.order) {
      const float* from = image.row(y) + channel;
      for (std::size_t x = 0; x < width; ++x, from += image.channels) chunk.line[x] = *from;
      convert_from_float(chunk.line, layout.type, to, chunk.report);
      to += channel_bytes;
    }
}

/// Writes the chunks of a part, and returns where each lies.
std::vector<std::uint64_t> write_chunks(Imf::OStream& stream, const Layout& layout, Compression compression,
                                        int part_number, WriteReport& report) {
  tbb::enumerable_thread_specific<ChunkPacker> packers;
  const int chunks = layout.chunks();
  const int batch = std::min(chunks, 4 * tbb::this_task_arena::max_concurrency() * (16 / layout.lines));
  std::vector<Chunk> made(static_cast<std::size_t>(batch));
  std::vector<std::uint64_t> offsets;
  for (int first = 0; first < chunks; first += batch) {
    const int count = std::min(batch, chunks - first);
    tbb::parallel_for(0, count, [&](int i) {
      Chunk& chunk = made[static_cast<std::size_t>(i)];
      fill(layout, (first + i) * layout.lines, chunk);
      const auto packed = packers.local().pack(compression, chunk.raw);
      if (packed.data() == chunk.raw.data()) {
        chunk.packed.swap(chunk.raw);
      } else {
        chunk.packed.assign(packed.begin(), packed.end());
      }
    });
    for (int i = 0; i < count; ++i) {
      const Chunk& chunk = made[static_cast<std::size_t>(i)];
      offsets.push_back(stream.tellp());
      if (part_number != kOnlyPart) put(stream, std::int32_t{part_number});
      put(stream, static_cast<std::int32_t>((first + i) * layout.lines));
      put(stream, static_cast<std::int32_t>(chunk.packed.size()));
      stream.write(reinterpret_cast<const char*>(chunk.packed.data()), static_cast<int>(chunk.packed.size()));
      report = added(report, chunk.report);
    }
  }
  return offsets;
}

}  // namespace

bool packs_here(Compression compression) {
  return compression == Compression::none || compression == Compression::zips ||
         compression == Compression::zip;
}

void ChunkPacker::Free::operator()(libdeflate_compressor* p) const {
  libdeflate_free_compressor(p);
}

ChunkPacker::ChunkPacker() : deflater_(libdeflate_alloc_compressor(kDeflateLevel)) {
  if (!deflater_) throw std::bad_alloc();
}

std::span<const std::byte> ChunkPacker::pack(Compression compression, std::span<const std::byte> raw) {
  if (compression == Compression::none) return raw;
  const std::size_t size = raw.size(), half = (size + 1) / 2;
  if (packed_.size() < size) {
    split_.resize(size);
    packed_.resize(size);
  }

  // Even bytes, then odd ones: the bytes that change slowly lie together.
  for (std::size_t i = 0; i < size / 2; ++i) {
    split_[i] = raw[2 * i];
    split_[half + i] = raw[2 * i + 1];
  }
  if (size % 2 != 0) split_[half - 1] = raw[size - 1];

  // Each byte as its difference to the one before, plus 128; backwards, so that it can be in place.
  for (std::size_t i = size; --i > 0;)
    split_[i] =
        static_cast<std::byte>(std::to_integer<int>(split_[i]) - std::to_integer<int>(split_[i - 1]) + 128);

  // 0: it does not fit into one byte less than it was.
  const std::size_t packed =
      libdeflate_zlib_compress(deflater_.get(), split_.data(), size, packed_.data(), size - 1);
  return packed == 0 ? raw : std::span<const std::byte>(packed_).first(packed);
}

WriteReport write_packed(Imf::OStream& stream, std::span<const Imf::Header> headers,
                         std::span<const WritePart> parts, StoredType type, Compression compression) {
  const bool multi_part = parts.size() > 1;
  std::vector<Layout> layouts;
  for (const WritePart& part : parts) {
    layouts.emplace_back(part, type, compression);
    const auto line = static_cast<std::uint64_t>(part.image.width) * part.channels.size() * bytes_of(type);
    if (line * static_cast<std::uint64_t>(layouts.back().lines) > std::uint64_t{1} << 30)
      throw Error(ErrorKind::too_large,
                  "a chunk of " + std::to_string(layouts.back().lines) + " lines is more than 1 GiB");
  }

  // Headers, then room for the tables of chunks.
  put(stream, Imf::MAGIC);
  const bool long_names = std::any_of(headers.begin(), headers.end(), has_long_name);
  put(stream, Imf::EXR_VERSION | (long_names ? Imf::LONG_NAMES_FLAG : 0) |
                  (multi_part ? Imf::MULTI_PART_FILE_FLAG : 0));
  for (std::size_t i = 0; i < headers.size(); ++i) {
    Imf::Header header = headers[i];
    if (multi_part) header.setChunkCount(layouts[i].chunks());
    header.writeTo(stream);
  }
  if (multi_part) put(stream, char{0});
  const std::uint64_t tables = stream.tellp();
  for (const Layout& layout : layouts)
    for (int i = 0; i < layout.chunks(); ++i) put(stream, std::uint64_t{0});

  WriteReport report;
  std::vector<std::uint64_t> offsets;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int number = multi_part ? static_cast<int>(i) : kOnlyPart;
    const auto of_part = write_chunks(stream, layouts[i], compression, number, report);
    offsets.insert(offsets.end(), of_part.begin(), of_part.end());
  }
  stream.seekp(tables);
  for (const std::uint64_t offset : offsets) put(stream, offset);
  return report;
}

}  // namespace welkin::io::exr
