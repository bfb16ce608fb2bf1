#include "welkin/lighting_set/lighting_set.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/brdf/engine_tables.h"
#include "welkin/filter/resample.h"
#include "welkin/harmonics/coefficients_file.h"
#include "welkin/harmonics/dering.h"
#include "welkin/harmonics/error_of.h"
#include "welkin/harmonics/file_irradiance.h"
#include "welkin/harmonics/project.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/lighting_set/encoded_files.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/prefilter/playcanvas_atlas.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

/// The widest background that is made without being asked for: what WebGL takes everywhere.
constexpr int kWidestBackground = 4096;
/// Faces of the chain that stands for a set without one.
constexpr int kShownFaces = 64;
/// The lat-long that shows the world.
constexpr ChartSize kShownWorld{1024, 512};
/// Irradiance beyond this degree is below 1e-4 of that of a single light.
constexpr int kReferenceDegree = 48;

class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string format_of(const SetFile& file) {
  return io::capabilities_for(std::filesystem::path(file.name).filename()).format;
}

MapShape shape_of(const SetFile& file) {
  return parse_map_shape_for(std::filesystem::path(file.name).filename(), file.to, file.levels == 1 ? 1 : 2);
}

bool is_chain(const SetFile& file) {
  return file.content == SetContent::specular || file.content == SetContent::sheen;
}

class SetMaker {
 public:
  SetMaker(const Map& source, const Engine& engine, const SetOptions& options)
      : source_(source), engine_(engine), options_(options), files_(set_files(engine, options)) {}

  LightingSet run() {
    harmonics::SphericalHarmonics whole = harmonics::project(source_, 2, quiet());
    const std::vector<double> irradiance = harmonics::irradiance_factors(2);
    harmonics::SphericalHarmonics light =
        harmonics::dering(whole, irradiance, harmonics::DeringChannels::each).harmonics;
    const double light_error =
        harmonics::error_of(light, harmonics::reference_of(source_, whole, kReferenceDegree, quiet()),
                            harmonics::irradiance_factors(kReferenceDegree))
            .relative_rmse;
    light *= options_.exposure;
    set_.emplace(engine_, std::move(light), shown_world());
    set_->light_error = light_error;
    for (const SetFile& file : files_) set_->files.push_back(make(file));
    if (set_->specular.levels.empty()) bake_shown_chain();
    return std::move(*set_);
  }

 private:
  Monitor quiet() const { return without_progress(options_.monitor); }

  MadeFile make(const SetFile& file) {
    Clock clock;
    MadeFile made{.made = file};
    switch (file.content) {
      case SetContent::harmonics:
        store_harmonics(made);
        break;
      case SetContent::table:
        store_table(made);
        break;
      case SetContent::background:
        store_chain(made, background(file));
        break;
      case SetContent::atlas:
        store_atlas(made);
        break;
      default:
        bake_and_store(made);
    }
    made.seconds += clock.lap();
    return made;
  }

  BakeOptions bake_options(const SetFile& file) const {
    const char* lobe = file.content == SetContent::specular ? "ggx"
                       : file.content == SetContent::sheen  ? "charlie"
                                                            : "lambert";
    BakeOptions options;
    options.lobe = lobe::AnyLobe::make(lobe);
    options.chain = is_chain(file);
    options.curve = lobe::RoughnessCurve::from_name(file.curve);
    options.target = shape_of(file).parameterization;
    options.size = ChartSize{file.width, height_of(options.target, file.width)};
    options.levels = is_chain(file) ? file.levels : 0;
    options.mirror_level0 = is_chain(file) && file.mirror_level0;
    options.prefilter.tolerance = options_.tolerance;
    options.prefilter.orientation = orientation_for(convention_from_name(file.convention), options.target);
    options.prefilter.mirror_filter = options_.mirror_filter;
    options.prefilter.borders = false;  // files hold none
    return options;
  }

  static int height_of(const sphere::AnyParameterization& parameterization, int width) {
    return std::max(1, static_cast<int>(std::lround(width / parameterization.aspect())));
  }

  void bake_and_store(MadeFile& made) {
    const bool limited = options_.most_bytes > 0 && made.made.content == SetContent::specular;
    while (true) {
      const BakeOptions options = bake_options(made.made);
      const BakePlan plan(source_, options);
      Chain chain = plan.run(source_, options_.monitor);
      std::vector<LevelVerification> verification;
      if (options_.verified_texels > 0) {
        VerifyOptions verify;
        verify.prefilter = options.prefilter;
        verify.random_texels = options_.verified_texels;
        verify.monitor = options_.monitor;
        verification = verify_prefilter(source_, chain.levels, plan.levels(), verify);
      }
      brighten(chain);
      store_chain(made, std::move(chain));
      for (std::size_t i = 0; i < made.levels.size(); ++i) {
        made.levels[i].method = plan.methods()[i].name;
        if (!verification.empty()) made.levels[i].verification = verification[i];
      }
      if (!limited || made.bytes.size() <= options_.most_bytes) return;
      halve(made);
    }
  }

