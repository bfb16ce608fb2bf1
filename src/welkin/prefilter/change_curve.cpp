#include "welkin/prefilter/change_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/lobe/zonal.h"
#include "welkin/prefilter/roughness_levels.h"

namespace welkin {
namespace {

/// The degrees that faces of 256 show.
constexpr int kDegree = 512;

lobe::AnyLobe lobe_of(const ChainNotes& notes) {
  const auto refuse = [](const std::string& cause) { throw Error(ErrorKind::mismatch, cause); };
  if (notes.lobe.empty() || notes.roughness.empty())
    refuse("doesn't say which roughness its levels have, so that they can't be interpolated: bake it again");
  const lobe::AnyLobe lobe = lobe::AnyLobe::make(notes.lobe);
  if (!lobe.has_roughness())
    refuse("its levels are filtered with " + notes.lobe + ", which has no roughness");
  if (!std::is_sorted(notes.roughness.begin(), notes.roughness.end()) || notes.roughness.back() > 1)
    refuse("the roughness of its levels falls somewhere, or is over 1");
  if (notes.normalisation == "integral") {
    throw Error(ErrorKind::unsupported,
                "its levels are multiplied by their lobes' integrals, and aren't interpolated");
  }
  return lobe;
}

/// Sums over degrees of products of two differences of lobes, weighted as light is: 2l + 1 coefficients with
/// a power of (l + ½)^−2 each.
double light_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t l = 1; l < a.size(); ++l) sum += a[l] * b[l] / (static_cast<double>(l) + 0.5);
  return sum;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t l = 0; l < a.size(); ++l) d[l] = a[l] - b[l];
  return d;
}

/// Of a source level: its lobe's coefficients, as texels of so many radians show them when they are read
/// bilinearly, which multiplies degree l by about sinc²(l·texel/2π).
class SourceLobes {
 public:
  SourceLobes(const lobe::AnyLobe& lobe, const std::vector<double>& roughness, const MapFrame& finest)
      : lobe_(lobe), roughness_(roughness), finest_(finest) {}

  std::vector<double> wanted(double roughness) const {
    return lobe::zonal_coefficients(lobe_.with_roughness(roughness), kDegree);
  }
  /// Read at the size of level `level`.
  std::vector<double> of(int source, int level) const {
    std::vector<double> list = wanted(roughness_[static_cast<std::size_t>(source)]);
    if (source <= level) return list;
    const ChartSize size = chain_size(finest_.size, source);
    const double texels = static_cast<double>(finest_.parameterization.charts()) * size.width * size.height,
                 texel = std::sqrt(finest_.parameterization.coverage() / texels);
    for (std::size_t l = 1; l < list.size(); ++l) {
      const double x = static_cast<double>(l) * texel / 2, sinc = std::sin(x) / x;
      list[l] *= x < kPi ? sinc * sinc : 0;
    }
    return list;
  }
  const std::vector<double>& roughness() const { return roughness_; }

 private:
  const lobe::AnyLobe& lobe_;
  const std::vector<double>& roughness_;
  const MapFrame& finest_;
};

LevelMix mix_for(const SourceLobes& lobes, double roughness, int level) {
  const std::vector<double>& all = lobes.roughness();
  // Of levels of one roughness the first, which is the finest.
  const auto first_of = [&](double value) {
    return static_cast<int>(std::lower_bound(all.begin(), all.end(), value) - all.begin());
  };
  LevelMix mix;
  mix.roughness = roughness;
  mix.rougher = first_of(std::min(roughness, all.back()));
  mix.finer = mix.rougher;
  if (all[static_cast<std::size_t>(mix.rougher)] > roughness && mix.rougher > 0)
    mix.finer = first_of(all[static_cast<std::size_t>(mix.rougher - 1)]);
  const std::vector<double> wanted = lobes.wanted(roughness), finer = lobes.of(mix.finer, level);
  std::vector<double> error = difference(finer, wanted);
  if (mix.rougher != mix.finer) {
    const std::vector<double> step = difference(lobes.of(mix.rougher, level), finer);
    mix.share = std::clamp(-light_product(error, step) / light_product(step, step), 0.0, 1.0);
    for (std::size_t l = 0; l < error.size(); ++l) error[l] += mix.share * step[l];
  }
  mix.error = std::sqrt(light_product(error, error) / (2 * light_product(wanted, wanted)));
  return mix;
}

Map resized(const Map& source, ChartSize size) {
  Map map(source.parameterization, size.width, size.height, source.channels());
  map.channel_names = source.channel_names;
  map.orientation = source.orientation;
  resample(source, map);
  return map;
}

void add_share(Map& map, const Map& other, float share) {
  const int rows = map.height() + 2 * kBorder, values = (map.width() + 2 * kBorder) * map.channels();
  parallel_for(map.charts() * rows, [&](int i) {
    float* out = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    const float* add = other.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < values; ++x) out[x] += share * (add[x] - out[x]);
  });
}

}  // namespace

std::vector<LevelMix> mix_levels(const ChainNotes& notes, const MapFrame& finest,
                                 const lobe::RoughnessCurve& curve, int levels) {
  const lobe::AnyLobe lobe = lobe_of(notes);
  require(levels >= 1, "a chain has at least one level");
  if (levels > max_levels(finest.size)) {
    throw Error(ErrorKind::bad_request, "charts of " + std::to_string(finest.size.width) + "x" +
                                            std::to_string(finest.size.height) + " have " +
                                            std::to_string(max_levels(finest.size)) + " levels, not " +
                                            std::to_string(levels));
  }
  std::vector<LevelMix> mixes;
  const SourceLobes lobes(lobe, notes.roughness, finest);
  for (const PrefilterLevel& level : roughness_levels(lobe, curve, finest.size, levels))
    mixes.push_back(mix_for(lobes, roughness_of(level.lobe).value_or(0), static_cast<int>(mixes.size())));
  return mixes;
}

Chain change_roughness_curve(const Chain& chain, const lobe::RoughnessCurve& curve, int levels,
                             const Monitor& monitor) {
  require(!chain.levels.empty(), "a chain for another curve has no levels");
  if (chain.notes.roughness.size() != chain.levels.size()) {
    throw Error(ErrorKind::mismatch, "notes the roughness of " +
                                         std::to_string(chain.notes.roughness.size()) + " levels, of the " +
                                         std::to_string(chain.levels.size()) + " that it has");
  }
  const Map& first = chain.levels.front();
  const ChartSize finest{first.width(), first.height()};
  const std::vector<LevelMix> mixes = mix_levels(chain.notes, MapFrame(first), curve, levels);
  Chain changed;
  changed.notes = chain.notes;
  changed.notes.curve = curve.listed_levels() == 0 ? curve.text() : "";
  changed.notes.roughness.clear();
  for (std::size_t k = 0; k < mixes.size(); ++k) {
    const LevelMix& mix = mixes[k];
    const ChartSize size = chain_size(finest, static_cast<int>(k));
    Map level = resized(chain.levels[static_cast<std::size_t>(mix.finer)], size);
    if (mix.share > 0) {
      add_share(level, resized(chain.levels[static_cast<std::size_t>(mix.rougher)], size),
                static_cast<float>(mix.share));
    }
    changed.notes.roughness.push_back(mix.roughness);
    changed.levels.push_back(std::move(level));
    if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
    if (monitor.progress) monitor.progress(static_cast<double>(k + 1) / static_cast<double>(mixes.size()));
  }
  return changed;
}

}  // namespace welkin
