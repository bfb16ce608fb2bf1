#include <fmt/core.h>

#include <functional>
#include <map>

#include "command.h"
#include "welkin/brdf/brdf.h"
#include "welkin/brdf/engine_tables.h"
#include "welkin/filter/resample.h"
#include "welkin/lighting_set/engine.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/scene/built_in.h"
#include "welkin/sphere/convention.h"
#include "welkin/synth/synth.h"

namespace welkin::cli {
namespace {

void list_parameterizations() {
  for (const std::string& name : sphere::parameterization_names()) fmt::print("{}\n", name);
}

void list_layouts() {
  for (const std::string& name : sphere::parameterization_names()) {
    for (const Layout& layout : layouts_of(sphere::AnyParameterization::make(name))) {
      if (!layout.name.empty()) fmt::print("{}:{}\n", name, layout.name);
    }
  }
}

/// Of parameterizations and of lobes.
template <class Parameters>
void print_parameters(const std::string& name, const Parameters& parameters) {
  for (const auto& p : parameters) {
    fmt::print("{},{}=  {} ({:g} to {:g}, default {:g})\n", name, p.name, p.description, p.minimum, p.maximum,
               p.value);
  }
}

void list_parameters() {
  for (const std::string& name : sphere::parameterization_names())
    print_parameters(name, sphere::AnyParameterization::make(name).parameters());
  for (const std::string& name : lobe::lobe_names()) {
    const lobe::AnyLobe lobe = lobe::AnyLobe::make(name);
    print_parameters(name, lobe.parameters());
    print_parameters(name, lobe.synonyms());
  }
}

void list_lobes() {
  for (const std::string& name : lobe::lobe_names())
    fmt::print("{:<16} {}\n", name, lobe::AnyLobe::make(name).description());
  fmt::print("{:<16} {}\n", "table,file=PATH", lobe::table_description());
}

void list_brdfs() {
  for (const std::string& name : brdf::brdf_names())
    fmt::print("{:<16} {}\n", name, brdf::AnyBrdf::make(name).description());
  fmt::print("{:<16} {}\n", "table,file=PATH", "measured: a file of angles and values");
  fmt::print("{:<16} {}\n", "merl,file=PATH", "measured: a file of the MERL database");
  for (const std::string& name : brdf::brdf_names())
    print_parameters(name, brdf::AnyBrdf::make(name).parameters());
}

void list_curves() {
  for (const std::string& name : lobe::roughness_curve_names()) {
    const auto curve = lobe::RoughnessCurve::from_name(name);
    fmt::print("{:<16} {} ({})\n", name, curve.description(), curve.source());
  }
}

const std::map<std::string, std::function<void()>>& lists() {
  static const std::map<std::string, std::function<void()>> all{
      {"parameterizations", list_parameterizations},
      {"layouts", list_layouts},
      {"parameters", list_parameters},
      {"lobes", list_lobes},
      {"brdfs", list_brdfs},
      {"curves", list_curves},
      {"conventions",
       [] {
         for (const auto& c : conventions()) fmt::print("{:<20} {}\n", c.name, c.description);
       }},
      {"engines",
       [] {
         for (const Engine& each : engines())
           fmt::print("{:<20} {}: {}\n", each.name, each.title, each.summary);
       }},
      {"filters",
       [] {
         for (const char* name : {"auto", "nearest", "bilinear", "bicubic", "lanczos"})
           fmt::print("{}\n", name);
       }},
      {"formats",
       [] {
         for (const auto& format : io::all_capabilities()) {
           for (const auto& extension : format.extensions)
             fmt::print("{}{}\n", extension, format.writable ? "" : "  read only");
         }
       }},
      {"luts",
       [] {
         for (const auto& each : brdf::engine_tables())
           fmt::print("{:<16} {}\n", each.name, each.description);
       }},
      {"methods",
       [] {
         fmt::print("{:<23} {}\n", "alias", "importance: one look-up in a table for each draw");
         fmt::print("{:<23} {}\n", "cdf", "importance: row, then column, by inversion; keeps strata");
         fmt::print("{:<23} {}\n", "exact", "bake: harmonics and near sums, to a tolerance");
         fmt::print("{:<23} {}\n", "paraboloid-convolution", "bake: two planar filters; approximate");
       }},
      {"maps",
       [] {
         for (const auto& name : synth::names()) fmt::print("{:<12} {}\n", name, synth::description(name));
       }},
      {"scenes", [] {
         for (const auto& name : scene::built_in_names())
           fmt::print("{:<12} {}\n", name, scene::built_in_description(name));
       }}};
  return all;
}

}  // namespace

void add_list(Command app) {
  auto what = std::make_shared<std::string>("parameterizations");
  Command command = app.add_command("list", "Names that other commands take");
  std::vector<std::string> names;
  for (const auto& [name, print] : lists()) names.push_back(name);
  command
      .add_option(
          "WHAT", *what,
          "brdfs, conventions, curves, engines, filters, formats, layouts, lobes, luts, maps, methods, "
          "parameterizations, parameters, scenes")
      .show_default();
  command.callback([what, names] {
    const auto found = lists().find(*what);
    if (found == lists().end()) throw UsageError(unknown_name("list", *what, names));
    found->second();
  });
}

}  // namespace welkin::cli
