#include <algorithm>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/base/parallel.h"
#include "welkin/map_file/map_file.h"

namespace welkin {
namespace {

using Names = std::vector<std::string>;

bool are(const Names& names, const Names& known) {
  return std::is_permutation(names.begin(), names.end(), known.begin(), known.end());
}

/// Borders too.
Map without_channel(const Map& map, std::size_t dropped) {
  const auto before = static_cast<std::ptrdiff_t>(dropped), channels = std::ptrdiff_t{map.channels()};
  Map kept(map.parameterization, map.width(), map.height(), map.channels() - 1);
  kept.orientation = map.orientation;
  kept.channel_names = map.channel_names;
  kept.channel_names.erase(kept.channel_names.begin() + before);
  const int rows = map.height() + 2 * kBorder, columns = map.width() + 2 * kBorder;
  parallel_for(map.charts() * rows, [&](int i) {
    const float* from = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    float* to = kept.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < columns; ++x, from += channels)
      to = std::copy_n(from + before + 1, channels - before - 1, std::copy_n(from, before, to));
  });
  return kept;
}

/// Whether files of the format can have alpha beside these values.
bool holds_alpha(const io::Capabilities& format, const io::WriteOptions& options) {
  return format.channels != io::Channels::rgb && !options.encoding &&
         !io::is_packed(options.type.value_or(format.types.front()));
}

}  // namespace

std::vector<std::string> fit_channels(Map& map, const std::filesystem::path& path,
                                      const io::WriteOptions& options) {
  const io::Capabilities& format = io::capabilities_for(path);
  if (format.channels == io::Channels::any) return {};
  std::vector<std::string> notes;
  const bool alpha = holds_alpha(format, options);
  if (const auto a = std::find(map.channel_names.begin(), map.channel_names.end(), "A");
      !alpha && a != map.channel_names.end() && map.channels() > 1) {
    const std::string kind = options.type && format.channels != io::Channels::rgb
                                 ? format.title + " of " + std::string(name_of(*options.type))
                                 : format.title;
    notes.push_back(kind + " holds no alpha: A is left out, and colours are those multiplied by it");
    map = without_channel(map, static_cast<std::size_t>(a - map.channel_names.begin()));
  }
  Names& names = map.channel_names;
  if (are(names, {"Y"}) || are(names, {"R", "G", "B"})) return notes;
  if (alpha && (are(names, {"Y", "A"}) || are(names, {"R", "G", "B", "A"}))) return notes;
  const Names known = names.size() == 1            ? Names{"Y"}
                      : names.size() == 3          ? Names{"R", "G", "B"}
                      : names.size() == 4 && alpha ? Names{"R", "G", "B", "A"}
                                                   : Names{};
  if (known.empty()) {
    throw Error(ErrorKind::unsupported, path.string(),
                format.title + " holds Y or R G B" + (alpha ? ", either with A" : "") + ", not " +
                    listed(names) + ": read one channel or three, or write EXR");
  }
  notes.push_back("channels " + listed(names) + " are written as " + listed(known));
  if (names.size() == 1) notes.back() = "channel " + names.front() + " is written as Y";
  names = known;
  return notes;
}

}  // namespace welkin
