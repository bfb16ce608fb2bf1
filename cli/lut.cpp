#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "json_text.h"
#include "lut_file.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/engine_tables.h"
#include "welkin/brdf/fresnel.h"

namespace welkin::cli {
namespace {

using brdf::DfgTable, brdf::TexelPlacement;
using nlohmann::ordered_json;

struct Lut {
  std::string out, kind = "dfg", engine, size, cosine, roughness, texels, masking, type, format;
  std::optional<std::string> channels;
  std::optional<double> eta, n, k;
  bool cosine_down = false, multiscatter = false, json = false;

  void run();

 private:
  DfgTable dfg_table() const;
  brdf::Boundary boundary() const;
  TexelPlacement placement(TexelPlacement usual) const;
  ChartSize size_or(ChartSize usual) const;
  void refuse(const std::string& option, bool given) const;
  Image make(ordered_json& report);
};

void Lut::refuse(const std::string& option, bool given) const {
  if (given) throw UsageError(fmt::format("--{}: says nothing of a table of kind {}", option, kind));
}

TexelPlacement Lut::placement(TexelPlacement usual) const {
  if (texels.empty()) return usual;
  return texels == "ends" ? TexelPlacement::ends : TexelPlacement::centres;
}

ChartSize Lut::size_or(ChartSize usual) const {
  if (size.empty()) return usual;
  const ChartSize parsed = parse_chart_size("--size", size, sphere::AnyParameterization::make("octahedral"));
  const bool line = kind != "dfg";
  if (line && size.find('x') != std::string::npos && parsed.height != 1)
    throw UsageError("--size: a table of kind " + kind + " is one row: give its width");
  return line ? ChartSize{parsed.width, 1} : parsed;
}

DfgTable Lut::dfg_table() const {
  DfgTable table;
  if (!engine.empty()) table = parse_option("--for", [&] { return brdf::engine_table(engine); }).table;
  const ChartSize asked = size_or({table.width, table.height});
  table.width = asked.width;
  table.height = asked.height;
  table.placement = placement(table.placement);
  if (cosine_down) table.cosine_down = true;
  if (!cosine.empty()) table.cosine = cosine == "root" ? brdf::CosineScale::root : brdf::CosineScale::linear;
  if (!roughness.empty())
    table.roughness = roughness == "alpha" ? brdf::RoughnessScale::alpha : brdf::RoughnessScale::perceptual;
  if (!masking.empty())
    table.masking = parse_option("--masking", [&] { return brdf::ggx_masking_from_name(masking); });
  if (multiscatter) table.channels = {brdf::DfgChannel::bias, brdf::DfgChannel::one};
  if (!channels) return table;
  if (multiscatter) throw UsageError("--multiscatter: stands for --channels bias,one; give one of them");
  table.channels.clear();
  for (std::size_t from = 0; from <= channels->size();) {
    const std::size_t comma = std::min(channels->find(',', from), channels->size());
    table.channels.push_back(parse_option(
        "--channels", [&] { return brdf::dfg_channel_from_name(channels->substr(from, comma - from)); }));
    from = comma + 1;
  }
  return table;
}

brdf::Boundary Lut::boundary() const {
  if (eta && (n || k)) throw UsageError("--eta: give it, or --n and --k, not both");
  const brdf::Boundary asked{eta ? *eta : n.value_or(1.5), k.value_or(0)};
  parse_option(eta ? "--eta" : k ? "--n, --k" : "--n", [&] { brdf::check(asked); });
  return asked;
}

/// Makes the table, and tells what it is.
Image Lut::make(ordered_json& report) {
  const bool dfg = kind == "dfg", fresnel = kind == "fresnel";
  refuse("for", !dfg && !engine.empty());
  refuse("channels", !dfg && channels);
  refuse("multiscatter", !dfg && multiscatter);
  refuse("cosine-down", !dfg && cosine_down);
  refuse("cosine", !dfg && !cosine.empty());
  refuse("roughness", fresnel && !roughness.empty());
  refuse("masking", fresnel && !masking.empty());
  for (const auto& [name, value] : {std::pair{"eta", eta}, {"n", n}, {"k", k}})
    refuse(name, !fresnel && value);
  const auto line = [&](int width, const auto& value) {
    Image image(width, 1, 1);
    for (int i = 0; i < width; ++i) *image.at(i, 0) = static_cast<float>(value(i));
    return image;
  };
  report["kind"] = kind;
  if (dfg) {
    const DfgTable table = dfg_table();
    if (!engine.empty()) report["for"] = engine;
    for (const brdf::DfgChannel channel : table.channels)
      report["channels"].push_back(brdf::name_of(channel));
    report["x"] = table.cosine_down ? "roughness" : "cosine";
    report["cosine"] = table.cosine == brdf::CosineScale::root ? "root" : "linear";
    report["roughness"] = table.roughness == brdf::RoughnessScale::alpha ? "alpha" : "perceptual";
    report["texels"] = table.placement == TexelPlacement::ends ? "ends" : "centres";
    report["masking"] = brdf::name_of(table.masking);
    return parse_option("--size, --channels",
                        [&] { return brdf::make_dfg_table(table, progress_monitor("lut")); });
  }
  const TexelPlacement texel = placement(TexelPlacement::ends);
  const int width = size_or({256, 1}).width;
  report["texels"] = texel == TexelPlacement::ends ? "ends" : "centres";
  if (fresnel) {
    const brdf::Boundary surface = boundary();
    const auto values = parse_option("--size", [&] { return brdf::fresnel_table(surface, width, texel); });
    report["n"] = surface.n;
    report["k"] = surface.k;
    report["interpolation_error"] = brdf::fresnel_table_error(surface, values, texel);
    return line(width, [&](int i) { return values[static_cast<std::size_t>(i)]; });
  }
  if (width > brdf::kLargestDfgSide) throw UsageError("--size: a table has sides of 1 to 4096 texels");
  const auto hiding = masking.empty()
                          ? brdf::GgxMasking::correlated
                          : parse_option("--masking", [&] { return brdf::ggx_masking_from_name(masking); });
  return line(width, [&](int i) {
    const double v = brdf::texel_coordinate(i, width, texel);
    return brdf::ggx_average_albedo(roughness == "alpha" ? std::sqrt(v) : v, hiding);
  });
}

void Lut::run() {
  const bool header = is_c_header(out);
  if (header && !type.empty() && type != "float") throw UsageError("--type: a C header holds float");
  ordered_json report{{"file", out}};
  const std::string usual =
      engine.empty() ? "" : parse_option("--for", [&] { return brdf::engine_table(engine); }).type;
  const io::PixelType stored_type = header ? io::PixelType::float32 : table_type(out, type, usual);
  const Image table = make(report);
  end_progress();
  const StoredTable stored = header ? write_c_header(out, table, fmt::format("welkin lut: {}", report.dump()))
                                    : write_table(out, table, stored_type);
  report["width"] = table.width();
  report["height"] = table.height();
  report["type"] = stored.type;
  report["rounding_error"] = stored.error;
  report["clipped"] = stored.report.above + stored.report.below + stored.report.not_finite;
  if (json) return print_json_text(report);
  std::string what = kind;
  if (report.contains("channels")) {
    for (const auto& channel : report["channels"]) what += " " + channel.get<std::string>();
  }
  fmt::print("{}×{}, {}, stored as {}, rounded by at most {:.2g}\n", table.width(), table.height(), what,
             stored.type, stored.error);
  if (report["clipped"] != 0)
    fmt::print("{} values lie outside what {} holds, and are clipped\n",
               report["clipped"].get<std::uint64_t>(), stored.type);
  if (report.contains("interpolation_error"))
    fmt::print("read with linear interpolation it is within {:.2g} of the formula\n",
               report["interpolation_error"].get<double>());
}

}  // namespace

void add_lut(Command app) {
  auto lut = std::make_shared<Lut>();
  Command command = app.add_command("lut", "Make a renderer's look-up table: DFG, Fresnel, average albedo");
  command.add_option("OUT", lut->out, "ktx2, exr, png…, or .h for C; - is standard output, see --format")
      .required();
  command
      .add_option("--kind", lut->kind,
                  "dfg: split-sum integrals over n·v and roughness; fresnel: reflectance over the cosine; "
                  "average: E's mean "
                  "over roughness")
      .one_of({"dfg", "fresnel", "average"})
      .show_default();
  command.add_option("--for", lut->engine,
                     "Renderer whose axes, contents, size and type the table has (`welkin list luts`); "
                     "other options change it");
  command.add_option("--size", lut->size,
                     "WxH or N texels. Default: the renderer's, 128x128; one row of 256");
  command.add_option(
      "--channels", lut->channels,
      "One to four of scale, bias, one, missing, cloth, sheen, disney-diffuse, zero. Default: scale,bias");
  command.add_flag("--multiscatter", lut->multiscatter, "The same as --channels bias,one");
  command.add_flag("--cosine-down", lut->cosine_down, "n·v runs down and roughness to the right");
  command
      .add_option("--cosine", lut->cosine,
                  "What the coordinate of n·v is: linear, root (√n·v). Default: linear")
      .one_of({"linear", "root"});
  command
      .add_option("--roughness", lut->roughness,
                  "Of the roughness: perceptual, alpha (its square). Default: perceptual")
      .one_of({"perceptual", "alpha"});
  command
      .add_option("--texels", lut->texels,
                  "Where 0 and 1 lie: centres, on the table's outer edges; ends, on the outermost texels' "
                  "centres. Default: "
                  "centres, of one row ends")
      .one_of({"centres", "ends"});
  command.add_option(
      "--masking", lut->masking,
      "How GGX facets hide each other: correlated, separable, schlick, approximate. Default: correlated");
  command.add_option("--eta,--ior", lut->eta, "Of fresnel: index behind over index in front. Default: 1.5")
      .finite();
  command.add_option("--n", lut->n, "Of fresnel: a metal's index").finite();
  command.add_option("--k", lut->k, "And its extinction coefficient").finite();
  command.add_option("--type", lut->type,
                     "Stored values: uint8, uint16, half, float. Default: the renderer's; half in KTX2; the "
                     "format's best");
  command.add_flag("--json", lut->json, "Machine-readable, on standard output");
  add_format(command, lut->format);
  command.callback([lut] {
    lut->out = output_path(lut->out, lut->format);
    lut->run();
  });
}

}  // namespace welkin::cli
