#include "welkin/map_file/kept_convention.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/sphere/convention.h"

namespace welkin {

using namespace map_file;

std::optional<Matrix3> map_file::declared_orientation(const io::FileInfo& file) {
  std::istringstream in(attribute(file, kOrientationKey));
  in.imbue(std::locale::classic());
  Matrix3 m;
  for (auto& row : m.rows) {
    for (double& value : row) {
      if (!(in >> value)) return std::nullopt;
    }
  }
  if (!is_orthonormal(m)) return std::nullopt;
  return m;
}

namespace {

/// Those that the file can be of: the one that it names, else all that have its orientation.
std::vector<const Convention*> possible_conventions(const MapFileInfo& from) {
  std::vector<const Convention*> possible;
  if (!from.shape) return possible;
  const std::string name = attribute(from.image, kConventionKey);
  const Matrix3 declared = declared_orientation(from.image).value_or(Matrix3{});
  if (!(declared == from.orientation) || (name.empty() && declared == Matrix3{})) return possible;
  for (const Convention& each : conventions()) {
    if (!(orientation_for(each, from.shape->parameterization) == declared)) continue;
    if (each.name == name) return {&each};
    possible.push_back(&each);
  }
  // A name that contradicts the orientation counts for nothing, and what is native needs none.
  if (declared == Matrix3{}) possible.clear();
  return possible;
}

}  // namespace

std::optional<KeptConvention> kept_convention(const MapFileInfo& from,
                                              const sphere::AnyParameterization& to) {
  require(from.shape.has_value(), "the shape of the map whose convention is kept is unknown");
  const std::vector<const Convention*> possible = possible_conventions(from);
  if (possible.empty()) return std::nullopt;
  const Matrix3 orientation = orientation_for(*possible.front(), to);
  const bool alike = std::all_of(possible.begin(), possible.end(), [&](const Convention* each) {
    return orientation_for(*each, to) == orientation;
  });
  if (!alike) return std::nullopt;
  return KeptConvention{possible.front()->name, orientation};
}

bool declares_convention(const MapFileInfo& from) {
  return !possible_conventions(from).empty();
}

}  // namespace welkin
