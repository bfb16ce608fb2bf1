#include "welkin/map_file/choose_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/io/channel_names.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin::map_file {
namespace {

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

std::string layer_of(const std::string& channel) {
  return std::string(io::layer_of_channel(channel));
}

std::string last_component(const std::string& name) {
  return name.substr(name.rfind('.') + 1);  // all of it without a dot: npos + 1 is 0
}

std::string meaning_of(const std::string& channel) {
  return std::string(io::meaning_of_channel(channel));
}

/// Fills kind, channels and names from the layer's members.
void sort_out(ImageLayer& layer, const std::vector<std::string>& all) {
  const std::vector<int>& members = layer.members;
  const auto name = [&](int channel) { return all[static_cast<std::size_t>(channel)]; };
  const auto find = [&](const std::string& meaning) { return io::channel_that_is(meaning, all, members); };
  const auto take = [&](LayerKind kind, const std::vector<std::string>& meanings, bool alpha) {
    layer.kind = kind;
    for (const std::string& meaning : meanings) {
      const int channel = find(meaning);
      if (channel < 0) {
        layer.channels.clear();
        return false;
      }
      layer.channels.push_back(channel);
    }
    layer.names = meanings;
    if (const int channel = find("A"); alpha && channel >= 0) {
      layer.channels.push_back(channel);
      layer.names.push_back("A");
    }
    return true;
  };
  if (take(LayerKind::colour, {"R", "G", "B"}, true) || take(LayerKind::vector, {"X", "Y", "Z"}, false) ||
      take(LayerKind::grey, {"Y"}, true))
    return;
  for (const int channel : members) {
    const std::string meaning = meaning_of(name(channel));
    if (meaning != "A" && meaning != "Z" && layer.channels.size() < 3) layer.channels.push_back(channel);
  }
  for (const int channel : layer.channels) layer.names.push_back(last_component(name(channel)));
  layer.kind = LayerKind::other;
  if (layer.channels.empty() && !take(LayerKind::depth, {"Z"}, false)) take(LayerKind::alpha, {"A"}, false);
}

/// What messages call the layer, and ReadMapOptions::layer takes: `beauty`, `diffuse`, `beauty/diffuse`;
/// empty for plain channels of a picture without a name.
std::string title_of(const io::FileInfo& file, const ImageLayer& layer) {
  const std::string& part = file.parts[layer.picture].name;
  const bool several = file.parts.size() > static_cast<std::size_t>(file.levels);
  if (layer.name.empty()) return several ? part : "";
  return part.empty() || !several || layer.name.starts_with(part) ? layer.name : part + "/" + layer.name;
}

/// The order in which layers of the same kind are taken: plain names, finished pictures, passes, identifiers.
int rank_of(const io::FileInfo& file, const ImageLayer& layer) {
  constexpr std::array<std::string_view, 8> kFinished{"combined", "beauty",  "rgba",  "rgb",
                                                      "c",        "default", "color", "colour"};
  const std::string title = title_of(file, layer);
  if (title.empty()) return 0;
  if (lower(title).find("crypto") != std::string::npos) return 3;
  return std::count(kFinished.begin(), kFinished.end(), lower(last_component(title))) > 0 ? 1 : 2;
}

/// Whether `name` is one or more whole components of `path`, which has dots or a slash between them.
bool has_components(std::string path, std::string name) {
  std::replace(path.begin(), path.end(), '/', '.');
  std::replace(name.begin(), name.end(), '/', '.');
  return ("." + path + ".").find("." + name + ".") != std::string::npos;
}

/// Whether the layer is of that view: its part's, or one of several that its channels' names tell; the first
/// of these is not named.
bool is_of_view(const io::PartInfo& part, const ImageLayer& layer, const std::string& view) {
  const std::vector<std::string>& views = part.views;
  if (std::find(views.begin(), views.end(), view) == views.end()) return false;
  if (views.front() != view) return views.size() == 1 || has_components(layer.name, view);
  return std::none_of(views.begin() + 1, views.end(),
                      [&](const std::string& other) { return has_components(layer.name, other); });
}

/// Those that `wanted` names: exactly, else by some of their components, else whatever the case.
std::vector<ImageLayer> named_layers(const std::string& file_name, const io::FileInfo& file,
                                     const std::vector<ImageLayer>& layers, const std::string& wanted) {
  for (const bool any_case : {false, true}) {
    const auto text = [&](const std::string& name) { return any_case ? lower(name) : name; };
    for (const bool whole : {true, false}) {
      std::vector<ImageLayer> found;
      for (const ImageLayer& layer : layers) {
        const io::PartInfo& part = file.parts[layer.picture];
        const std::string title = title_of(file, layer);
        const bool matches = whole ? text(layer.name) == text(wanted) || text(part.name) == text(wanted) ||
                                         text(title) == text(wanted) || is_of_view(part, layer, wanted)
                                   : has_components(text(title), text(wanted)) ||
                                         has_components(text(part.name), text(wanted));
        if (matches) found.push_back(layer);
      }
      if (!found.empty()) return found;
    }
  }
  std::vector<std::string> titles;
  for (const ImageLayer& layer : layers) {
    const std::string title = title_of(file, layer);
    if (!title.empty() && std::count(titles.begin(), titles.end(), title) == 0) titles.push_back(title);
  }
  throw Error(ErrorKind::bad_request, file_name,
              titles.empty() ? "has no layers: its channels have plain names"
                             : unknown_name("layer", wanted, titles));
}

std::string quoted(const io::FileInfo& file, const ImageLayer& layer) {
  const std::string title = title_of(file, layer);
  if (!title.empty()) return "'" + title + "'";
  return file.parts.size() > 1 ? "part " + std::to_string(layer.picture) : "the plain channels";
}

void warn_of_others(const io::FileInfo& file, const ImageLayer& best, const std::vector<ImageLayer>& layers,
                    std::vector<std::string>& warnings) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> others;
  bool plain_rivals = false;
  for (const ImageLayer& layer : layers) {
    if (layer.kind != best.kind || (layer.picture == best.picture && layer.name == best.name)) continue;
    others.push_back(quoted(file, layer));
    plain_rivals = plain_rivals || title_of(file, layer).empty();
  }
  if (others.empty() || (rank_of(file, best) == 0 && !plain_rivals)) return;
  const std::size_t count = others.size();
  if (count > kNamed) {
    others.resize(kNamed);
    others.push_back(std::to_string(count - kNamed) + " more");
  }
  warnings.push_back("holds several pictures, and " + quoted(file, best) + " is read; another " +
                     (plain_rivals ? "part" : "layer") + " can be named: " + listed(others, ", "));
}

