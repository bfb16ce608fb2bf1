#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "command.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/pyramid.h"

namespace welkin::cli {
namespace {

struct Sample {
  std::string map, filter = "bilinear";
  std::vector<std::string> directions;
  double level = 0;
  ReadFlags read;

  void run() const;
};

Vec3d checked(const std::string& where, double x, double y, double z) {
  const double longest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || longest == 0)
    throw UsageError(where + " is not a direction");
  return {x / longest, y / longest, z / longest};
}

/// What is looked up, and at which of its levels.
struct Source {
  Sampler sampler;
  double level;
};

void check_level(const std::string& path, double level, int last) {
  if (level > last) throw UsageError(fmt::format("--level: {} has levels 0 to {}", path, last));
}

/// Of a file's levels only those are read that are looked up: one, or the two that the level lies between.
Source levels_of_file(MapReader& reader, const std::string& path, double level,
                      const SamplerOptions& options) {
  check_level(path, level, levels_of(reader.info()) - 1);
  const int finer = static_cast<int>(level);
  Chain chain;
  for (int k = finer; k <= (level > finer ? finer + 1 : finer); ++k) {
    reader.set_level(k);
    chain.levels.push_back(reader.read());
  }
  return {Sampler(std::move(chain), options), level - finer};
}

Source levels_of_pyramid(Map map, const std::string& path, double level, SamplerOptions options) {
  check_level(path, level, levels_below(map.width(), map.height()));
  options.levels = static_cast<int>(std::ceil(level)) + 1;
  return {Sampler(std::move(map), options), level};
}

void print_values(const Source& source, const std::vector<Vec3d>& directions) {
  const auto channels = static_cast<std::size_t>(source.sampler.channels());
  std::vector<float> values(directions.size() * channels);
  source.sampler.look_up(directions, values, source.level);
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::print("{:.9g}{}", values[i], (i + 1) % channels == 0 ? "\n" : " ");
  }
}

void Sample::run() const {
  read.parse();
  SamplerOptions options;
  options.filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  std::vector<Vec3d> given;
  for (const std::string& text : directions) {
    const std::vector<double> n = parse_numbers("--dir", text);
    if (n.size() != 3) throw UsageError("--dir: '" + text + "' is not x,y,z");
    given.push_back(checked("--dir: '" + text + "'", n[0], n[1], n[2]));
  }
  MapReader reader = read.open(map);
  const Source source = levels_of(reader.info()) > 1 ? levels_of_file(reader, map, level, options)
                                                     : levels_of_pyramid(reader.read(), map, level, options);
  if (!directions.empty()) return print_values(source, given);

  std::string line;
  for (int number = 1; std::getline(std::cin, line); ++number) {
    std::istringstream words(line);
    double x = 0, y = 0, z = 0;
    std::string rest;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = fmt::format("standard input, line {}: '{}'", number, printable(line));
    if (!(words >> x >> y >> z) || words >> rest) throw UsageError(where + " is not x y z");
    print_values(source, {checked(where, x, y, z)});
  }
}

}  // namespace

void add_sample(Command app) {
  auto sample = std::make_shared<Sample>();
  Command command = app.add_command("sample", "Print a map's radiance along directions, one line each");
  command.add_option("MAP", sample->map, "Map to read; - is standard input, with --dir").required();
  command
      .add_option("--dir", sample->directions,
                  "Directions x,y,z of any length (+Y is up). Without it: lines `x y z` from standard input")
      .several_words(true);
  command
      .add_option("--level", sample->level,
                  "Level of the file, or of the map's pyramid where the file has one only; 2.5 is halfway "
                  "between two")
      .finite(0);
  command.add_option("--filter", sample->filter, "nearest, bilinear, bicubic, lanczos").show_default();
  sample->read.add(command);
  command.callback([sample] {
    if (sample->map == "-" && sample->directions.empty())
      throw UsageError("-: standard input holds the map, not the directions: give these with --dir");
    sample->map = input_path(sample->map);
    sample->run();
  });
}

}  // namespace welkin::cli
