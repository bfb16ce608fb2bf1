#include "welkin/map_file/chain_file.h"

#include <algorithm>
#include <cassert>

#include "welkin/base/error.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

void check_chain(const fs::path& path, const MapShape& shape, ChartSize finest, int levels,
                 const WriteMapOptions& options) {
  if (levels == 1) return;
  const auto refuse = [&](const std::string& cause) { throw Error(path.string() + ": " + cause); };
  const std::string count = std::to_string(levels) + " levels";
  if (!holds_levels(path)) refuse("holds one level, not " + std::to_string(levels) + ": write EXR or KTX2");
  if (levels > most_levels(finest)) {
    refuse("charts of " + text_of(finest) + " have " + std::to_string(most_levels(finest)) + " levels, not " +
           std::to_string(levels));
  }
  if (options.border > 0) refuse("levels take no safety border");
  const Layout& layout = shape.layout;
  if (layout.kind == LayoutKind::files) refuse(count + " go into one file, not into " + shape.text());
  if (layout.kind == LayoutKind::layers) {
    if (!is_texture(path)) refuse("an EXR of several parts holds no levels: not " + shape.text());
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
           (is_texture(path) ? "" : ": write KTX2, or charts of a power of two"));
  }
}

io::WriteReport write_chain(const fs::path& path, const Chain& chain, const Layout& layout,
                            const WriteMapOptions& options) {
  assert(!chain.levels.empty());
  const Map& finest = chain.levels.front();
  const auto levels = static_cast<int>(chain.levels.size());
  std::vector<const Map*> maps;
  for (const Map& map : chain.levels) {
    [[maybe_unused]] const ChartSize size =
        chain_size({finest.width(), finest.height()}, static_cast<int>(maps.size()));
    assert(map.width() == size.width && map.height() == size.height);
    assert(map.channel_names == finest.channel_names && map.orientation == finest.orientation);
    maps.push_back(&map);
  }
  check_chain(path, {finest.parameterization, layout}, {finest.width(), finest.height()}, levels, options);
  WriteMapOptions with_notes = options;
  for (const auto& [key, text] : attributes_of(chain.notes)) with_notes.image.attributes[key] = text;
  return write_levels(path, maps, layout, with_notes);
}

Chain read_chain(MapReader& reader) {
  Chain chain;
  chain.notes = reader.info().notes;
  const int levels = std::max<int>(1, static_cast<int>(reader.info().levels.size()));
  for (int k = 0; k < levels; ++k) {
    reader.set_level(k);
    chain.levels.push_back(reader.read());
  }
  return chain;
}

Chain read_chain(const fs::path& path, const ReadMapOptions& options) {
  MapReader reader(path, options);
  return read_chain(reader);
}

}  // namespace welkin