void warn_of_kind(const io::FileInfo& file, const ImageLayer& layer, std::vector<std::string>& warnings) {
  const io::PartInfo& part = file.parts[layer.picture];
  std::vector<std::string> names;
  for (const int channel : layer.channels) names.push_back(part.channels[static_cast<std::size_t>(channel)]);
  const bool one = names.size() == 1;
  switch (layer.kind) {
    case LayerKind::colour:
      return;
    case LayerKind::grey:
      for (const std::string& channel : part.channels) {
        if (layer_of(channel) != layer.name ||
            (last_component(channel) != "RY" && last_component(channel) != "BY"))
          continue;
        warnings.push_back("the chroma of " + names.front() + " is left out: only " + names.front() +
                           " is read");
        return;
      }
      return;
    case LayerKind::depth:
      warnings.push_back("holds no colour: " + names.front() + ", a depth, is read");
      return;
    case LayerKind::alpha:
      warnings.push_back("holds no colour: " + names.front() + " alone is read");
      return;
    case LayerKind::vector:
    case LayerKind::other:
      // All that there is, as a file of some of the colours.
      if (names.size() == part.channels.size() &&
          (one || std::all_of(names.begin(), names.end(), [](const std::string& channel) {
             return meaning_of(channel) == channel && channel != "X";
           })))
        return;
      warnings.push_back("no channels are called R G B: " + listed(names) + (one ? " is" : " are") + " read" +
                         (part.channels.size() > names.size() ? "; other channels can be named" : ""));
  }
}

int index_of(const io::PartInfo& part, const std::string& channel) {
  const auto found = std::find(part.channels.begin(), part.channels.end(), channel);
  return found == part.channels.end() ? -1 : static_cast<int>(found - part.channels.begin());
}

/// Indices of all these channels, also of `layer`'s by their short names; none where one is missing.
std::optional<std::vector<int>> indices_of(const io::PartInfo& part, const std::vector<std::string>& channels,
                                           const std::string& layer) {
  std::vector<int> indices;
  for (const std::string& channel : channels) {
    int index = index_of(part, channel);
    if (!layer.empty() && index_of(part, layer + "." + channel) >= 0)
      index = index_of(part, layer + "." + channel);
    if (index < 0) return std::nullopt;
    indices.push_back(index);
  }
  return indices;
}

/// What a map calls channels that were named one by one: R G B (A) where they are these of any layers;
/// without a layer that they share; else as the file does.
std::vector<std::string> names_in_map(const std::vector<std::string>& channels) {
  std::vector<std::string> meanings, short_names;
  for (const std::string& channel : channels) {
    meanings.push_back(meaning_of(channel));
    short_names.push_back(last_component(channel));
  }
  for (const std::vector<std::string>& known :
       {std::vector<std::string>{"R", "G", "B"}, {"R", "G", "B", "A"}, {"Y", "A"}}) {
    if (std::is_permutation(known.begin(), known.end(), meanings.begin(), meanings.end())) return meanings;
  }
  const bool shared = std::all_of(channels.begin(), channels.end(), [&](const std::string& channel) {
    return layer_of(channel) == layer_of(channels.front());
  });
  return shared ? short_names : channels;
}

