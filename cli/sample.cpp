#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

#include "command.h"
#include "welkin/filter/sample.h"
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

/// What is looked up: a map at a level, or between two.
struct Levels {
  Map finer;
  std::optional<Map> coarser;  ///< where it has a weight
  double weight = 0;
};

void check_level(const std::string& path, double level, int last) {
  if (level > last) throw UsageError(fmt::format("--level: {} has levels 0 to {}", path, last));
}

Levels levels_of_file(MapReader& reader, const std::string& path, double level) {
  check_level(path, level, levels_of(reader.info()) - 1);
  const int finer = static_cast<int>(level);
  reader.set_level(finer);
  Levels levels{reader.read(), std::nullopt, level - finer};
  if (levels.weight > 0) {
    reader.set_level(finer + 1);
    levels.coarser = reader.read();
  }
  return levels;
}

Levels levels_of_pyramid(Map map, const std::string& path, double level) {
  check_level(path, level, levels_below(map.width(), map.height()));
  const int finer = static_cast<int>(level);
  const double weight = level - finer;
  std::vector<Level> pyramid = make_pyramid(map, weight > 0 ? finer + 1 : finer);
  std::optional<Map> coarser;
  if (weight > 0) {
    coarser.emplace(map.parameterization, 1, 1, map.channels());
    coarser->parameterization = map.parameterization;
    coarser->orientation = map.orientation;
    coarser->level = std::move(pyramid.back());
    pyramid.pop_back();
  }
  if (finer > 0) map.level = std::move(pyramid.back());
  return {std::move(map), std::move(coarser), weight};
}

void print_values(const Levels& levels, const std::vector<Vec3d>& directions, Filter filter) {
  const auto channels = static_cast<std::size_t>(levels.finer.channels());
  std::vector<float> values(directions.size() * channels);
  sample(levels.finer, levels.finer.level, directions, filter, values);
  if (levels.coarser) {
    std::vector<float> coarser(values.size());
    sample(*levels.coarser, levels.coarser->level, directions, filter, coarser);
    const auto weight = static_cast<float>(levels.weight);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = (1 - weight) * values[i] + weight * coarser[i];
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::print("{:.9g}{}", values[i], (i + 1) % channels == 0 ? "\n" : " ");
  }
}

void Sample::run() const {
  read.parse();
  const Filter how = parse_option("--filter", [&] { return filter_from_name(filter); });
  std::vector<Vec3d> given;
  for (const std::string& text : directions) {
    const std::vector<double> n = parse_numbers("--dir", text);
    if (n.size() != 3) throw UsageError("--dir: '" + text + "' is not x,y,z");
    given.push_back(checked("--dir: '" + text + "'", n[0], n[1], n[2]));
  }
  MapReader reader = read.open(map);
  const Levels levels = levels_of(reader.info()) > 1 ? levels_of_file(reader, map, level)
                                                     : levels_of_pyramid(reader.read(), map, level);
  if (!directions.empty()) return print_values(levels, given, how);

  std::string line;
  for (int number = 1; std::getline(std::cin, line); ++number) {
    std::istringstream words(line);
    double x = 0, y = 0, z = 0;
    std::string rest;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = fmt::format("standard input, line {}: '{}'", number, printable(line));
    if (!(words >> x >> y >> z) || words >> rest) throw UsageError(where + " is not x y z");
    print_values(levels, {checked(where, x, y, z)}, how);
  }
}

}  // namespace

void add_sample(CLI::App& app) {
  auto sample = std::make_shared<Sample>();
  CLI::App* command = app.add_subcommand("sample", "Print a map's radiance along directions, one line each");
  command->add_option("MAP", sample->map, "Map to read")->required();
  command
      ->add_option("--dir", sample->directions,
                   "Directions x,y,z of any length (+Y is up). Without it: lines `x y z` from standard input")
      ->allow_extra_args();
  command
      ->add_option("--level", sample->level,
                   "Level of the file, or of the map's pyramid where the file has one only; 2.5 is halfway "
                   "between two")
      ->check(finite_number(0));
  command->add_option("--filter", sample->filter, "nearest, bilinear, bicubic, lanczos")
      ->capture_default_str();
  sample->read.add(*command);
  command->callback([sample] { sample->run(); });
}

}  // namespace welkin::cli
