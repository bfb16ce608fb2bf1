#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/prefilter/prefilter.h"

/// @file
/// PlayCanvas's atlas of pre-filtered lighting.
namespace welkin {

/// A rectangle of the atlas: a whole lat-long of (width − 2)×(height − 2) texels, with a border of one texel
/// that goes on around it.
struct AtlasRectangle {
  int x = 0;           ///< of the left edge, texels
  int y = 0;           ///< of the top edge, texels
  int width = 0;       ///< with the border
  int height = 0;      ///< with the border
  lobe::AnyLobe lobe;  ///< what it is filtered with
};

/// The rectangles of the 512×512 atlas: six of the mirror, each half as large as the one before; GGX of
/// roughness 0.2, 0.4, 0.6, 0.8, 1 and 1, which are read at a material's roughness times 5; Lambert's lobe.
/// Source: PlayCanvas, src/scene/graphics/env-lighting.js, generateAtlas; shader-lib/glsl/chunks,
/// envAtlas.js and reflectionEnv.js, calcReflection.
WELKIN_API std::vector<AtlasRectangle> playcanvas_rectangles();

/// The atlas of a map, R G B: PlayCanvas takes it as a PNG of LightEncoding `rgbp`, of radiance up to 64. The
/// map has R G B, its borders filled. What no rectangle covers is 0. Lat-longs are native, as PlayCanvas
/// reads them. The smallest rectangles are a few texels large: their errors are those of their size. Throws
/// as prefilter_map does, and Error (bad_request) for other channels.
WELKIN_API Image playcanvas_atlas(const Map& source, const PrefilterOptions& options = {},
                                  const Monitor& monitor = {});

}  // namespace welkin
