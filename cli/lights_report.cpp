#include "lights_report.h"

#include <fmt/core.h>

#include "command.h"
#include "welkin/math/angles.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

ordered_json vector(const Vec3d& v) {
  return {v.x + 0, v.y + 0, v.z + 0};
}

bool has_colour(const LightSet& set) {
  try {
    if (!set.lights.empty()) set.rgb(0);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::string size_text(const ExtractedLight& light) {
  const double a = 2 * light.half_axes[0] / kDegree, b = 2 * light.half_axes[1] / kDegree;
  switch (light.shape) {
    case LightShape::point:
      return fmt::format("under {:.3g}°", a);
    case LightShape::disc:
      return fmt::format("disc {:.3g}°", a);
    case LightShape::ellipse:
      return fmt::format("{:.3g}° × {:.3g}°", a, b);
    case LightShape::region:
      break;
  }
  return "region";
}

}  // namespace

void print_lights(const LightSet& set, const Matrix3& world) {
  if (set.lights.empty()) return;
  const bool colour = has_colour(set);
  fmt::print("light  {:<24} {:>34}  {:>13}  {:<13}\n", "direction",
             colour ? "irradiance R G B" : "irradiance (luminance)", "solid angle sr", "size");
  for (std::size_t k = 0; k < set.lights.size(); ++k) {
    const ExtractedLight& light = set.lights[k];
    const Vec3d d = world * light.direction;
    std::string irradiance = fmt::format("{:.6g}", light.luminance);
    if (colour) {
      const auto [r, g, b] = set.rgb(k);
      irradiance = fmt::format("{:>10.6g} {:>10.6g} {:>10.6g}", r, g, b);
    }
    fmt::print("{:>5}  {:<24} {:>34}  {:>14.4g}  {}\n", k + 1,
               fmt::format("{:.5f},{:.5f},{:.5f}", d.x, d.y, d.z), irradiance, light.solid_angle,
               size_text(light));
  }
}

void print_sun(const LightSet& sun) {
  if (sun.lights.empty()) fmt::print("no sun: nothing stands out\n");
  print_lights(sun);
}

void warn_of_lights(const std::string& in, const LightSet& set) {
  for (std::size_t k = 0; k < set.lights.size(); ++k) {
    const ExtractedLight& light = set.lights[k];
    const auto warn = [&](const std::string& what) {
      print_warning(in, fmt::format("light {}: {}", k + 1, what));
    };
    if (light.shape == LightShape::point)
      warn("smaller than the map's texels show; its solid angle is at most the one given");
    if (light.flat_topped() && light.restored == 1) {
      warn(fmt::format("{} texels have exactly its largest value: it is even, or was clipped and is stronger",
                       light.flat_texels));
    }
    if (light.restored != 1) {
      warn(fmt::format("its irradiance is as asked, {:.6g} times what the map holds", light.restored));
    }
    if (light.cut) warn("reaches the end of what the map shows; there may be more of it");
  }
}

LightSet brightened(LightSet set, double factor) {
  for (ExtractedLight& light : set.lights) {
    for (std::vector<double>* values : {&light.irradiance, &light.peak}) {
      for (double& each : *values) each *= factor;
    }
    light.luminance *= factor;
  }
  return set;
}

ordered_json by_channel(const LightSet& set, const std::vector<double>& values) {
  ordered_json channels = ordered_json::object();
  for (std::size_t c = 0; c < set.channels.size(); ++c) channels[set.channels[c]] = values[c];
  return channels;
}

ordered_json json_of(const LightSet& set, std::size_t k, const Matrix3& world) {
  const ExtractedLight& light = set.lights[k];
  ordered_json irradiance;
  if (has_colour(set)) {
    const auto [r, g, b] = set.rgb(k);
    irradiance = {r, g, b};
  } else {
    irradiance = light.irradiance;
  }
  ordered_json report{{"direction", vector(world * light.direction)},
                      {"irradiance", irradiance},
                      {"luminance", light.luminance},
                      {"solid_angle", light.solid_angle},
                      {"shape", name_of(light.shape)}};
  if (light.shape == LightShape::region) {
    report["texels"] = light.texels;
    return report;
  }
  report["half_axes"] = {light.half_axes[0], light.half_axes[1]};
  report["axis"] = vector(world * light.axis);
  report["peak"] = light.peak;
  report["texels"] = light.texels;
  report["flat_texels"] = light.flat_texels;
  report["cut"] = light.cut;
  report["restored"] = light.restored;
  return report;
}

}  // namespace welkin::cli
