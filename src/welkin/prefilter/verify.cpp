#include "welkin/prefilter/verify.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample_reference.h"
#include "welkin/map/borders.h"
#include "welkin/map/texel_points.h"
#include "welkin/prefilter/reference.h"
#include "welkin/prefilter/verify_energy.h"
#include "welkin/prefilter/verify_texels.h"

namespace welkin {
namespace {

using namespace prefilter;

constexpr int kLights = 16;
/// Points along a side of a texel that a mirror's reference takes: from so many on, twice as many until a
/// texel's change is as small as this, relatively, or there are so many.
constexpr int kFewestSamples = 32, kMostSamples = 1024;
constexpr double kSettled = 1e-4;
/// Of the source's mean |radiance|: see ReferenceErrors::maximum.
constexpr double kSmall = 1e-6;

/// 0 where both are 0.
double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole > 0 ? part / whole : std::numeric_limits<double>::infinity();
}

/// Whether a value takes the place of the largest so far: NaN does, and keeps it.
bool exceeds(double value, double largest) {
  return !(value <= largest) && !std::isnan(largest);
}

PrefilterShape shape_of(const Map& map) {
  return {map.parameterization, {map.width(), map.height()}, map.channels()};
}

/// Those that errors are measured over: not A where there are others.
std::vector<std::size_t> measured_channels(const Map& map) {
  std::vector<std::size_t> list;
  for (std::size_t c = 0; c < map.channel_names.size(); ++c) {
    if (map.channel_names[c] != "A") list.push_back(c);
  }
  if (list.empty()) list.push_back(0);
  return list;
}

/// The texels of a level that are compared: the random ones first.
struct Compared {
  std::vector<Texel> texels;
  std::vector<Vec3d> directions;
  std::size_t random = 0;
};

Compared compared_texels(const Map& level, const std::vector<Vec3d>& lights, const VerifyOptions& options) {
  Compared compared;
  compared.texels = random_texels(level, options.random_texels, options.seed);
  compared.random = compared.texels.size();
  for (const Texel& texel : hot_texels(level, lights, options)) compared.texels.push_back(texel);
  for (const Texel& texel : compared.texels) compared.directions.push_back(direction_of(level, texel));
  return compared;
}

double solid_angle_of(const Map& level, const Texel& t) {
  return level.parameterization.solid_angle_density(t.chart, (t.x + 0.5) / level.width(),
                                                    (t.y + 0.5) / level.height());
}

/// |map's values − wanted| and |wanted| over some channels.
struct Distance {
  double error = 0, wanted = 0;
};

Distance distance(const float* values, const double* wanted, const std::vector<std::size_t>& channels) {
  double error = 0, size = 0;
  for (const std::size_t c : channels) {
    const double difference = static_cast<double>(values[c]) - wanted[c];
    error += difference * difference;
    size += wanted[c] * wanted[c];
  }
  return {std::sqrt(error), std::sqrt(size)};
}

ReferenceErrors errors_of(const Map& level, const Compared& compared, const std::vector<double>& wanted,
                          double minimum) {
  const std::vector<std::size_t> channels = measured_channels(level);
  ReferenceErrors errors;
  errors.random_texels = static_cast<int>(compared.random);
  errors.hot_texels = static_cast<int>(compared.texels.size() - compared.random);
  double error_squares = 0, squares = 0;
  for (std::size_t i = 0; i < compared.texels.size(); ++i) {
    const Texel& t = compared.texels[i];
    const Distance d = distance(level.level.chart(t.chart).at(t.x, t.y),
                                &wanted[i * static_cast<std::size_t>(level.channels())], channels);
    if (i < compared.random) {
      const double omega = solid_angle_of(level, t);
      error_squares += omega * d.error * d.error;
      squares += omega * d.wanted * d.wanted;
    }
    const double relative = ratio(d.error, std::max(d.wanted, minimum));
    if (exceeds(relative, errors.maximum)) {
      errors.maximum = relative;
      errors.maximum_direction = compared.directions[i];
    }
  }
  errors.relative_rmse = ratio(std::sqrt(error_squares), std::sqrt(squares));
  return errors;
}

/// 1 + difference / ∫ |source|, of the channel farthest from 1.
double energy_of(const std::vector<double>& integral, const std::vector<double>& source,
                 const std::vector<double>& magnitudes) {
  double farthest = 0;
  for (std::size_t c = 0; c < integral.size(); ++c) {
    const double difference = integral[c] - source[c];
    const double relative = std::copysign(ratio(std::fabs(difference), magnitudes[c]), difference);
    if (exceeds(std::fabs(relative), std::fabs(farthest))) farthest = relative;
  }
  return 1 + farthest;
}

PrefilterOptions without_borders(PrefilterOptions options) {
  options.borders = false;
  return options;
}

/// A map of the source's shape that is 1 where it shows anything.
Map furnace_source(const Map& source) {
  Map map(source.parameterization, source.width(), source.height(), 1);
  map.orientation = source.orientation;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) std::fill_n(map.level.chart(chart).row(y), map.width(), 1.0f);
  }
  fill_borders(map);
  return map;
}