  /// The next smaller cube that the engine takes.
  void halve(MadeFile& made) {
    SetOptions smaller = options_;
    smaller.width = made.made.width / 2;
    std::string reason = "faces can't be smaller";
    if (*smaller.width >= 1) {
      try {
        for (const SetFile& file : set_files(engine_, smaller)) {
          if (file.name != made.made.name) continue;
          const std::size_t before = made.bytes.size();
          made = MadeFile{.made = file};
          const std::string now = std::to_string(file.width), then = std::to_string(2 * file.width);
          set_->warnings.push_back(file.name + ": " + std::to_string(before) + " bytes with faces of " +
                                   then + "; made with faces of " + now);
          return;
        }
      } catch (const Error& error) {
        reason = error.cause();
      }
    }
    throw Error(ErrorKind::bad_request, made.made.name + " has " + std::to_string(made.bytes.size()) +
                                            " bytes with faces of " + std::to_string(made.made.width) +
                                            ", more than " + std::to_string(options_.most_bytes) + ", and " +
                                            reason);
  }

  void brighten(Chain& chain) const {
    if (options_.exposure == 1) return;
    for (Map& level : chain.levels) scale(level, static_cast<float>(options_.exposure));
  }

  Chain background(const SetFile& file) const {
    const sphere::AnyParameterization target = shape_of(file).parameterization;
    ChartSize size{file.width, height_of(target, file.width)};
    if (file.width == 0) {
      size = default_chart_size(source_, target);
      if (size.width > kWidestBackground) size = {kWidestBackground, height_of(target, kWidestBackground)};
    }
    Map map(target, size.width, size.height, source_.channels());
    map.channel_names = source_.channel_names;
    map.orientation = orientation_for(convention_from_name(file.convention), target);
    resample(source_, map, {.filter = options_.mirror_filter, .borders = false, .monitor = options_.monitor});
    Chain chain;
    chain.levels.push_back(std::move(map));
    brighten(chain);
    return chain;
  }

  WriteMapOptions write_options(const std::string& type, const std::string& compression) const {
    WriteMapOptions options;
    if (!type.empty()) options.image.type = io::pixel_type_from_name(type);
    options.image.compression = compression;
    options.image.texture_quality = options_.quality;
    return options;
  }

  /// Into a file in memory, and read from it again.
  void store_chain(MadeFile& made, Chain chain) {
    Clock clock;
    io::MemorySink sink;
    WriteMapOptions write = write_options(made.made.type, made.made.compression);
    if (const std::string basis = io::capabilities(format_of(made.made)).irradiance; !basis.empty()) {
      write.image.irradiance = harmonics::file_irradiance(source_, basis, chain.levels.front().orientation);
      for (double& value : write.image.irradiance) value *= options_.exposure;
    }
    made.losses = write_chain(sink, format_of(made.made), chain, write);
    made.bytes = sink.take();
    made.encoding_seconds = clock.lap();
    Chain again = read_chain(made.bytes, made.made.name, as_written(chain, made.made.to));
    const std::vector<StoredError> errors = stored_errors(chain, again);
    for (std::size_t i = 0; i < chain.levels.size(); ++i) {
      SetLevel level;
      level.size = {chain.levels[i].width(), chain.levels[i].height()};
      if (i < chain.notes.roughness.size()) level.roughness = chain.notes.roughness[i];
      level.stored = errors[i];
      made.levels.push_back(std::move(level));
    }
    made.notes = chain.notes;
    made.made.width = chain.levels.front().width();
    made.made.levels = static_cast<int>(chain.levels.size());
    if (made.made.content != SetContent::specular) return;
    if (options_.compare_formats) compare_formats(made, chain);
    again.notes = chain.notes;
    set_->specular = std::move(again);
  }

  FormatChoice choice_of(const std::string& type, const std::string& compression, std::uint64_t bytes,
                         const std::vector<StoredError>& errors) const {
    StoredError all;
    for (const StoredError& each : errors) all += each;
    const std::vector<std::string>& types = engine_.limits.types;
    const bool loads = types.empty() || std::count(types.begin(), types.end(), type) > 0;
    return {type, compression, bytes, all.rmsle(), all.relative_rmse(), loads};
  }

