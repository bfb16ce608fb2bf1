#include "welkin/map_file/chain_file.h"

#include <algorithm>
#include <string>

#include "welkin/base/error.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

void map_file::check_levels(const Destination& destination, const MapShape& shape, ChartSize finest,
                            int levels, const WriteMapOptions& options) {
  if (levels == 1) return;
  const auto refuse = [&](const std::string& cause) {
    throw Error(ErrorKind::unsupported, destination.path.string(), cause);
  };
  const bool texture = destination.format.texture;
  const std::string count = std::to_string(levels) + " levels";
  if (!destination.format.levels)
    refuse("holds one level, not " + std::to_string(levels) + ": write EXR or KTX2");
  if (levels > max_levels(finest)) {
    refuse("charts of " + text_of(finest) + " have " + std::to_string(max_levels(finest)) + " levels, not " +
           std::to_string(levels));
  }
  if (options.border > 0) refuse("levels take no safety border");
  const Layout& layout = shape.layout;
  if (layout.kind == LayoutKind::files) refuse(count + " go into one file, not into " + shape.text());
  if (layout.kind == LayoutKind::layers) {
    if (!texture)
      refuse("an " + destination.format.title + " of several parts holds no levels: not " + shape.text());
    return;
  }
  // A format halves the whole picture, rounding down.
  for (int k = 1; k < levels; ++k) {
    const ChartSize charts = chain_size(finest, k);
    const ChartSize picture = chain_size({finest.width * layout.columns, finest.height * layout.rows}, k);
    if (picture.width == charts.width * layout.columns && picture.height == charts.height * layout.rows)
      continue;
    refuse(shape.text() + " of charts of " + text_of(finest) + " can be halved to " + std::to_string(k) +
           " levels only, not " + std::to_string(levels) +
           (texture ? "" : ": write KTX2, or charts of a power of two"));
  }
}

void map_file::check_chain_members(const Chain& chain) {
  require(!chain.levels.empty(), "a chain to write has no levels");
  const Map& finest = chain.levels.front();
  for (std::size_t k = 0; k < chain.levels.size(); ++k) {
    const Map& map = chain.levels[k];
    const ChartSize size = chain_size({finest.width(), finest.height()}, static_cast<int>(k));
    const std::string level = "level " + std::to_string(k) + " of a chain to write ";
    if (map.width() != size.width || map.height() != size.height)
      throw Error(ErrorKind::mismatch, level + "is not half as large as the one before");
    if (map.channel_names != finest.channel_names || !(map.orientation == finest.orientation) ||
        !(map.parameterization == finest.parameterization.at_size(map.width(), map.height())))
      throw Error(ErrorKind::mismatch,
                  level + "has other channels, or another orientation or parameterization, than level 0");
  }
}

namespace {

io::WriteReport write_to(const Destination& destination, const Chain& chain, const Layout& layout,
                         const WriteMapOptions& options) {
  check_chain_members(chain);
  const Map& finest = chain.levels.front();
  const std::vector<WrittenLevel> maps(chain.levels.begin(), chain.levels.end());
  check_levels(destination, {finest.parameterization, layout}, {finest.width(), finest.height()},
               static_cast<int>(maps.size()), options);
  WriteMapOptions with_notes = options;
  for (const auto& [key, text] : attributes_of(chain.notes)) with_notes.image.attributes[key] = text;
  return write_levels(destination, maps, layout, with_notes);
}

Layout layout_by_default(const Chain& chain, const io::Capabilities& format) {
  check_chain_members(chain);
  return default_layout(chain.levels.front().parameterization, format, static_cast<int>(chain.levels.size()));
}

}  // namespace

void check_chain(const fs::path& path, const MapShape& shape, ChartSize finest, int levels,
                 const WriteMapOptions& options) {
  require(levels >= 1, "a chain has at least one level");
  if (levels > 1) check_levels(Destination(path), shape, finest, levels, options);
}

io::WriteReport write_chain(const fs::path& path, const Chain& chain, const Layout& layout,
                            const WriteMapOptions& options) {
  return write_to(Destination(path), chain, layout, options);
}

io::WriteReport write_chain(const fs::path& path, const Chain& chain, const WriteMapOptions& options) {
  const Destination destination(path);
  return write_to(destination, chain, layout_by_default(chain, destination.format), options);
}

io::WriteReport write_chain(io::ByteSink& sink, std::string_view format, const Chain& chain,
                            const WriteMapOptions& options) {
  const Destination destination(sink, format);
  return write_to(destination, chain, layout_by_default(chain, destination.format), options);
}

Chain read_chain(MapReader& reader) {
  Chain chain;
  chain.notes = reader.info().notes;
  const int levels = std::max<int>(1, static_cast<int>(reader.info().levels.size()));
  for (int k = 0; k < levels; ++k) {
    chain.levels.push_back(reader.read(k));
  }
  return chain;
}

Chain read_chain(const fs::path& path, const ReadMapOptions& options) {
  MapReader reader(path, options);
  return read_chain(reader);
}

Chain read_chain(std::span<const std::byte> bytes, const std::string& name, const ReadMapOptions& options) {
  MapReader reader(bytes, name, options);
  return read_chain(reader);
}

}  // namespace welkin
