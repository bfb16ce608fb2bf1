#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "command.h"
#include "welkin/map/pyramid.h"
#include "welkin/map/sample.h"

namespace welkin::cli {
namespace {

struct Sample {
  std::string map, filter = "bilinear";
  std::vector<std::string> directions;
  int level = 0;
  ReadFlags read;

  void run() const;
};

Vec3d checked(const std::string& where, double x, double y, double z) {
  const double longest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || longest == 0)
    throw UsageError(where + " is not a direction");
  return {x / longest, y / longest, z / longest};
}

void print_values(const Map& map, const Level& level, const std::vector<Vec3d>& directions, Filter filter) {
  std::vector<float> values(directions.size() * static_cast<std::size_t>(level.channels()));
  sample(map, level, directions, filter, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool last = (i + 1) % static_cast<std::size_t>(level.channels()) == 0;
    fmt::print("{:.9g}{}", values[i], last ? "\n" : " ");
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
  const LoadedMap loaded = read.read(map);
  if (level > levels_below(loaded.map.width(), loaded.map.height())) {
    throw UsageError(fmt::format("--level: {} has levels 0 to {}", map,
                                 levels_below(loaded.map.width(), loaded.map.height())));
  }
  const std::vector<Level> pyramid = make_pyramid(loaded.map, level);
  const Level& used = level == 0 ? loaded.map.level : pyramid.back();
  if (!directions.empty()) return print_values(loaded.map, used, given, how);

  std::string line;
  for (int number = 1; std::getline(std::cin, line); ++number) {
    std::istringstream words(line);
    double x = 0, y = 0, z = 0;
    std::string rest;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = fmt::format("standard input, line {}: '{}'", number, printable(line));
    if (!(words >> x >> y >> z) || words >> rest) throw UsageError(where + " is not x y z");
    print_values(loaded.map, used, {checked(where, x, y, z)}, how);
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
      ->add_option("--level", sample->level, "Pyramid level: 0 is the map, each next one has half the size")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--filter", sample->filter, "nearest, bilinear, bicubic, lanczos")
      ->capture_default_str();
  sample->read.add(*command);
  command->callback([sample] { sample->run(); });
}

}  // namespace welkin::cli
