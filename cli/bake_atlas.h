#pragma once

#include "bake_levels.h"
#include "sanitize_flags.h"
#include "welkin/prefilter/prefilter.h"

namespace welkin::cli {

/// What `bake --atlas` needs.
struct AtlasRequest {
  std::string in, out;
  WriteMapOptions write;
  PrefilterOptions prefilter;
  Matrix3 turn;
  double brighter = 1;
};

/// Bakes PlayCanvas's atlas. Throws UsageError where the request asks for other levels.
void bake_atlas(AtlasRequest request, const BakeLevels& made, const ReadFlags& read,
                const SanitizeFlags& repair);

}  // namespace welkin::cli
