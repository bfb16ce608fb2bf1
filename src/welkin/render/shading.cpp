#include "welkin/render/shading.h"

#include <array>

#include "welkin/base/error.h"
#include "welkin/render/shading_look_ups.h"

namespace welkin::scene {
namespace {

struct Entry {
  const char* name;
  const char* description;
  MakeShading make;
};

constexpr Entry kShadings[] = {
    {"material", "glTF's materials: GGX, diffuse light, clear coat, refraction, by pre-filtered chains",
     make_material},
    {"mirror",
     "the world in the cone of the reflected pixel, tinted by the base colour, under Fresnel's factor where "
     "one is asked for",
     make_mirror},
    {"refraction", "a clear body, rays bent once where they enter, and Fresnel's reflection",
     make_refraction},
    {"diffuse", "base colour times diffuse light along the normal", make_diffuse},
    {"globe", "dc·D + sc·S: diffuse light and a mirror's, by the material's metallic (Greene 1986)",
     make_globe},
    {"phong", "Phong's lobe about the reflected direction", make_phong},
    {"normals", "(n + 1)/2, to check geometry", make_normals},
};

}  // namespace

Shading::~Shading() = default;

std::unique_ptr<Shading> make_shading(std::string_view name, const Worlds& worlds,
                                      const ShadingOptions& options) {
  require(options.eta >= 1e-3 && options.eta <= 1e6, "an index of refraction is of 0.001 to 1,000,000");
  require(options.exponent >= 1 && options.exponent <= 1e6, "a Phong exponent is of 1 to 1,000,000");
  std::vector<std::string> names;
  for (const Entry& entry : kShadings) {
    if (name == entry.name) return entry.make(worlds, options);
    names.emplace_back(entry.name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("shading", name, names));
}

std::vector<ShadingName> shading_names() {
  std::vector<ShadingName> names;
  for (const Entry& entry : kShadings) names.push_back({entry.name, entry.description});
  return names;
}

}  // namespace welkin::scene
