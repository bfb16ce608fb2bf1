#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "welkin/map_file/map_file.h"

/// Which of a file's pictures and channels make a map. Internal to map_file/.
///
/// What stands before the last dot of a channel's name is its layer, what stands behind it says what it holds
/// (Technical Introduction to OpenEXR, "Layers"): `ViewLayer.Combined.R` is the red of `ViewLayer.Combined`.
namespace welkin::map_file {

/// What the channels of a layer are, the most wanted first.
enum class LayerKind {
  colour,  ///< R G B
  grey,    ///< Y
  vector,  ///< X Y Z
  other,   ///< none of these names
  depth,   ///< Z
  alpha,   ///< A
};

/// Channels of one picture with the same name before the last dot.
struct ImageLayer {
  std::size_t picture = 0;  ///< index into FileInfo::parts
  std::string name;         ///< before the dot; empty for plain names
  LayerKind kind = LayerKind::other;
  /// That make a map, in its order: R G B A, Y A, X Y Z, or the first three.
  std::vector<int> channels = {};
  std::vector<std::string> names = {};  ///< what a map calls them
  std::vector<int> members = {};        ///< all channels of the layer
};

/// The layers of one picture, in the order of their first channels.
std::vector<ImageLayer> layers_of(const io::FileInfo& file, std::size_t picture);

/// A choice: of one picture, some channels.
struct ChosenChannels {
  std::size_t picture = 0;         ///< index into FileInfo::parts
  std::vector<int> channels;       ///< indices into PartInfo::channels
  std::vector<std::string> names;  ///< that the map's channels get
  std::vector<std::string> warnings;
};

/// Chooses among `pictures`, indices into the file's parts, at least one: what `options` name by `layer` and
/// `channels`, else what the file declares, else colour before grey before anything else; of several, plain
/// R G B first, then layers whose names say that they are the finished picture, then the first. Warns of a
/// choice between several, and of one without colour, unless it was asked for. Throws Error (bad_request) for
/// channels and layers that there aren't.
ChosenChannels choose_channels(const std::string& file_name, const io::FileInfo& file,
                               std::span<const std::size_t> pictures, const ReadMapOptions& options);

/// Channels of another picture of the same map, a face, like those chosen of the first, which is `part`.
/// Throws Error (mismatch) where it has none.
std::vector<int> channels_like(const ChosenChannels& chosen, const io::PartInfo& part,
                               const std::string& file_name, const io::FileInfo& other_file,
                               std::size_t other_picture);

}  // namespace welkin::map_file
