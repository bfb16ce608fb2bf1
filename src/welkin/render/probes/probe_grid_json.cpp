#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/render/probes/probe_grid.h"

namespace welkin::scene {
namespace {

std::string quoted(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string made = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      made += '\\';
      made += c;
    } else if (byte < 0x20) {
      made += std::string("\\u00") + kDigits[byte >> 4] + kDigits[byte & 15];
    } else {
      made += c;
    }
  }
  return made + '"';
}

template <class List, class Text>
std::string list_of(const List& list, const Text& text) {
  std::string made = "[";
  for (const auto& each : list) made += (made.size() > 1 ? ", " : "") + text(each);
  return made + "]";
}

std::string vector_text(const Vec3d& v) {
  return list_of(std::array{v.x, v.y, v.z}, number_text);
}

}  // namespace

std::string probe_grid_json(const ProbeGrid& grid, const std::vector<std::string>& files) {
  require(files.size() == grid.atlases.size(), "there is a file of each atlas");
  const ProbeBox& probes = grid.probes;
  const auto whole = [](int n) { return std::to_string(n); };
  std::vector<int> inside;
  for (int i = 0; i < probes.count(); ++i)
    if (grid.inside(i)) inside.push_back(i);
  std::vector<double> rows;
  for (const auto& row : grid.orientation.rows) rows.insert(rows.end(), row.begin(), row.end());

  std::string json = "{\n";
  json += "  \"counts\": " + list_of(probes.counts, whole) + ",\n";
  json += "  \"first\": " + vector_text(probes.position(0, 0, 0)) + ",\n";
  json += "  \"spacing\": " + vector_text(probes.spacing()) + ",\n";
  json += "  \"order\": \"tile column x, tile row z + counts[2] * y\",\n";
  json += "  \"parameterization\": \"octahedral\",\n";
  json += "  \"orientation\": " + list_of(rows, number_text) + ",\n";
  json += "  \"farthest\": " + number_text(grid.farthest) + ",\n";
  json += "  \"inside\": " + list_of(inside, whole) + ",\n";
  json += "  \"atlases\": [\n";
  for (std::size_t i = 0; i < grid.atlases.size(); ++i) {
    const ProbeAtlas& atlas = grid.atlases[i];
    json += "    {\"name\": " + quoted(atlas.name) + ", \"file\": " + quoted(files[i]) +
            ", \"lobe\": " + quoted(atlas.lobe) + ", \"channels\": " + list_of(atlas.channels, quoted) +
            ", \"size\": " + whole(atlas.size) + ", \"border\": " + whole(atlas.border) + "}" +
            (i + 1 < grid.atlases.size() ? ",\n" : "\n");
  }
  return json + "  ]\n}\n";
}

}  // namespace welkin::scene
