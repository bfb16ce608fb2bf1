#include "welkin/light/light_set.h"

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"

namespace welkin {

std::string_view name_of(LightShape shape) {
  switch (shape) {
    case LightShape::point:
      return "point";
    case LightShape::disc:
      return "disc";
    case LightShape::ellipse:
      return "ellipse";
    case LightShape::region:
      break;
  }
  return "region";
}

std::array<double, 3> LightSet::rgb(std::size_t light) const {
  require(light < lights.size(), "there is no such light");
  const std::vector<double>& values = lights[light].irradiance;
  const auto find = [&](const char* name) {
    return static_cast<std::size_t>(std::find(channels.begin(), channels.end(), name) - channels.begin());
  };
  const std::size_t count = channels.size(), r = find("R"), g = find("G"), b = find("B");
  if (r < count && g < count && b < count) return {values[r], values[g], values[b]};
  const std::size_t y = count == 1 ? 0 : find("Y");
  if (y < count) return {values[y], values[y], values[y]};
  throw Error(ErrorKind::unsupported,
              "lights have a colour where the map has R G B or Y; it has " + listed(channels));
}

}  // namespace welkin