  void compare_formats(const MadeFile& made, const Chain& chain) {
    set_->formats.clear();
    for (const auto& [type, compression] :
         {std::pair{"half", "none"}, {"rgb9e5", "zstd"}, {"bc6h", "zstd"}, {"uastc-hdr", "zstd"}}) {
      const bool is_made = made.made.type == type && format_of(made.made) == "ktx2";
      std::vector<StoredError> errors;
      std::uint64_t bytes = made.bytes.size();
      if (is_made) {
        for (const SetLevel& level : made.levels) errors.push_back(level.stored);
      } else {
        io::MemorySink sink;
        write_chain(sink, "ktx2", chain, write_options(type, compression));
        bytes = sink.size();
        errors =
            stored_errors(chain, read_chain(sink.bytes(), made.made.name, as_written(chain, made.made.to)));
      }
      const std::string stored =
          is_made ? (made.made.compression.empty() ? "none" : made.made.compression) : compression;
      set_->formats.push_back(choice_of(type, stored, bytes, errors));
    }
    std::stable_sort(set_->formats.begin(), set_->formats.end(),
                     [](const FormatChoice& a, const FormatChoice& b) { return a.bytes > b.bytes; });
  }

  void store_atlas(MadeFile& made) const {
    PrefilterOptions prefilter;
    prefilter.tolerance = options_.tolerance;
    prefilter.mirror_filter = options_.mirror_filter;
    Image atlas = playcanvas_atlas(source_, prefilter, options_.monitor);
    float* const values = atlas.at(0, 0);
    std::transform(values, values + std::ptrdiff_t{3} * atlas.width() * atlas.height(), values,
                   [&](float value) { return value * static_cast<float>(options_.exposure); });
    Clock clock;
    const io::WritePart part{"", atlas.view(), default_channel_names(3)};
    io::WriteOptions options;
    options.type = io::pixel_type_from_name(made.made.type);
    io::MemorySink sink;
    made.losses = io::write(sink, format_of(made.made), {&part, 1}, options);
    made.bytes = sink.take();
    made.encoding_seconds = clock.lap();
    Image again(atlas.width(), atlas.height(), 3);
    constexpr int kAll[] = {0, 1, 2};
    io::open(made.bytes, made.made.name)->read(0, kAll, again.view());
    made.levels.push_back(
        {{atlas.width(), atlas.height()}, {}, {}, stored_error(atlas.view(), again.view()), {}});
    made.made.to = "atlas";
  }

  void store_harmonics(MadeFile& made) const {
    const harmonics::Basis& basis = harmonics::basis_from_name(made.made.basis);
    const Matrix3 world = convention_from_name(made.made.convention).lookup;
    const std::string extension = std::filesystem::path(made.made.name).extension().string().substr(1);
    const std::string text = harmonics::coefficients_text(
        {harmonics::to_basis(set_->light, basis, world), "radiance", made.made.convention},
        harmonics::coefficients_format(extension));
    const auto bytes = std::as_bytes(std::span(text));
    made.bytes.assign(bytes.begin(), bytes.end());
  }

  void store_table(MadeFile& made) const {
    const brdf::EngineTable& table = brdf::engine_table(made.made.table);
    EncodedTable encoded = encode_table(brdf::make_dfg_table(table.table, quiet()), format_of(made.made),
                                        io::pixel_type_from_name(made.made.type));
    made.bytes = std::move(encoded.bytes);
    made.error = encoded.error;
    made.losses = encoded.report;
  }

  void bake_shown_chain() {
    SetFile file;
    file.width = kShownFaces;
    file.levels = 0;
    BakeOptions options = bake_options(file);
    options.prefilter.borders = true;  // the page looks it up
    set_->specular = bake(source_, options, quiet());
    brighten(set_->specular);
  }

  Map shown_world() const {
    Map world(sphere::AnyParameterization::make("latlong"), kShownWorld.width, kShownWorld.height,
              source_.channels());
    world.channel_names = source_.channel_names;
    resample(source_, world, {.monitor = quiet()});
    if (options_.exposure != 1) scale(world, static_cast<float>(options_.exposure));
    return world;
  }

  const Map& source_;
  const Engine& engine_;
  const SetOptions& options_;
  const std::vector<SetFile> files_;
  std::optional<LightingSet> set_;
};

}  // namespace

LightingSet make_lighting_set(const Map& source, const Engine& engine, const SetOptions& options) {
  if (source.channel_names == default_channel_names(4))
    return SetMaker(without_alpha(source), engine, options).run();
  return SetMaker(source, engine, options).run();
}

}  // namespace welkin
