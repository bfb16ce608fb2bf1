#include "welkin/io/exr/writer.h"

#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <mutex>
#include <set>

#include "welkin/base/error.h"
#include "welkin/io/exr/attributes.h"
#include "welkin/io/exr/convert.h"
#include "welkin/io/exr/header.h"
#include "welkin/io/exr/levels.h"
#include "welkin/io/exr/library.h"
#include "welkin/io/exr/pack.h"
#include "welkin/io/part_rows.h"

namespace welkin::io::exr {
namespace {

/// The library writes in pieces of a few bytes; the file gets them in larger ones.
class FileStream final : public Imf::OStream {
 public:
  explicit FileStream(ByteSink& file) : OStream("output"), file_(file), offset_(file.tell()) {}

  void write(const char data[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    if (buffer_.size() + count > kBuffer) flush();
    if (count > kBuffer) {
      file_.write(data, count);
    } else {
      buffer_.insert(buffer_.end(), data, data + count);
    }
    offset_ += count;
  }
  std::uint64_t tellp() override { return offset_; }
  void seekp(std::uint64_t offset) override {
    flush();
    file_.seek(offset);
    offset_ = offset;
  }
  void flush() {
    file_.write(buffer_.data(), buffer_.size());
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBuffer = 1 << 16;
  ByteSink& file_;
  std::uint64_t offset_;
  std::vector<char> buffer_;
};

/// Threads for the library's compressors, once in a process, unless the program has set them itself.
int library_threads() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (Imf::globalThreadCount() != 0) return;
    const auto allowed =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const int threads = std::min(tbb::this_task_arena::max_concurrency(), allowed);
    if (threads > 1) Imf::setGlobalThreadCount(threads);
  });
  return Imf::globalThreadCount();
}

StoredType stored_type(const WriteOptions& options) {
  const PixelType type = options.type.value_or(PixelType::float32);
  switch (type) {
    case PixelType::half:
      return StoredType::half;
    case PixelType::float32:
      return StoredType::float32;
    case PixelType::uint32:
      return StoredType::uint32;
    case PixelType::uint8:
    case PixelType::uint16:
    case PixelType::rgb9e5:
    case PixelType::r11g11b10:
    case PixelType::bc6h:
    case PixelType::uastc_hdr:
    case PixelType::astc_hdr:
      break;
  }
  throw Error(ErrorKind::unsupported,
              "EXR has no pixel type " + std::string(io::name_of(type)) + " (one of: half, float, uint32)");
}

void check_names(std::span<const WritePart> parts) {
  constexpr std::size_t kLongest = 255;
  std::set<std::string> part_names;
  for (const WritePart& part : parts) {
    if (parts.size() > 1 && part.name.empty())
      throw Error(ErrorKind::bad_request, "every part of a multi-part EXR needs a name");
    if (!part_names.insert(part.name).second)
      throw Error(ErrorKind::bad_request, "two parts are called '" + part.name + "'");
    std::set<std::string> channel_names;
    for (const std::string& name : part.channels) {
      if (name.empty() || name.size() > kLongest || name.find('\0') != std::string::npos)
        throw Error(ErrorKind::bad_request, "channel name '" + name + "' is not one of 1...255 characters");
      if (!channel_names.insert(name).second)
        throw Error(ErrorKind::bad_request, "two channels are called '" + name + "'");
    }
  }
}

Imath::Box2i box_of(int width, int height) {
  return {{0, 0}, {width - 1, height - 1}};
}

void insert_attributes(Imf::Header& header, const WriteOptions& options) {
  for (const auto& [name, text] : options.attributes) {
    if (name.empty() || name.size() > 255)
      throw Error(ErrorKind::bad_request, "attribute name '" + name + "' is not one of 1...255 characters");
    if (!is_reserved(name)) header.insert(name, Imf::StringAttribute(text));
  }
  if (!options.envmap) return;
  if (*options.envmap != "latlong" && *options.envmap != "cube")
    throw Error(ErrorKind::bad_request, "EXR's envmap is latlong or cube, not '" + *options.envmap + "'");
  Imf::addEnvmap(header, *options.envmap == "cube" ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
}

std::vector<Imf::Header> headers_of(std::span<const WritePart> parts, const WriteOptions& options,
                                    StoredType type, Compression compression) {
  int width = 0, height = 0;
  for (const WritePart& part : parts) {
    width = std::max(width, part.image.width);
    height = std::max(height, part.image.height);
  }
  std::vector<Imf::Header> headers;
  for (const WritePart& part : parts) {
    const Imath::Box2i own = box_of(part.image.width, part.image.height), display = box_of(width, height);
    Imf::Header header(display, own, 1.0f, {0.0f, 0.0f}, 1.0f, Imf::INCREASING_Y,
                       static_cast<Imf::Compression>(compression));
    if (own != display) header.insert(std::string(kOwnWindow), Imf::Box2iAttribute(own));
    if (!part.name.empty()) header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    header.dwaCompressionLevel() = 9.0f * static_cast<float>(100 - std::clamp(options.quality, 1, 100));
    for (const std::string& name : part.channels)
      header.channels().insert(name, Imf::Channel(static_cast<Imf::PixelType>(type)));
    insert_attributes(header, options);
    headers.push_back(std::move(header));
  }
  return headers;
}

/// Hands `rows` lines from line `y` on to the library. Texels are interleaved, `value_bytes` each.
void write_rows(Imf::OutputPart& output, const WritePart& part, StoredType type, const void* first, int y,
                int rows, std::size_t row_bytes) {
  const std::size_t value_bytes = bytes_of(type);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    frame.insert(
        part.channels[c],
        Imf::Slice::Make(static_cast<Imf::PixelType>(type), static_cast<const char*>(first) + c * value_bytes,
                         {0, y}, part.image.width, rows, part.channels.size() * value_bytes, row_bytes));
  output.setFrameBuffer(frame);
  output.writePixels(rows);
}

/// Converts and writes in bands that keep every thread's compressor busy.
WriteReport write_part(Imf::OutputPart& output, const WritePart& part, StoredType type, int threads) {
  const ImageView<const float>& image = part.image;
  if (type == StoredType::float32 && !part.draw) {
    write_rows(output, part, type, image.data, 0, image.height,
               static_cast<std::size_t>(image.row_stride) * sizeof(float));
    return {};
  }
  constexpr int kLinesOfLargestChunk = 256;
  const int band = std::min(image.height, kLinesOfLargestChunk * std::max(1, threads));
  const std::size_t row_values =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  const std::size_t row_bytes = row_values * bytes_of(type);
  Image drawn;
  std::vector<std::byte> converted(type == StoredType::float32 ? 0
                                                               : row_bytes * static_cast<std::size_t>(band));
  WriteReport report;
  for (int y = 0; y < image.height; y += band) {
    const int rows = std::min(band, image.height - y);
    const ImageView<const float> from = draw_rows(part, y, rows, drawn);
    if (type == StoredType::float32) {
      write_rows(output, part, type, from.data, y, rows, row_bytes);
      continue;
    }
    const WriteReport of_band = tbb::parallel_reduce(
        tbb::blocked_range<int>(0, rows, 16), WriteReport{},
        [&](const tbb::blocked_range<int>& range, WriteReport sum) {
          for (int row = range.begin(); row < range.end(); ++row)
            convert_from_float({from.row(row), row_values}, type,
                               converted.data() + row_bytes * static_cast<std::size_t>(row), sum);
          return sum;
        },
        std::plus<WriteReport>());
    report = report + of_band;
    write_rows(output, part, type, converted.data(), y, rows, row_bytes);
  }
  return report;
}

WriteReport write_by_library(Imf::OStream& stream, const std::vector<Imf::Header>& headers,
                             std::span<const WritePart> parts, StoredType type) {
  const int threads = library_threads();
  Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()), false, threads);
  WriteReport report;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Imf::OutputPart part(output, static_cast<int>(i));
    report = report + write_part(part, parts[i], type, threads);
  }
  return report;
}

}  // namespace

void check_exr_options(const WriteOptions& options) {
  stored_type(options);
  if (!options.compression.empty()) compression_named(options.compression);
}

WriteReport write_exr(ByteSink& file, std::span<const WritePart> all_parts, const WriteOptions& options) {
  assert(!all_parts.empty());
  const StoredType type = stored_type(options);
  std::vector<WritePart> levels;
  if (are_levels(all_parts)) levels = ordered_levels(all_parts);
  const std::span<const WritePart> parts = levels.empty() ? all_parts : std::span(levels).first(1);
  check_names(parts);
  const Compression compression =
      options.compression.empty() ? Compression::zip : compression_named(options.compression);
  const std::vector<Imf::Header> headers = headers_of(parts, options, type, compression);
  try {
    FileStream stream(file);
    const WriteReport report =
        !levels.empty()           ? write_levels(stream, headers[0], levels, type, library_threads())
        : packs_here(compression) ? write_packed(stream, headers, parts, type, compression)
                                  : write_by_library(stream, headers, parts, type);
    stream.flush();
    return report;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::system, cause_of(error));
  }
}

}  // namespace welkin::io::exr