/// Largest |value − 1| of valid texels.
double furnace_of_whole_world(const Map& level, double one) {
  double largest = 0;
  std::vector<float> omega(static_cast<std::size_t>(level.width()));
  for (int chart = 0; chart < level.charts(); ++chart) {
    for (int y = 0; y < level.height(); ++y) {
      texel_solid_angles(level.parameterization, level.width(), level.height(), chart, y, omega.data());
      const float* value = level.level.chart(chart).row(y);
      for (int x = 0; x < level.width(); ++x) {
        if (!(omega[static_cast<std::size_t>(x)] > 0)) continue;
        const double off = std::fabs(static_cast<double>(value[x]) / one - 1);
        if (exceeds(off, largest)) largest = off;
      }
    }
  }
  return largest;
}

double furnace_of_part(const Map& level, const Compared& compared, const std::vector<double>& wanted,
                       double one) {
  double largest = 0;
  for (std::size_t i = 0; i < compared.texels.size(); ++i) {
    const Texel& t = compared.texels[i];
    const double value = static_cast<double>(*level.level.chart(t.chart).at(t.x, t.y));
    const double off = std::fabs(value - wanted[i]) / one;
    if (exceeds(off, largest)) largest = off;
  }
  return largest;
}

/// Compares one level after another with references; reports progress to the monitor.
class Verifier {
 public:
  Verifier(const Map& source, std::span<const Map> maps, std::span<const PrefilterLevel> levels,
           const VerifyOptions& options)
      : source_(source),
        levels_(maps),
        options_(options),
        furnace_plan_({source.parameterization, {source.width(), source.height()}, 1},
                      maps.front().parameterization, {levels.begin(), levels.end()},
                      without_borders(options.prefilter)),
        reference_(source) {
    const std::vector<Vec3d> lights = brightest_lights(source, kLights);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const bool mirror = levels[i].lobe.is_mirror(),
                 integral = options.prefilter.scale == LobeScale::integral;
      lobes_.push_back(furnace_plan_.methods()[i].lobe);
      one_.push_back(integral && !mirror ? levels[i].lobe.integral() : 1);
      compared_.push_back(compared_texels(maps[i], lights, options));
      if (!mirror) total_ += compared_.back().texels.size();
    }
  }

  void compare(std::vector<LevelVerification>& results) {
    double squares = 0;
    const std::vector<double> magnitudes = integral_of_magnitudes(source_);
    for (const std::size_t c : measured_channels(source_)) squares += magnitudes[c] * magnitudes[c];
    const double mean = std::sqrt(squares) / source_.parameterization.coverage();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const std::vector<double> wanted =
          lobes_[i].is_mirror() ? resampled(i) : evaluate(reference_, i, source_.channels());
      results[i].reference = errors_of(levels_[i], compared_[i], wanted, kSmall * mean * one_[i]);
    }
  }

  void integrate(std::vector<LevelVerification>& results) const {
    using Integrals = std::vector<std::optional<std::vector<double>>>;
    const Integrals integrals =
        options_.own_texels ? Integrals(levels_.size()) : integrals_of_levels(source_, lobes_, options_);
    const std::vector<double> magnitudes = integral_of_magnitudes(source_);
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      if (options_.own_texels) {
        std::vector<double> energy = integral_of_texels(levels_[i]);
        for (double& each : energy) each /= one_[i];
        results[i].energy = energy_of(energy, reference_.integral(), magnitudes);
      } else if (lobes_[i].is_mirror()) {
        if (levels_[i].parameterization.coverage() < source_.parameterization.coverage() - 1e-9) continue;
        results[i].energy = energy_of(integral_of_texels(levels_[i]), reference_.integral(), magnitudes);
      } else if (integrals[i]) {
        results[i].energy = energy_of(*integrals[i], reference_.integral(), magnitudes);
      }
    }
  }

  void heat(std::vector<LevelVerification>& results) {
    const Map furnace = furnace_source(source_);
    const std::vector<Map> hot = furnace_plan_.run(furnace, {nullptr, options_.monitor.cancelled});
    if (source_.parameterization.whole_world()) {
      for (std::size_t i = 0; i < hot.size(); ++i) {
        results[i].furnace = furnace_of_whole_world(hot[i], one_[i]);
      }
      return;
    }
    const PrefilterReference reference(furnace);
    for (std::size_t i = 0; i < hot.size(); ++i) {
      if (lobes_[i].is_mirror()) continue;
      results[i].furnace = furnace_of_part(hot[i], compared_[i], evaluate(reference, i, 1), one_[i]);
    }
  }

 private:
  /// The source resampled at the texels of a mirror's level.
  std::vector<double> resampled(std::size_t level) const {
    const Map& map = levels_[level];
    const std::size_t channels = static_cast<std::size_t>(map.channels());
    ResampleOptions how;
    how.filter = options_.prefilter.mirror_filter;
    how.monitor = without_progress(options_.monitor);
    std::vector<TexelPlace> places;
    std::vector<std::size_t> open;
    for (const Texel& t : compared_[level].texels) {
      open.push_back(places.size());
      places.push_back({t.chart, t.x, t.y});
    }
    std::vector<double> wanted(places.size() * channels);
    for (int samples = kFewestSamples; !open.empty() && samples <= kMostSamples; samples *= 2) {
      const std::vector<double> values = resample_reference(source_, map, how, samples, places);
      std::vector<std::size_t> still_open;
      std::vector<TexelPlace> still;
      for (std::size_t k = 0; k < open.size(); ++k) {
        double change = 0, size = 0;
        for (std::size_t c = 0; c < channels; ++c) {
          double& before = wanted[open[k] * channels + c];
          const double value = values[k * channels + c];
          change = std::max(change, std::fabs(value - before));
          size = std::max(size, std::fabs(value));
          before = value;
        }
        if (samples > kFewestSamples && change <= kSettled * size) continue;
        still_open.push_back(open[k]);
        still.push_back(places[k]);
      }
      open = std::move(still_open);
      places = std::move(still);
    }
    return wanted;
  }

  /// The reference at the texels of a level, in the level's scale.
  std::vector<double> evaluate(const PrefilterReference& reference, std::size_t level, int channels) {
    const Compared& compared = compared_[level];
    std::vector<double> wanted(compared.texels.size() * static_cast<std::size_t>(channels));
    const double before = static_cast<double>(done_), part = static_cast<double>(compared.texels.size());
    // A source that shows a part needs a second reference, of the furnace.
    const double all = static_cast<double>(total_) * (source_.parameterization.whole_world() ? 1 : 2);
    reference.evaluate(lobes_[level], compared.directions, wanted,
                       part_of(options_.monitor, before / all, (before + part) / all));
    done_ += compared.texels.size();
    for (double& value : wanted) value *= one_[level];
    return wanted;
  }

  const Map& source_;
  std::span<const Map> levels_;
  const VerifyOptions& options_;
  PrefilterPlan furnace_plan_;
  std::vector<lobe::AnyLobe> lobes_;  ///< that the levels are filtered with
  std::vector<double> one_;           ///< what a radiance of 1 everywhere becomes
  PrefilterReference reference_;
  std::vector<Compared> compared_;
  std::size_t total_ = 0, done_ = 0;
};

}  // namespace