ChosenChannels named_channels(const std::string& file_name, const io::FileInfo& file,
                              std::span<const std::size_t> pictures, const std::vector<ImageLayer>& layers,
                              const ImageLayer& best, const ReadMapOptions& options) {
  // The picture that would be chosen without names first.
  std::vector<std::size_t> tried{best.picture};
  tried.insert(tried.end(), pictures.begin(), pictures.end());
  const std::vector<ImageLayer> wanted = options.layer.empty()
                                             ? std::vector<ImageLayer>{}
                                             : named_layers(file_name, file, layers, options.layer);
  for (const std::size_t picture : tried) {
    const io::PartInfo& part = file.parts[picture];
    std::vector<std::string> prefixes{""};
    for (const ImageLayer& layer : wanted) {
      if (layer.picture == picture) prefixes.insert(prefixes.begin(), layer.name);
    }
    for (const std::string& prefix : prefixes) {
      const auto indices = indices_of(part, options.channels, prefix);
      if (!indices) continue;
      std::vector<std::string> names;
      for (const int index : *indices) names.push_back(part.channels[static_cast<std::size_t>(index)]);
      return {picture, *indices, names_in_map(names), {}};
    }
  }
  std::vector<std::string> known;
  for (const std::size_t picture : pictures) {
    for (const std::string& channel : file.parts[picture].channels) {
      if (std::count(known.begin(), known.end(), channel) == 0) known.push_back(channel);
    }
  }
  for (const std::string& channel : options.channels) {
    if (std::count(known.begin(), known.end(), channel) == 0)
      throw Error(ErrorKind::bad_request, file_name, unknown_name("channel", channel, known));
  }
  throw Error(ErrorKind::bad_request, file_name,
              "no part has all of the channels " + listed(options.channels) + ": they lie in several");
}

/// Channels that the file's own metadata name, as a texture's do, whose format may have added others.
std::optional<std::vector<int>> declared_channels(const io::FileInfo& file, std::size_t picture) {
  const std::string declared = attribute(file, kChannelsKey);
  std::vector<std::string> names;
  std::string channel;
  for (std::istringstream in(declared); std::getline(in, channel, ',');) names.push_back(channel);
  if (names.empty() || names.size() > kMaxChannels) return std::nullopt;
  return indices_of(file.parts[picture], names, "");
}

}  // namespace

std::vector<ImageLayer> layers_of(const io::FileInfo& file, std::size_t picture) {
  const std::vector<std::string>& channels = file.parts[picture].channels;
  std::vector<ImageLayer> layers;
  for (io::ChannelLayer& each : io::layers_of_channels(channels)) {
    layers.push_back({picture, std::string(each.name)});
    layers.back().members = std::move(each.members);
    sort_out(layers.back(), channels);
  }
  return layers;
}

ChosenChannels choose_channels(const std::string& file_name, const io::FileInfo& file,
                               std::span<const std::size_t> pictures, const ReadMapOptions& options) {
  std::vector<ImageLayer> layers;
  for (const bool deep : {false, true}) {
    for (const std::size_t picture : pictures) {
      if (file.parts[picture].deep != deep || (deep && !layers.empty())) continue;
      const std::vector<ImageLayer> own = layers_of(file, picture);
      layers.insert(layers.end(), own.begin(), own.end());
    }
  }
  const std::vector<ImageLayer> candidates =
      options.layer.empty() ? layers : named_layers(file_name, file, layers, options.layer);
  const ImageLayer& best =
      *std::min_element(candidates.begin(), candidates.end(), [&](const ImageLayer& a, const ImageLayer& b) {
        return std::tuple(a.kind, rank_of(file, a)) < std::tuple(b.kind, rank_of(file, b));
      });
  if (!options.channels.empty()) return named_channels(file_name, file, pictures, layers, best, options);
  ChosenChannels chosen{best.picture, best.channels, best.names, {}};
  if (options.layer.empty()) {
    if (const auto declared = declared_channels(file, best.picture)) {
      chosen.channels = *declared;
      chosen.names.clear();
      for (const int channel : *declared)
        chosen.names.push_back(file.parts[best.picture].channels[static_cast<std::size_t>(channel)]);
      return chosen;
    }
    warn_of_kind(file, best, chosen.warnings);
  }
  warn_of_others(file, best, candidates, chosen.warnings);
  return chosen;
}

std::vector<int> channels_like(const ChosenChannels& chosen, const io::PartInfo& part,
                               const std::string& file_name, const io::FileInfo& other_file,
                               std::size_t other_picture) {
  const io::PartInfo& other = other_file.parts.at(other_picture);
  std::vector<std::string> names;
  for (const int channel : chosen.channels) names.push_back(part.channels[static_cast<std::size_t>(channel)]);
  if (const auto same = indices_of(other, names, "")) return *same;
  // Faces in parts whose channels bear the part's name.
  for (const ImageLayer& layer : layers_of(other_file, other_picture)) {
    if (layer.names == chosen.names) return layer.channels;
  }
  throw Error(ErrorKind::mismatch, file_name,
              "has the channels " + listed(other.channels) + ", but the first face " + listed(part.channels));
}

}  // namespace welkin::map_file
