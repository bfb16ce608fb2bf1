#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Which files each engine loads a world's light from (docs/engines.md): data alone.
namespace welkin {

/// What a file of a set holds.
enum class SetContent {
  specular,    ///< a chain of GGX over roughness
  sheen,       ///< a chain of Charlie's lobe over roughness
  atlas,       ///< PlayCanvas's picture of chains and diffuse light
  diffuse,     ///< the world averaged with Lambert's lobe: irradiance / π
  background,  ///< the world itself
  harmonics,   ///< spherical harmonics of radiance to order 2, in a basis
  table,       ///< the integrals of a BRDF over n·v and roughness
};

/// `specular`, `sheen`, `atlas`, `diffuse`, `background`, `harmonics`, `table`.
WELKIN_API std::string_view name_of(SetContent content);

/// One file of a set. Members that its content has no use for are empty or 0.
struct SetFile {
  SetContent content = SetContent::specular;  ///< what it holds
  std::string name;                           ///< in the folder; its extension names the format
  std::string about;                          ///< one line: what an engine does with it

  std::string to = "cube";            ///< of maps: the parameterization and layout, as parse_map_shape_for
  int width = 0;                      ///< of maps: a chart's, level 0; 0 of a background: the source's detail
  int levels = 1;                     ///< of chains; 0: as many as the size has
  std::string curve = "linear";       ///< of chains: which roughness each level has
  bool mirror_level0 = false;         ///< of chains: level 0 is a mirror's, whatever the curve says
  std::string convention = "native";  ///< of maps and harmonics: the engine's world
  std::string type = {};              ///< of texels, by the name of a pixel type; empty: the format's best
  std::string compression = {};       ///< empty: the format's own
  std::string basis = {};             ///< of harmonics
  std::string table = {};             ///< of tables: the name of one of engine_tables
};

/// A curve that depends on the size of faces, which set_files puts a list in the place of: Babylon.js reads
/// the light of a .glb at level (levels − 1)(1 + 2 log2(roughness) / log2(width)).
inline constexpr std::string_view kGltfCurve = "gltf";

/// What an engine takes of a specular chain, so that a set that it can't load is refused.
struct SetLimits {
  std::vector<std::string> types = {};  ///< of texels; empty: any that the format holds
  std::string types_reason = {};        ///< why no other
  int fewest_levels = 1;                ///< of the chain
  int most_levels = 31;                 ///< of the chain
  bool all_levels = false;              ///< down to one texel
  std::string levels_reason = {};       ///< why no others
  bool power_of_two = false;            ///< faces
  int narrowest = 1;                    ///< face
  std::string width_reason = {};        ///< why no others
};

/// An engine, and the set that it loads.
struct Engine {
  std::string name;     ///< `three.js`, or of another release or kind of scene `three.js,r186`
  std::string title;    ///< as people write it, with the release that was looked at
  std::string summary;  ///< one line
  /// Whether the engine itself was run with such a set; otherwise its source was read.
  bool run = false;
  std::string source;          ///< files of the engine that say what it takes
  std::vector<SetFile> files;  ///< in the order in which they are told
  SetLimits limits;            ///< of the specular chain
  std::string snippet;         ///< code that loads the set; empty where the editor does
};

/// All of them; the first, `general`, is for no engine in particular.
WELKIN_API const std::vector<Engine>& engines();

/// The one of that name. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API const Engine& engine_from_name(std::string_view name);

}  // namespace welkin
