#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <new>

#include "welkin/base/error.h"
#include "welkin/io/exr/chunk.h"
#include "welkin/io/exr/colour.h"
#include "welkin/io/exr/header.h"
#include "welkin/io/exr/library.h"
#include "welkin/io/exr/writer.h"
#include "welkin/io/format.h"

namespace welkin::io {
namespace exr {
namespace {

/// Numbers of the stored channels in the order in which they are reported: R G B A, then Y, then by name.
std::vector<int> reported_order(const Part& part) {
  constexpr std::array<std::string_view, 5> kFirst{"R", "G", "B", "A", "Y"};
  const auto rank = [&](int index) {
    return std::find(kFirst.begin(), kFirst.end(), part.channels[static_cast<std::size_t>(index)].name) -
           kFirst.begin();
  };
  std::vector<int> order;
  for (std::size_t i = 0; i < part.channels.size(); ++i) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return order;
}

std::vector<std::string> reported_names(const Part& part) {
  std::vector<std::string> names;
  if (part.luminance_chroma() || part.full_chroma()) {
    names = {"R", "G", "B"};
    if (part.index_of("A") >= 0) names.push_back("A");
    return names;
  }
  for (const int index : reported_order(part))
    names.push_back(part.channels[static_cast<std::size_t>(index)].name);
  return names;
}

/// The type that holds every channel's values.
PixelType reported_type(const Part& part) {
  const auto all = [&](StoredType type) {
    return std::all_of(part.channels.begin(), part.channels.end(),
                       [&](const auto& c) { return c.type == type; });
  };
  if (all(StoredType::half)) return PixelType::half;
  return all(StoredType::uint32) ? PixelType::uint32 : PixelType::float32;
}

std::string text_of(const Window& w) {
  return "(" + std::to_string(w.min_x) + ", " + std::to_string(w.min_y) + ")-(" + std::to_string(w.max_x) +
         ", " + std::to_string(w.max_y) + ")";
}

std::string name_of_level(const Part& part, int level) {
  if (part.levels() == 1) return part.name;
  return (part.name.empty() ? "" : part.name + " ") + "level " + std::to_string(level);
}

std::vector<std::string> notes_on(const Part& part, int levels) {
  std::vector<std::string> notes;
  if (part.deep) {
    notes.push_back("deep data, which cannot be read");
    return notes;
  }
  if (part.tiled) {
    constexpr std::array<const char*, 3> kModes{"", ", mipmapped", ", ripmapped"};
    const bool one_of_many = part.level_mode != LevelMode::one && levels == 1;
    notes.push_back("tiles of " + std::to_string(part.tile_width) + "x" + std::to_string(part.tile_height) +
                    kModes[static_cast<std::size_t>(part.level_mode)] +
                    (part.level_mode != LevelMode::one && part.round_up ? ", sizes rounded up" : "") +
                    (one_of_many ? " (level 0 is read)" : ""));
  }
  if (part.data != part.display) {
    const bool cropped = intersection(part.data, part.display) != part.data;
    notes.push_back("data window " + text_of(part.data) + (cropped ? " is cropped to" : " lies inside") +
                    " the display window " + text_of(part.display));
  }
  if (part.luminance_chroma())
    notes.push_back("luminance and subsampled chroma, converted to R G B in half precision");
  if (part.full_chroma()) notes.push_back("luminance and chroma, converted to R G B");
  return notes;
}

std::vector<std::string> warnings_on(const Part& part) {
  std::vector<std::string> warnings = part.warnings;
  if (intersection(part.data, part.display).empty()) {
    warnings.push_back("data window " + text_of(part.data) + " lies outside the display window " +
                       text_of(part.display) + ": all texels are 0");
  }
  if (part.pixel_aspect != 1) {
    char aspect[40];
    std::snprintf(aspect, sizeof aspect, "%g", static_cast<double>(part.pixel_aspect));
    warnings.push_back("the pixels' aspect ratio is " + std::string(aspect) + ", which is not obeyed");
  }
  if (part.luminance_chroma() || part.full_chroma()) {
    for (const StoredChannel& channel : part.channels) {
      if (channel.name != "Y" && channel.name != "RY" && channel.name != "BY" && channel.name != "A")
        warnings.push_back("channel '" + channel.name + "' beside luminance and chroma is left out");
    }
  }
  return warnings;
}

class ExrReader final : public FormatReader {
 public:
  explicit ExrReader(const Source& source) : bytes_(source.bytes), name_(source.name), file_(parse(source)) {
    info_.format = "exr";
    info_.bytes = source.bytes.size();
    // Parts of a file that has several need not have as many levels, so only their finest are pictures.
    if (!file_.multi_part) info_.levels = file_.parts[0].levels();
    declare_colour(file_.parts, declared_);
    for (const Part& part : file_.parts) {
      for (int level = 0; level < info_.levels; ++level) {
        const Window window = level == 0 ? part.display : part.level_window(level);
        info_.parts.push_back({file_.multi_part ? part.name : name_of_level(part, level),
                               static_cast<int>(window.width()), static_cast<int>(window.height()),
                               reported_names(part), reported_type(part),
                               std::string(name_of(part.compression)), level});
        PartInfo& picture = info_.parts.back();
        picture.deep = part.deep;
        picture.views = part.views;
        picture.envmap = part.envmap;
        picture.warnings = warnings_on(part);
      }
      info_.attributes.insert(part.attributes.begin(), part.attributes.end());
      if (!info_.envmap) info_.envmap = part.envmap;
      const std::string prefix = file_.multi_part ? "part '" + part.name + "': " : "";
      for (const std::string& note : notes_on(part, info_.levels)) info_.notes.push_back(prefix + note);
    }
  }

