#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/harmonics/harmonics.h"
#include "welkin/io/image_file.h"
#include "welkin/lighting_set/engine.h"
#include "welkin/lighting_set/stored_error.h"
#include "welkin/map/chain.h"
#include "welkin/prefilter/bake.h"
#include "welkin/prefilter/verify.h"

/// @file
/// From a map to all the files that an engine lights a scene with (docs/engines.md).
namespace welkin {

/// What is made otherwise than the engine's data say, and how.
struct SetOptions {
  std::optional<int> width = {};                    ///< of the specular chain's faces
  std::optional<int> levels = {};                   ///< of the specular chain
  std::optional<lobe::RoughnessCurve> curve = {};   ///< of the specular chain
  std::optional<std::string> convention = {};       ///< of all maps and harmonics, by its name
  std::optional<std::string> type = {};             ///< of the specular chain's texels
  TextureQuality quality = TextureQuality::normal;  ///< of compressed textures
  /// The specular chain's faces are halved until its file has no more bytes. 0: no limit.
  std::uint64_t most_bytes = 0;
  bool compare_formats = true;               ///< fill LightingSet::formats
  double tolerance = 1e-3;                   ///< of each level, as PrefilterOptions::tolerance
  Filter mirror_filter = Filter::automatic;  ///< as PrefilterOptions::mirror_filter
  double exposure = 1;                       ///< all radiance is multiplied by
  /// Texels of every level that are compared with brute force (VerifyOptions); 0: none.
  int verified_texels = 0;
  Monitor monitor = {};  ///< progress and cancelling
};

/// A level of a file of a set.
struct SetLevel {
  ChartSize size;                   ///< of a chart
  std::optional<double> roughness;  ///< that it is filtered for
  std::string method;               ///< how it was filtered (PrefilterMethod::name); empty: resampled
  StoredError stored;               ///< of the texels read from the file, against those that were stored
  std::optional<LevelVerification> verification = {};  ///< of those that were stored, where asked
};

/// A file of a set, made.
struct MadeFile {
  SetFile made = {};                  ///< as it was made
  std::vector<std::byte> bytes = {};  ///< its bytes
  std::vector<SetLevel> levels = {};  ///< of maps
  ChainNotes notes = {};              ///< of maps
  io::WriteReport losses = {};        ///< values that the file can't hold
  double error = 0;                   ///< of tables: the largest that rounding made
  double seconds = 0;                 ///< that making it took
  double encoding_seconds = 0;        ///< of these, storing
};

/// What the specular chain takes in another type of texel.
struct FormatChoice {
  std::string type;          ///< `bc6h`
  std::string compression;   ///< `zstd`
  std::uint64_t bytes = 0;   ///< of the KTX2 file
  double rmsle = 0;          ///< StoredError::rmsle over all levels
  double relative_rmse = 0;  ///< StoredError::relative_rmse over all levels
  bool loads = true;         ///< whether the engine takes it
};

/// All files of a set.
struct LightingSet {
  /// Nothing made yet.
  LightingSet(Engine for_engine, harmonics::SphericalHarmonics of_light, Map shown)
      : engine(std::move(for_engine)), light(std::move(of_light)), world(std::move(shown)) {}

  Engine engine;                        ///< that it is for
  std::vector<MadeFile> files;          ///< in its order
  std::vector<FormatChoice> formats;    ///< the largest file first
  std::vector<std::string> warnings;    ///< of what was made otherwise than asked
  harmonics::SphericalHarmonics light;  ///< radiance's, to order 2, without ringing, of the native world
  double light_error = 0;               ///< of irradiance by these: relative RMSE over the sphere
  /// A GGX chain of cubes as an engine reads it from its file; of a set without one, baked besides.
  Chain specular;
  Map world;  ///< what was given, resampled to a small lat-long, to be shown
};

/// What the engine's data and the options make together. Throws Error (bad_request) for what the engine can't
/// load, with its reason, and for names and sizes that there aren't.
WELKIN_API std::vector<SetFile> set_files(const Engine& engine, const SetOptions& options = {});

/// Makes all files of a set, in memory. The alpha of R G B A is left out. Throws as set_files, BakePlan and
/// the formats' writers do; Cancelled.
WELKIN_API LightingSet make_lighting_set(const Map& source, const Engine& engine,
                                         const SetOptions& options = {});

}  // namespace welkin
