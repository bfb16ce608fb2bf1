#include "welkin/io/exr/pack.h"

#include <ImfChannelList.h>
#include <ImfVersion.h>
#include <libdeflate.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "welkin/base/error.h"
#include "welkin/io/exr/convert.h"
#include "welkin/io/part_rows.h"

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

/// A part as chunks of lines, and pieces of several chunks, which are made at a time.
struct Layout {
  const WritePart& part;
  StoredType type;
  Compression compression;
  int number;              ///< of the part, or kOnlyPart
  int lines;               ///< of a chunk
  int piece;               ///< chunks of a piece
  std::vector<int> order;  ///< channels of the image by name

  Layout(const WritePart& written, StoredType stored, Compression packed, int part_number)
      : part(written),
        type(stored),
        compression(packed),
        number(part_number),
        lines(lines_of_chunk(packed)),
        order(part.channels.size()) {
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return part.channels[static_cast<std::size_t>(a)] < part.channels[static_cast<std::size_t>(b)];
    });
    // What is read, made and written of a piece stays in the second-level cache.
    constexpr std::uint64_t kPieceBytes = 1 << 19;
    piece = static_cast<int>(kPieceBytes / (line_bytes() * static_cast<std::uint64_t>(lines))) + 1;
    // What is drawn several rows at once, as these lie, as long as that isn't much.
    constexpr std::uint64_t kMaxDrawnBytes = 1 << 22;
    const int drawn = part.draw ? part.rows_at_once : 1;
    if (static_cast<std::uint64_t>(drawn) * line_bytes() <= kMaxDrawnBytes) {
      const int rows = (piece * lines + drawn - 1) / drawn * drawn;
      piece = (rows + lines - 1) / lines;
    }
  }
  int chunks() const { return (part.image.height - 1) / lines + 1; }
  std::uint64_t channel_bytes() const {
    return static_cast<std::uint64_t>(part.image.width) * bytes_of(type);
  }
  std::uint64_t line_bytes() const { return channel_bytes() * order.size(); }
};

/// Some chunks one after the other, as the file holds them.
struct Piece {
  std::vector<std::byte> bytes;  ///< the first `size` count
  std::size_t size = 0;
  std::vector<std::size_t> chunks;  ///< where each begins
  WriteReport report;
};

/// Deinterleaves texels: channel c goes to planes[c], of any alignment.
void split_channels(const float* texels, int channels, std::size_t count, std::byte* const* planes) {
  std::size_t x = 0;
#ifdef __SSE2__
  const auto store = [&](int channel, __m128 values) {
    _mm_storeu_ps(reinterpret_cast<float*>(planes[channel] + x * sizeof(float)), values);
  };
  if (channels == 3) {
    for (; x + 4 <= count; x += 4, texels += 12) {
      const __m128 r0g0b0r1 = _mm_loadu_ps(texels), g1b1r2g2 = _mm_loadu_ps(texels + 4),
                   b2r3g3b3 = _mm_loadu_ps(texels + 8);
      const __m128 g0b0g1b1 = _mm_shuffle_ps(r0g0b0r1, g1b1r2g2, _MM_SHUFFLE(1, 0, 2, 1));
      const __m128 r2g2b2r3 = _mm_shuffle_ps(g1b1r2g2, b2r3g3b3, _MM_SHUFFLE(1, 0, 3, 2));
      const __m128 g2g2g3g3 = _mm_shuffle_ps(r2g2b2r3, b2r3g3b3, _MM_SHUFFLE(2, 2, 1, 1));
      const __m128 b2b2b3b3 = _mm_shuffle_ps(r2g2b2r3, b2r3g3b3, _MM_SHUFFLE(3, 3, 2, 2));
      store(0, _mm_shuffle_ps(r0g0b0r1, r2g2b2r3, _MM_SHUFFLE(3, 0, 3, 0)));
      store(1, _mm_shuffle_ps(g0b0g1b1, g2g2g3g3, _MM_SHUFFLE(2, 0, 2, 0)));
      store(2, _mm_shuffle_ps(g0b0g1b1, b2b2b3b3, _MM_SHUFFLE(2, 0, 3, 1)));
    }
  } else if (channels == 4) {
    for (; x + 4 <= count; x += 4, texels += 16) {
      __m128 rows[4];
      for (int i = 0; i < 4; ++i) rows[i] = _mm_loadu_ps(texels + 4 * i);
      _MM_TRANSPOSE4_PS(rows[0], rows[1], rows[2], rows[3]);
      for (int c = 0; c < 4; ++c) store(c, rows[c]);
    }
  }
#endif
  for (; x < count; ++x)
    for (int c = 0; c < channels; ++c, ++texels)
      std::memcpy(planes[c] + x * sizeof(float), texels, sizeof(float));
}

/// Makes pieces, with working memory for one thread.
class PieceMaker {
 public:
  explicit PieceMaker(const Layout& layout) : layout_(layout), rows_(layout.part) {}