  void decode(std::size_t picture, std::span<const int> channels, ImageView<float> out) override {
    assert(picture < info_.parts.size());
    const PartInfo& info = info_.parts[picture];
    const std::size_t part_index = info_.levels > 1 ? 0 : picture;
    const Part& part = file_.parts[part_index];
    assert(out.width == info.width && out.height == info.height);
    assert(static_cast<std::size_t>(out.channels) == channels.size());
    if (part.deep)
      throw Error(
          ErrorKind::unsupported, name_,
          "deep data cannot be read; flatten it first, as `oiiotool IN.exr --flatten -o OUT.exr` does");

    if (part.full_chroma()) {
      Image stored(out.width, out.height, part.index_of("A") >= 0 ? 4 : 3);
      Destination destination{stored.view(), {}};
      for (const char* name : {"Y", "RY", "BY", "A"}) {
        if (part.index_of(name) >= 0) destination.channels.push_back(part.index_of(name));
      }
      decode_stored(part_index, info.level, destination);
      convert_chroma(part, stored.view(), channels, out);
      return;
    }
    Destination destination{out, {}};
    const std::vector<int> order = reported_order(part);
    for (const int channel : channels) {
      assert(channel >= 0 && static_cast<std::size_t>(channel) < info.channels.size());
      destination.channels.push_back(part.luminance_chroma() ? channel
                                                             : order[static_cast<std::size_t>(channel)]);
    }

    decode_stored(part_index, info.level, destination);
  }

 private:
  void decode_stored(std::size_t part_index, int level, const Destination& destination) const {
    const Part& part = file_.parts[part_index];
    if (level > 0) {
      read_level(part, level, destination);
      return;
    }
    clear_outside(part, destination.out);
    if (part.luminance_chroma()) {
      read_luminance(part, destination);
    } else if (unpacks_here(part.compression)) {
      read_here(part_index, destination);
    } else {
      read_by_library(part_index, destination);
    }
  }

  static void clear_outside(const Part& part, const ImageView<float>& out) {
    const Window seen = intersection(part.data, part.display);
    for (int y = 0; y < out.height; ++y) {
      const int line = part.display.min_y + y;
      const bool covered = !seen.empty() && line >= seen.min_y && line <= seen.max_y;
      const int left = covered ? seen.min_x - part.display.min_x : out.width;
      const int right = covered ? seen.max_x - part.display.min_x + 1 : out.width;
      std::fill(out.at(0, y), out.at(left, y), 0.0f);
      std::fill(out.at(right, y), out.at(out.width, y), 0.0f);
    }
  }

  /// Runs `work`, and names file and row in what it throws.
  template <class Work>
  void at_row(const int& row, const Work& work) const {
    try {
      work();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw Error(ErrorKind::damaged, name_, "row " + std::to_string(row) + ": " + cause_of(error));
    }
  }

