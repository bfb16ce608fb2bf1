#include "welkin/render/shading/shading.h"

#include <array>

#include "welkin/base/error.h"
#include "welkin/render/shading/shading_look_ups.h"

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
    {"glossy",
     "the same over a cone as wide as GGX's lobe of the material's roughness, without a pre-filtered chain",
     make_glossy},
    {"refraction", "a clear body, rays bent once where they enter, and Fresnel's reflection",
     make_refraction},
    {"diffuse", "base colour times diffuse light along the normal", make_diffuse},
    {"globe", "dc·D + sc·S: diffuse light and a mirror's, by the material's metallic (Greene 1986)",
     make_globe},
    {"phong", "Phong's lobe about the reflected direction", make_phong},
    {"stack", "a BRDF pre-filtered for several angles of view", make_stack},
    {"warped", "the same from a few directions of view, the nearest three warped to the present one",
     make_warped},
    {"chrome", "cheap chrome: colours by elevation, and highlights of the scene's lights", make_chrome},
    {"matcap", "a picture of a ball, looked up by the normal", make_matcap},
    {"window", "a sketch: the frame of a window",
     [](const Worlds&, const ShadingOptions& options) { return make_sketch("window", options); }},
    {"cool-warm", "a sketch: from cold to warm colours (Gooch et al. 1998)",
     [](const Worlds&, const ShadingOptions& options) { return make_sketch("cool-warm", options); }},
    {"outline", "a sketch: outlines of one width",
     [](const Worlds&, const ShadingOptions& options) { return make_sketch("outline", options); }},
    {"hatching", "a sketch: strokes where surfaces turn away",
     [](const Worlds&, const ShadingOptions& options) { return make_sketch("hatching", options); }},
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

Matrix3 eye_of(const Matrix3& camera_rotation) {
  // Cameras have right −X and ahead +Z.
  const Matrix3 turned{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
  return turned * transpose(camera_rotation);
}

std::vector<ShadingName> shading_names() {
  std::vector<ShadingName> names;
  for (const Entry& entry : kShadings) names.push_back({entry.name, entry.description});
  return names;
}

}  // namespace welkin::scene