void check_verifiable(const PrefilterShape& source) {
  const std::int64_t texels =
      std::int64_t{source.parameterization.charts()} * source.size.width * source.size.height;
  if (texels <= kMaxVerifiedTexels) return;
  throw Error(ErrorKind::too_large,
              "verify: " + std::to_string(texels) + " texels of source are more than the " +
                  std::to_string(kMaxVerifiedTexels) + " that the reference has memory for");
}

std::vector<LevelVerification> verify_prefilter(const Map& source, std::span<const Map> maps,
                                                std::span<const PrefilterLevel> levels,
                                                const VerifyOptions& options) {
  require(maps.size() == levels.size(), "verifying takes one map for each level");
  for (std::size_t i = 0; i < maps.size(); ++i) {
    require(maps[i].width() == levels[i].size.width && maps[i].height() == levels[i].size.height &&
                maps[i].channels() == source.channels(),
            "a map to verify has another size or number of channels than its level");
  }
  check_verifiable(shape_of(source));
  std::vector<LevelVerification> results(maps.size());
  if (maps.empty()) return results;
  Verifier verifier(source, maps, levels, options);
  verifier.integrate(results);
  verifier.compare(results);
  if (!options.own_texels) verifier.heat(results);
  return results;
}

}  // namespace welkin
