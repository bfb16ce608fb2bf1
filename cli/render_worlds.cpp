#include "render_worlds.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "scene_flags.h"
#include "welkin/map/adjust.h"

namespace welkin::cli {
namespace {

/// `sphere:R`, `box:x,y,z,X,Y,Z`, `ground:HEIGHT,RADIUS`, each with `@x,y,z` behind it.
scene::Proxy parse_proxy(const std::string& text) {
  scene::Proxy proxy;
  if (text.empty()) return proxy;
  const std::size_t at = text.find('@'), colon = text.find(':');
  if (at != std::string::npos) proxy.centre = parse_point("--proxy", text.substr(at + 1));
  const std::string shape = text.substr(0, std::min(colon, at));
  std::vector<double> n;
  if (colon != std::string::npos && colon < at)
    n = parse_numbers("--proxy", text.substr(colon + 1, at == std::string::npos ? at : at - colon - 1));
  const auto positive = [&](std::size_t count) {
    return n.size() == count && std::all_of(n.begin(), n.end(), [](double x) { return x > 0; });
  };
  if (shape == "sphere" && positive(1)) {
    proxy.shape = scene::Proxy::Shape::sphere;
    proxy.radius = n[0];
  } else if (shape == "ground" && positive(2) && n[0] < n[1]) {
    proxy.shape = scene::Proxy::Shape::ground;
    proxy.height = n[0];
    proxy.radius = n[1];
  } else if (shape == "box" && n.size() == 6 && n[0] < n[3] && n[1] < n[4] && n[2] < n[5]) {
    proxy.shape = scene::Proxy::Shape::box;
    proxy.least = {n[0], n[1], n[2]};
    proxy.most = {n[3], n[4], n[5]};
  } else {
    throw UsageError(
        "--proxy: '" + text +
        "' is not sphere:RADIUS, box:X0,Y0,Z0,X1,Y1,Z1 or ground:HEIGHT,RADIUS, with @X,Y,Z for its "
        "centre");
  }
  return proxy;
}

}  // namespace

void WorldFlags::add(Command command) {
  command.add_option("--env", env, "Map of the world; may be left out by sketches and normals");
  command.add_option(
      "--chain", chain,
      "That world pre-filtered with GGX, for material: what `bake` makes, KTX2 or EXR with levels. "
      "Default: made from --env");
  command.add_option(
      "--proxy", proxy,
      "Where that world lies, so that what is near is seen from each place: sphere:RADIUS, "
      "box:X0,Y0,Z0,X1,Y1,Z1, ground:HEIGHT,RADIUS (of the camera that took the map), with @X,Y,Z for "
      "where it was taken");
  command.add_option(
      "--own", own,
      "NAME=MAP[@X,Y,Z]: another map for the objects or materials of that name, infinitely far, or "
      "with --proxy about its own centre; can be repeated");
  command
      .add_option("--filter", filter,
                  "How reflected cones are looked up (docs/look-ups.md): auto (gaussian, or probes in large "
                  "maps), nearest, bilinear, trilinear, "
                  "differential, mirrored, box, sat, probes, ewa, hybrid, gaussian")
      .show_default();
  command.add_option("--exposure", exposure, "Brighten the world by this many stops").finite();
  read.add(command);
  read.add_level(command, "Level of the map to take. Default: 0");
}

scene::World WorldFlags::load_one(const std::string& file, const scene::Proxy& where) const {
  std::optional<ConeSamplerOptions> cones;
  if (filter != "auto")
    cones =
        ConeSamplerOptions{.filter = parse_option("--filter", [&] { return cone_filter_from_name(filter); })};
  Map map =
      file.empty() ? Map(sphere::AnyParameterization::make("latlong"), 8, 4, 3) : read.open(file).read();
  if (exposure != 0) scale(map, static_cast<float>(std::exp2(exposure)));
  parse_option("--filter", [&] {
    if (cones && !is_usable(cones->filter, map.parameterization))
      throw Error(ErrorKind::unsupported, filter + " is not for maps of " + map.parameterization.name());
    return 0;
  });
  return scene::World(std::move(map), where, cones);
}

scene::Worlds WorldFlags::load(const scene::Scene& scene) const {
  const scene::Proxy shape = parse_option("--proxy", [&] { return parse_proxy(proxy); });
  scene::Worlds worlds{load_one(env, shape)};
  if (!chain.empty()) {
    try {
      worlds.whole.use_chain(read_chain(chain));
    } catch (const Error& error) {
      throw error.file().empty() ? in_file(chain, error) : error;
    }
  }
  worlds.of_instance.assign(scene.instances.size(), -1);
  for (const std::string& text : own) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw UsageError("--own: '" + text + "' is not NAME=MAP or NAME=MAP@X,Y,Z");
    const std::string name = text.substr(0, equals);
    std::string file = text.substr(equals + 1);
    scene::Proxy where = shape;
    if (const std::size_t at = file.rfind('@'); at != std::string::npos) {
      where.centre = parse_point("--own", file.substr(at + 1));
      file.resize(at);
    }
    bool found = false;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const scene::Instance& instance = scene.instances[i];
      if (instance.name != name && material_of(scene, instance).name != name) continue;
      worlds.of_instance[i] = static_cast<int>(worlds.own.size());
      found = true;
    }
    if (!found) {
      std::vector<std::string> names;
      for (const scene::Instance& instance : scene.instances) names.push_back(instance.name);
      for (const scene::Material& material : scene.materials) names.push_back(material.name);
      std::sort(names.begin(), names.end());
      names.erase(std::unique(names.begin(), names.end()), names.end());
      throw UsageError("--own: " + unknown_name("object or material", name, names));
    }
    worlds.own.push_back(load_one(file, where));
  }
  return worlds;
}

}  // namespace welkin::cli
