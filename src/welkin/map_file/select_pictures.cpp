#include <algorithm>

#include "welkin/map_file/map_file_job.h"

/// Which of a file's pictures a map is read from.
namespace welkin::map_file {

std::vector<std::size_t> pictures_of(const io::FileInfo& file, int level) {
  std::vector<std::size_t> pictures;
  for (std::size_t i = 0; i < file.parts.size(); ++i) {
    if (file.parts[i].level == level) pictures.push_back(i);
  }
  return pictures;
}

bool is_array(const io::FileInfo& file) {
  return file.faces > 1 || file.layers > 1;
}

Selection select(const std::string& file_name, const io::FileInfo& file, const ReadMapOptions& options,
                 const Layout* layout) {
  const std::vector<std::size_t> pictures = pictures_of(file, 0);
  const bool layers = layout != nullptr && layout->kind == LayoutKind::layers;
  const auto choose = [&](std::span<const std::size_t> among) {
    return choose_channels(file_name, file, among, options);
  };
  // The pictures of a texture are alike.
  if (layers || options.part || is_array(file)) {
    const std::size_t wanted = options.part.value_or(0) * (layers ? layout->cells.size() : 1);
    const std::size_t first = std::min(wanted, pictures.size() - 1);
    return {first, choose({&pictures[first], 1})};
  }
  ChosenChannels chosen = choose(pictures);
  const auto first = std::find(pictures.begin(), pictures.end(), chosen.picture) - pictures.begin();
  return {static_cast<std::size_t>(first), std::move(chosen)};
}

std::vector<MapLayer> all_layers(const io::FileInfo& file) {
  std::vector<MapLayer> all;
  for (const std::size_t picture : pictures_of(file, 0)) {
    for (const ImageLayer& layer : layers_of(file, picture)) {
      all.push_back({picture, layer.name, {}});
      for (const int channel : layer.members)
        all.back().channels.push_back(file.parts[picture].channels[static_cast<std::size_t>(channel)]);
    }
  }
  return all;
}

}  // namespace welkin::map_file
