#include "convert_curve.h"

#include <fmt/core.h>

#include "welkin/prefilter/change_curve.h"

namespace welkin::cli {

void CurveFlags::add(Command command) {
  command.add_option(
      "--roughness-curve", curve,
      "Other roughness for the levels of a chain that `bake` made, without a new bake: a curve "
      "(`welkin list curves`) or a list 0,0.1,0.5; interpolated, and what that costs is told");
  command
      .add_option("--levels", count,
                  "How many levels --roughness-curve makes. Default: as many as the list, or the input, has")
      .within(1, 21);
}

void CurveFlags::parse(const std::string& out, const ReadFlags& read) const {
  if (!asked()) {
    if (count) throw UsageError("--levels: counts those of --roughness-curve, which is not given");
    return;
  }
  parse_option("--roughness-curve", [&] { return lobe::RoughnessCurve::from_name(curve); });
  if (read.level) throw UsageError("--level: --roughness-curve makes all levels");
  if (!holds_levels(out)) throw UsageError("--roughness-curve: " + out + ": the format holds one level");
}

std::vector<Map> CurveFlags::levels(MapReader& reader, const std::string& in, const std::string& out,
                                    MapFileInfo& info) const {
  const auto wanted = lobe::RoughnessCurve::from_name(curve);
  const int listed = wanted.listed_levels();
  const int levels = count.value_or(listed > 0 ? listed : levels_of(info));
  try {
    const Chain source = read_chain(reader);
    const auto mixes = mix_levels(source.notes, MapFrame(source.levels.front()), wanted, levels);
    Chain changed = change_roughness_curve(source, wanted, levels, progress_monitor("convert"));
    end_progress();
    std::string errors;
    for (const LevelMix& mix : mixes) errors += fmt::format(" {:.2g}", 100 * mix.error);
    print_warning(out,
                  fmt::format("its levels are interpolated between those of {}, by roughness, which of usual "
                              "light costs about{} %, level by level",
                              in, errors));
    info.notes = changed.notes;
    info.levels.clear();
    for (const Map& level : changed.levels) info.levels.push_back({level.width(), level.height()});
    return std::move(changed.levels);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::bad_request)
      throw UsageError(std::string("--roughness-curve: ") + error.what());
    throw error.file().empty() ? in_file(in, error) : error;
  }
}

}  // namespace welkin::cli
