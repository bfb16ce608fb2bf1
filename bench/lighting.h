#pragma once

#include <string>
#include <vector>

#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/reference.h"

/// What the benchmarks of pre-filtering share: maps with lights in them, chains, and errors.
namespace welkin::bench {

struct NamedMap {
  std::string name;
  Map map;
};

/// high_dynamic_range's map at width × width/2: as it is where it has that size, else detailed_picture.
Map lighting_picture(int width);

/// Built-in maps of 1024×512 that resemble real environments: studio, sky, room, lamps, sun.
std::vector<NamedMap> built_in_lighting();

/// Maps of 1024×512 that are hard to filter: a sun of 0.5° and 1e5 on 0.1, high, on the horizon and near the
/// pole; a square of 7° that is 5e5 as bright as the rest; 3000 lamps whose radiance ranges over e⁸.
std::vector<NamedMap> hostile_lighting();

/// GGX from roughness 0 to 1, evenly, on charts of `face` and half as large from level to level.
std::vector<PrefilterLevel> ggx_chain(int face, int levels);

PrefilterShape shape_of(const Map& map);

struct LevelErrors {
  double relative_rmse = 0;
  double maximum = 0;  ///< of |error| / |reference|
};

/// A level's texels against brute force with the lobe, all channels together: the RMSE over 300 random
/// texels, weighted by solid angle, and the maximum over these and the 100 that are brightest.
LevelErrors errors_of(const PrefilterReference& reference, const Map& level, const lobe::AnyLobe& lobe);

/// `0.0123 / 0.38`: in percent.
std::string errors_cell(const LevelErrors& errors);
/// 0.0123, for 0.000123.
std::string percent(double part);

}  // namespace welkin::bench