  /// The piece that begins with the chunk `first`.
  void make(int first, Piece& piece) {
    const int height = layout_.part.image.height, first_line = first * layout_.lines;
    const int count = std::min(layout_.piece, layout_.chunks() - first);
    const ImageView<const float> lines =
        rows_.rows(first_line, std::min(count * layout_.lines, height - first_line));
    const std::size_t header = (layout_.number == kOnlyPart ? 2 : 3) * sizeof(std::int32_t);
    const std::size_t largest = static_cast<std::size_t>(lines.height) * layout_.line_bytes() +
                                static_cast<std::size_t>(count) * header;
    if (piece.bytes.size() < largest) piece.bytes.resize(largest);
    piece.chunks.clear();
    piece.report = {};
    std::byte* to = piece.bytes.data();
    for (int y = 0; y < lines.height; y += layout_.lines) {
      piece.chunks.push_back(static_cast<std::size_t>(to - piece.bytes.data()));
      const std::size_t size = pack(lines.part(0, y, lines.width, std::min(layout_.lines, lines.height - y)),
                                    to + header, piece.report);
      if (layout_.number != kOnlyPart) to = put_number(to, layout_.number);
      to = put_number(to, first_line + y);
      to = put_number(to, static_cast<std::int32_t>(size)) + size;
    }
    piece.size = static_cast<std::size_t>(to - piece.bytes.data());
  }

 private:
  static std::byte* put_number(std::byte* to, std::int32_t number) {
    std::memcpy(to, &number, sizeof number);
    return to + sizeof number;
  }

  /// A chunk, packed; returns its bytes.
  std::size_t pack(ImageView<const float> lines, std::byte* to, WriteReport& report) {
    const std::size_t size = static_cast<std::size_t>(lines.height) * layout_.line_bytes();
    if (layout_.compression == Compression::none) {
      store(lines, to, report);
      return size;
    }
    raw_.resize(size);
    store(lines, raw_.data(), report);
    const auto packed = packer_.pack(layout_.compression, raw_);
    std::memcpy(to, packed.data(), packed.size());
    return packed.size();
  }

  /// For each line, for each channel by name, the line's values.
  void store(ImageView<const float> lines, std::byte* to, WriteReport& report) {
    const auto width = static_cast<std::size_t>(lines.width);
    const bool converts = layout_.type != StoredType::float32;
    if (converts) values_.resize(width * layout_.order.size());
    planes_.resize(layout_.order.size());
    for (int y = 0; y < lines.height; ++y, to += layout_.line_bytes()) {
      std::byte* const first = converts ? reinterpret_cast<std::byte*>(values_.data()) : to;
      for (std::size_t i = 0; i < planes_.size(); ++i)
        planes_[static_cast<std::size_t>(layout_.order[i])] = first + i * width * sizeof(float);
      split_channels(lines.row(y), lines.channels, width, planes_.data());
      if (converts) convert_from_float(values_, layout_.type, to, report);
    }
  }

  const Layout& layout_;
  PartRows rows_;
  ChunkPacker packer_;
  std::vector<std::byte> raw_;
  std::vector<float> values_;
  std::vector<std::byte*> planes_;
};

/// Writes the chunks of a part, and adds where each lies.
void write_chunks(Imf::OStream& stream, const Layout& layout, std::vector<std::uint64_t>& offsets,
                  WriteReport& report) {
  tbb::enumerable_thread_specific<PieceMaker> makers([&] { return PieceMaker(layout); });
  const auto at_once = static_cast<std::size_t>(2 * tbb::this_task_arena::max_concurrency());
  // Pieces leave in order, so those in work are neighbours and no two share a slot.
  std::vector<Piece> pieces(at_once);
  int next = 0;
  const auto choose = [&](tbb::flow_control& control) {
    const int first = next;
    if (first >= layout.chunks()) {
      control.stop();
    } else {
      next += std::min(layout.piece, layout.chunks() - first);
    }
    return first;
  };
  const auto make = [&](int first) {
    Piece& piece = pieces[static_cast<std::size_t>(first / layout.piece) % at_once];
    makers.local().make(first, piece);
    return &piece;
  };
  const auto write = [&](Piece* piece) {
    const std::uint64_t begin = stream.tellp();
    for (const std::size_t chunk : piece->chunks) offsets.push_back(begin + chunk);
    constexpr std::size_t kMaxWrite = std::size_t{1} << 30;
    for (std::size_t at = 0; at < piece->size; at += kMaxWrite)
      stream.write(reinterpret_cast<const char*>(piece->bytes.data()) + at,
                   static_cast<int>(std::min(kMaxWrite, piece->size - at)));
    report = report + piece->report;
  };
  tbb::parallel_pipeline(at_once,
                         tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, choose) &
                             tbb::make_filter<int, Piece*>(tbb::filter_mode::parallel, make) &
                             tbb::make_filter<Piece*, void>(tbb::filter_mode::serial_in_order, write));
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
    const int number = multi_part ? static_cast<int>(layouts.size()) : kOnlyPart;
    layouts.emplace_back(part, type, compression, number);
    if (layouts.back().line_bytes() * static_cast<std::uint64_t>(layouts.back().lines) > std::uint64_t{1}
                                                                                             << 30)
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
  for (const Layout& layout : layouts) write_chunks(stream, layout, offsets, report);
  stream.seekp(tables);
  for (const std::uint64_t offset : offsets) put(stream, offset);
  return report;
}

}  // namespace welkin::io::exr
