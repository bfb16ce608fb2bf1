#include "energy_report.h"

#include <fmt/core.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "command.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

ordered_json direction(const Vec3d& d) {
  return {d.x, d.y, d.z};
}

/// Infinite ratios, of light where there was none, are null.
ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json json_of(const Light& light) {
  return {{"direction", direction(light.direction)},
          {"peak", light.peak},
          {"solid_angle", light.solid_angle},
          {"radius", light.radius}};
}

ordered_json channels_of(const std::vector<std::string>& names, const Energy& energy) {
  ordered_json channels;
  for (std::size_t c = 0; c < names.size(); ++c) channels[names[c]] = energy.channels[c];
  return channels;
}

ordered_json json_of(const EnergyChange& change, const std::vector<std::string>& names) {
  ordered_json ratios;
  for (std::size_t c = 0; c < names.size(); ++c) ratios[names[c]] = finite_or_null(change.ratios[c]);
  return {{"before", change.before.luminance},
          {"after", change.after.luminance},
          {"ratio", finite_or_null(change.ratio)},
          {"channels_before", channels_of(names, change.before)},
          {"channels_after", channels_of(names, change.after)},
          {"channel_ratios", ratios}};
}

void print_line(const std::string& name, double before, double after, double ratio, const std::string& note) {
  fmt::print("{:<12} {:>12.6g} {:>12.6g} {:>10.6f}{}\n", printable(name), before, after, ratio, note);
}

double share_of(const LightChange& light, const EnergyComparison& energy) {
  const double whole = energy.whole.before.luminance;
  return whole > 0 ? light.change.before.luminance / whole : 0;
}

}  // namespace

std::string direction_text(const Vec3d& d) {
  return fmt::format("{:.4f},{:.4f},{:.4f}", d.x, d.y, d.z);
}

std::string change_text(double ratio) {
  return fmt::format("{:+.3g} %", 100 * (ratio - 1));
}

void print_energy(const MapEnergy& energy) {
  std::string channels;
  for (std::size_t c = 0; c < energy.channels.size(); ++c)
    channels += fmt::format("{} {:.6g}, ", printable(energy.channels[c]), energy.whole.channels[c]);
  fmt::print("  energy            {}luminance {:.6g} (radiance·sr)\n", channels, energy.whole.luminance);
  for (std::size_t k = 0; k < energy.lights.size(); ++k) {
    const LightEnergy& each = energy.lights[k];
    fmt::print("  {:<17} along {}: peak {:.6g}, energy {:.6g}, {:.1f} % of all\n",
               fmt::format("light {}", k + 1), direction_text(each.light.direction), each.light.peak,
               each.energy.luminance, 100 * each.share);
  }
}

ordered_json json_of(const MapEnergy& energy) {
  ordered_json report{{"luminance", energy.whole.luminance},
                      {"channels", channels_of(energy.channels, energy.whole)},
                      {"lights", ordered_json::array()}};
  for (const LightEnergy& each : energy.lights) {
    ordered_json light = json_of(each.light);
    light["energy"] = each.energy.luminance;
    light["channels"] = channels_of(energy.channels, each.energy);
    light["share"] = each.share;
    report["lights"].push_back(std::move(light));
  }
  return report;
}

void print_lights(const EnergyComparison& energy) {
  for (std::size_t k = 0; k < energy.lights.size(); ++k) {
    const LightChange& each = energy.lights[k];
    print_line(fmt::format("light {}", k + 1), each.change.before.luminance, each.change.after.luminance,
               each.change.ratio,
               fmt::format("   along {}, {:.1f} % of all", direction_text(each.light.direction),
                           100 * share_of(each, energy)));
  }
}

void print_energy(const EnergyComparison& energy) {
  fmt::print("{:<12} {:>12} {:>12} {:>10}\n", "energy", "before", "after", "ratio");
  for (std::size_t c = 0; c < energy.channels.size(); ++c) {
    print_line(energy.channels[c], energy.whole.before.channels[c], energy.whole.after.channels[c],
               energy.whole.ratios[c], "");
  }
  print_line("luminance", energy.whole.before.luminance, energy.whole.after.luminance, energy.whole.ratio,
             energy.solid_angle < 4 * kPi - 1e-6 ? fmt::format("   of {:.4f} sr", energy.solid_angle) : "");
  print_lights(energy);
}

ordered_json json_of(const EnergyComparison& energy) {
  ordered_json report = json_of(energy.whole, energy.channels);
  report["solid_angle"] = energy.solid_angle;
  report["skipped"] = energy.skipped;
  report["lights"] = ordered_json::array();
  for (const LightChange& each : energy.lights) {
    ordered_json light = json_of(each.light);
    light.update(json_of(each.change, energy.channels));
    light["share"] = share_of(each, energy);
    report["lights"].push_back(std::move(light));
  }
  return report;
}

}  // namespace welkin::cli
