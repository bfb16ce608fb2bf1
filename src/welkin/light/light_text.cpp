#include "welkin/light/light_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/version.h"
#include "welkin/math/angles.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

using Colour = std::array<double, 3>;

/// A light as all of the formats need it.
struct WrittenLight {
  std::string name;
  Vec3d direction;        ///< toward it, in the program's world
  Colour irradiance;      ///< ∫ L dω
  double angular_radius;  ///< of the disc, radians; 0 of a light from one direction

  double strength() const { return *std::max_element(irradiance.begin(), irradiance.end()); }
  /// Of at most 1, linear; white of a black light.
  Colour colour() const {
    const double largest = strength();
    if (!(largest > 0)) return {1, 1, 1};
    return {irradiance[0] / largest, irradiance[1] / largest, irradiance[2] / largest};
  }
  /// ∫ L cos θ dω of the disc, over ∫ L dω: π sin²ρ / (2π (1 − cos ρ)) = cos²(ρ/2).
  double facing() const { return std::pow(std::cos(angular_radius / 2), 2); }
};

/// Names of a list of numbers: `a, b, c`.
template <class Numbers>
std::string list(const Numbers& numbers, const char* between = ", ") {
  std::string text;
  for (const double each : numbers) text += (text.empty() ? "" : between) + number_text(each);
  return text;
}

/// Adding 0 keeps −0 out.
std::array<double, 3> components(const Vec3d& v) {
  return {v.x + 0, v.y + 0, v.z + 0};
}

Vec3d reversed(const Vec3d& v) {
  return {-v.x, -v.y, -v.z};
}

/// The rotation (x, y, z, w) that turns +Z toward `d` by the shortest way: the light shines along −Z.
std::array<double, 4> rotation_to(const Vec3d& d) {
  if (d.z < -1 + 1e-12) return {0, 1, 0, 0};
  const double size = std::sqrt(2 * (1 + d.z));
  return {-d.y / size + 0, d.x / size + 0, 0, size / 2};
}

std::string made_by() {
  return "welkin " + std::string(version());
}

/// An ES module. Colour times intensity is the irradiance.
std::string three_js(const std::vector<WrittenLight>& lights) {
  std::string text =
      "// Lights by " + made_by() +
      ". color × intensity is the irradiance of a surface that faces the light.\n"
      "import { DirectionalLight, Group } from 'three';\n\nexport const lights = new Group();\n";
  for (const WrittenLight& each : lights) {
    text += "{\n  const light = new DirectionalLight();\n  light.name = '" + each.name +
            "';\n  light.color.setRGB(" + list(each.colour()) +
            ");\n  light.intensity = " + number_text(each.strength()) + ";\n  light.position.set(" +
            list(components(each.direction)) + ");\n  lights.add(light);\n}\n";
  }
  return text;
}

std::string gltf(const std::vector<WrittenLight>& lights) {
  std::string definitions, nodes, numbers;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const WrittenLight& each = lights[i];
    const std::string end = i + 1 < lights.size() ? ",\n" : "\n";
    definitions += "        {\"type\": \"directional\", \"name\": \"" + each.name + "\", \"color\": [" +
                   list(each.colour()) + "], \"intensity\": " + number_text(each.strength()) + "}" + end;
    nodes += "    {\"name\": \"" + each.name + "\", \"rotation\": [" + list(rotation_to(each.direction)) +
             "], \"extensions\": {\"KHR_lights_punctual\": {\"light\": " + std::to_string(i) + "}}}" + end;
    numbers += (i > 0 ? ", " : "") + std::to_string(i);
  }
  std::string text = "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"" + made_by() + "\"},\n";
  if (lights.empty()) return text + "  \"scene\": 0,\n  \"scenes\": [{\"name\": \"lights\"}]\n}\n";
  return text + "  \"extensionsUsed\": [\"KHR_lights_punctual\"],\n  \"extensions\": {\n" +
         "    \"KHR_lights_punctual\": {\n      \"lights\": [\n" + definitions + "      ]\n    }\n  },\n" +
         "  \"scene\": 0,\n  \"scenes\": [{\"name\": \"lights\", \"nodes\": [" + numbers +
         "]}],\n  \"nodes\": [\n" + nodes + "  ]\n}\n";
}