  void read_here(std::size_t part_index, const Destination& destination) const {
    const Part& part = file_.parts[part_index];
    const std::size_t pixel = part.bytes_per_pixel();
    // Some 64 KiB of pixels per task, at least.
    const auto chunk =
        static_cast<std::size_t>(part.chunk_width()) * static_cast<std::size_t>(part.chunk_height());
    const std::size_t grain = std::max<std::size_t>(1, 65536 / (chunk * pixel));
    tbb::enumerable_thread_specific<ChunkUnpacker> unpackers;
    tbb::parallel_for(
        tbb::blocked_range<std::uint64_t>(0, part.columns() * part.rows(), grain),
        [&](const tbb::blocked_range<std::uint64_t>& range) {
          ChunkUnpacker& unpacker = unpackers.local();
          for (std::uint64_t i = range.begin(); i < range.end(); ++i) {
            const Window window = part.chunk_window(i);
            if (intersection(window, part.display).empty()) continue;
            at_row(window.min_y, [&] {
              const std::size_t size = static_cast<std::size_t>(window.width() * window.height()) * pixel;
              const auto packed = chunk_bytes(bytes_, file_, part_index, i);
              store_chunk(part, window, unpacker.unpack(part.compression, packed, size), destination);
            });
          }
        },
        tbb::simple_partitioner());
  }

  void read_by_library(std::size_t part_index, const Destination& destination) const {
    const Part& part = file_.parts[part_index];
    tbb::enumerable_thread_specific<std::unique_ptr<LibraryPart>> readers;
    tbb::parallel_for(std::uint64_t{0}, part.rows(), [&](std::uint64_t row) {
      const int y = part.chunk_window(row * part.columns()).min_y;
      at_row(y, [&] {
        for (std::uint64_t i = 0; i < part.columns(); ++i)
          chunk_bytes(bytes_, file_, part_index, row * part.columns() + i);
        auto& reader = readers.local();
        if (!reader) reader = std::make_unique<LibraryPart>(bytes_, name_, file_, part_index);
        reader->read(0, row, destination);
      });
    });
  }

  /// Part 0 is the only one of a file with levels.
  void read_level(const Part& part, int level, const Destination& destination) const {
    const auto height = static_cast<std::uint64_t>(part.level_window(level).height());
    const auto rows = (height - 1) / static_cast<std::uint64_t>(part.tile_height) + 1;
    tbb::enumerable_thread_specific<std::unique_ptr<LibraryPart>> readers;
    tbb::parallel_for(std::uint64_t{0}, rows, [&](std::uint64_t row) {
      try {
        at_row(part.chunk_window(row * part.columns()).min_y, [&] {
          auto& reader = readers.local();
          if (!reader) reader = std::make_unique<LibraryPart>(bytes_, name_, file_, 0);
          reader->read(level, row, destination);
        });
      } catch (const Error& error) {
        throw Error(error.kind(), error.file(), error.cause() + " (level " + std::to_string(level) + ")");
      }
    });
  }

  void read_luminance(const Part& part, const Destination& destination) const {
    int row = part.data.min_y;
    at_row(row, [&] {
      for (std::uint64_t i = 0; i < part.rows(); ++i) {
        row = part.chunk_window(i).min_y;
        chunk_bytes(bytes_, file_, 0, i);
      }
      row = part.data.min_y;
      read_luminance_chroma(bytes_, name_, file_, destination, row);
    });
  }

  std::span<const std::byte> bytes_;
  std::string name_;
  File file_;
};

std::unique_ptr<FormatReader> open_exr(const Source& source) {
  return std::make_unique<ExrReader>(source);
}

}  // namespace
}  // namespace exr

Format exr_format() {
  return {{.format = "exr",
           .title = "EXR",
           .extensions = {"exr"},
           .types = {PixelType::float32, PixelType::half, PixelType::uint32},
           .compressions = exr::compression_names(),
           .channels = Channels::any,
           .pictures = true,
           .levels = true,
           .hdr = true,
           .negative = true,
           .attributes = true},
          exr::is_exr,
          exr::open_exr,
          exr::write_exr,
          true,
          exr::check_exr_options};
}

}  // namespace welkin::io