/// Rust, with bevy's prelude.
std::string bevy(const std::vector<WrittenLight>& lights) {
  const auto real = [](double value) {
    const std::string text = number_text(value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  };
  const auto reals = [&](const std::array<double, 3>& values) {
    return real(values[0]) + ", " + real(values[1]) + ", " + real(values[2]);
  };
  std::string text = "// Lights by " + made_by() +
                     ". color × illuminance (lux) is the irradiance of a surface that faces the light.\n"
                     "use bevy::prelude::*;\n\npub fn spawn_lights(mut commands: Commands) {\n";
  if (lights.empty()) text += "    let _ = &mut commands;\n";
  for (const WrittenLight& each : lights) {
    text += "    commands.spawn((\n        Name::new(\"" + each.name +
            "\"),\n        DirectionalLight {\n            color: Color::linear_rgb(" + reals(each.colour()) +
            "),\n            illuminance: " + real(each.strength()) +
            ",\n            ..default()\n        },\n        Transform::default().looking_to(Vec3::new(" +
            reals(components(reversed(each.direction))) + "), Vec3::Y),\n    ));\n";
  }
  return text + "}\n";
}

/// Python for Blender's text editor. A sun shines along −Z of its object.
std::string blender(const std::vector<WrittenLight>& lights) {
  std::string text =
      "# Lights by " + made_by() +
      ". Strength × color is the irradiance of a surface that faces the sun, W/m²; angle is its\n"
      "# diameter.\nimport bpy\nfrom mathutils import Vector\n\n\n"
      "def add_sun(name, direction, color, strength, angle):\n"
      "    light = bpy.data.lights.new(name, 'SUN')\n"
      "    light.color = color\n    light.energy = strength\n    light.angle = angle\n"
      "    sun = bpy.data.objects.new(name, light)\n"
      "    sun.rotation_mode = 'QUATERNION'\n"
      "    sun.rotation_quaternion = Vector(direction).to_track_quat('Z', 'Y')\n"
      "    bpy.context.scene.collection.objects.link(sun)\n\n\n";
  for (const WrittenLight& each : lights) {
    text += "add_sun('" + each.name + "', (" + list(components(each.direction)) + "), (" +
            list(each.colour()) + "), " + number_text(each.strength() * each.facing()) + ", " +
            number_text(2 * each.angular_radius) + ")\n";
  }
  return text;
}

std::string pbrt(const std::vector<WrittenLight>& lights) {
  std::string text = "# Lights by " + made_by() + ", in the space of an infinite light that has the map.\n";
  for (const WrittenLight& each : lights) {
    text += "LightSource \"distant\" \"point3 from\" [" + list(components(each.direction), " ") +
            "] \"point3 to\" [0 0 0] \"rgb L\" [" + list(each.irradiance, " ") + "]\n";
  }
  return text;
}

std::string mitsuba(const std::vector<WrittenLight>& lights) {
  std::string text = "<!-- Lights by " + made_by() + " -->\n<scene version=\"3.0.0\">\n";
  for (const WrittenLight& each : lights) {
    const std::array<double, 3> d = components(reversed(each.direction));
    text += "  <emitter type=\"directional\">\n    <vector name=\"direction\" x=\"" + number_text(d[0]) +
            "\" y=\"" + number_text(d[1]) + "\" z=\"" + number_text(d[2]) +
            "\"/>\n    <rgb name=\"irradiance\" value=\"" + list(each.irradiance) + "\"/>\n  </emitter>\n";
  }
  return text + "</scene>\n";
}

/// With `normalize`, intensity is the irradiance of a surface that faces the light.
std::string usd(const std::vector<WrittenLight>& lights) {
  std::string text = "#usda 1.0\n(\n    defaultPrim = \"Lights\"\n    doc = \"Lights by " + made_by() +
                     "\"\n    upAxis = \"Y\"\n)\n\ndef Xform \"Lights\"\n{\n";
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const WrittenLight& each = lights[i];
    const std::array<double, 4> q = rotation_to(each.direction);
    text += (i > 0 ? "\n" : "") + ("    def DistantLight \"" + each.name) +
            "\"\n    {\n        float inputs:angle = " + number_text(2 * each.angular_radius / kDegree) +
            "\n        color3f inputs:color = (" + list(each.colour()) +
            ")\n        float inputs:intensity = " + number_text(each.strength() * each.facing()) +
            "\n        bool inputs:normalize = 1\n        quatd xformOp:orient = (" +
            list(std::array{q[3], q[0], q[1], q[2]}) +
            ")\n        uniform token[] xformOpOrder = [\"xformOp:orient\"]\n    }\n";
  }
  return text + "}\n";
}

struct Writer {
  LightFormat format;
  std::string (*text)(const std::vector<WrittenLight>& lights);
};

const std::vector<Writer>& writers() {
  static const std::vector<Writer> list{
      {{"three.js", "js", "three.js", "an ES module of DirectionalLights; intensity × color in lux"},
       three_js},
      {{"gltf", "gltf", "native", "KHR_lights_punctual, directional; intensity × color in lux"}, gltf},
      {{"bevy", "rs", "native", "Rust that spawns DirectionalLights; illuminance × color in lux"}, bevy},
      {{"blender", "py", "blender", "Python that adds suns with their angles; strength × color in W/m²"},
       blender},
      {{"pbrt", "pbrt", "pbrt", "distant lights of pbrt-v4; L is irradiance"}, pbrt},
      {{"mitsuba", "xml", "mitsuba", "directional emitters of Mitsuba 3; spectral irradiance"}, mitsuba},
      {{"usd", "usda", "usd", "DistantLights with their angles, normalized; intensity × color in lux"}, usd}};
  return list;
}

}  // namespace

const std::vector<LightFormat>& light_formats() {
  static const std::vector<LightFormat> formats = [] {
    std::vector<LightFormat> all;
    for (const Writer& each : writers()) all.push_back(each.format);
    return all;
  }();
  return formats;
}

const LightFormat& light_format_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const LightFormat& each : light_formats()) {
    if (each.name == name) return each;
    names.push_back(each.name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("format of lights", name, names));
}

std::string light_text(const LightFormat& format, const LightSet& lights, double unit) {
  require(unit > 0 && std::isfinite(unit), "the unit of a map is finite and above 0");
  const Matrix3& world = convention_from_name(format.convention).world;
  std::vector<WrittenLight> written;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const ExtractedLight& light = lights.lights[i];
    Colour irradiance = lights.rgb(i);
    for (double& each : irradiance) each = std::max(each * unit, 0.0);
    const double part = std::clamp(light.solid_angle / (4 * kPi), 0.0, 1.0);
    const double radius = light.shape == LightShape::region ? 0 : 2 * std::asin(std::sqrt(part));
    written.push_back({"Light" + std::to_string(i + 1), world * light.direction, irradiance, radius});
  }
  for (const Writer& each : writers()) {
    if (each.format.name == format.name) return each.text(written);
  }
  throw Error(ErrorKind::bad_request, "there is no format of lights called " + format.name);
}

}  // namespace welkin
