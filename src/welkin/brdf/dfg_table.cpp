#include "welkin/brdf/dfg_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/brdf/chebyshev.h"
#include "welkin/brdf/dfg_limits.h"

namespace welkin::brdf {
namespace {

constexpr std::array<std::pair<DfgChannel, std::string_view>, 8> kChannels{
    {{DfgChannel::scale, "scale"},
     {DfgChannel::bias, "bias"},
     {DfgChannel::one, "one"},
     {DfgChannel::missing, "missing"},
     {DfgChannel::cloth, "cloth"},
     {DfgChannel::sheen, "sheen"},
     {DfgChannel::disney_diffuse, "disney-diffuse"},
     {DfgChannel::zero, "zero"}}};
constexpr std::array<std::pair<GgxMasking, std::string_view>, 4> kMaskings{
    {{GgxMasking::correlated, "correlated"},
     {GgxMasking::separable, "separable"},
     {GgxMasking::schlick, "schlick"},
     {GgxMasking::approximate, "approximate"}}};

template <class Pairs, class Value>
std::string_view name_in(const Pairs& pairs, Value value) {
  return std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == value; })
      ->second;
}

template <class Pairs>
std::vector<std::string> names_in(const Pairs& pairs) {
  std::vector<std::string> names;
  for (const auto& pair : pairs) names.emplace_back(pair.second);
  return names;
}

template <class Pairs>
auto value_in(const Pairs& pairs, std::string_view kind, std::string_view name) {
  const auto found =
      std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.second == name; });
  if (found == pairs.end()) throw Error(ErrorKind::bad_request, unknown_name(kind, name, names_in(pairs)));
  return found->first;
}

bool needs_ggx(DfgChannel channel) {
  return channel == DfgChannel::scale || channel == DfgChannel::bias || channel == DfgChannel::one ||
         channel == DfgChannel::missing;
}

double ggx_value(DfgChannel channel, const SplitSum& sum) {
  switch (channel) {
    case DfgChannel::scale:
      return sum.scale();
    case DfgChannel::bias:
      return sum.bias();
    case DfgChannel::one:
      return sum.one;
    default:
      return 1 - sum.one;
  }
}

/// The integrals of one roughness, by kind: those that are found together.
enum class Kind { ggx, cloth, direct };

Kind kind_of(DfgChannel channel) {
  if (needs_ggx(channel)) return Kind::ggx;
  return channel == DfgChannel::cloth ? Kind::cloth : Kind::direct;
}

/// Points along n·v from `least` to 1 at which smooth integrals are found. As functions of the angle e above
/// the surface, n·v = sin e, they vary over distances of about e: like e ln e where light and viewer are both
/// low, and at e ≈ α.
class Grading {
 public:
  explicit Grading(double least)
      : least_(std::asin(least)),
        end_(std::asinh((0.5 * kPi - least_) / least_)),
        points_(static_cast<int>(kPoints + kPointsPerUnit * end_)) {}

  std::size_t count() const { return points_.points().size(); }
  double cosine(std::size_t i) const {
    const double angle = least_ + least_ * std::sinh(end_ * points_.points()[i]);
    return std::min(1.0, std::sin(std::min(angle, 0.5 * kPi)));
  }
  void coefficients(double cosine, std::vector<double>& out) const {
    const double above = std::max(0.0, std::asin(cosine) - least_);
    points_.coefficients(std::min(1.0, std::asinh(above / least_) / end_), out);
  }

 private:
  static constexpr double kPoints = 8, kPointsPerUnit = 4;
  double least_, end_;
  ChebyshevPoints points_;
};

SplitSum& operator+=(SplitSum& a, const SplitSum& b) {
  a.one += b.one;
  a.fc += b.fc;
  return a;
}
SplitSum operator*(double factor, const SplitSum& sum) {
  return {factor * sum.one, factor * sum.fc};
}

/// An integral of one roughness at all of `cosines`, which ascend: as `integral` finds it at the lowest, and
/// interpolated above these where that is less work.
template <class Value, class Integral>
std::vector<Value> along_cosines(const std::vector<double>& cosines, const Integral& integral) {
  constexpr std::size_t kShare = 16, kMost = 8;
  const std::size_t lowest = std::clamp<std::size_t>(cosines.size() / kShare, 1, kMost);
  std::vector<Value> values;
  for (std::size_t i = 0; i < lowest; ++i) values.push_back(integral(cosines[i]));
  const std::size_t rest = cosines.size() - lowest;
  if (rest == 0) return values;
  const Grading grading(cosines[lowest]);
  if (grading.count() >= rest) {
    for (std::size_t i = lowest; i < cosines.size(); ++i) values.push_back(integral(cosines[i]));
    return values;
  }
  std::vector<Value> known;
  for (std::size_t k = 0; k < grading.count(); ++k) known.push_back(integral(grading.cosine(k)));
  std::vector<double> coefficients;
  for (std::size_t i = lowest; i < cosines.size(); ++i) {
    grading.coefficients(cosines[i], coefficients);
    Value sum{};
    for (std::size_t k = 0; k < coefficients.size(); ++k) sum += coefficients[k] * known[k];
    values.push_back(sum);
  }
  return values;
}

/// The values of all channels, one roughness: [channel][i].
std::vector<std::vector<double>> line_of(const DfgTable& table, const std::vector<double>& cosines,
                                         double roughness) {
  const auto has = [&](Kind kind) {
    return std::any_of(table.channels.begin(), table.channels.end(),
                       [&](DfgChannel c) { return kind_of(c) == kind; });
  };
  std::vector<SplitSum> ggx;
  std::vector<double> cloth;
  if (has(Kind::ggx)) {
    ggx = along_cosines<SplitSum>(cosines,
                                  [&](double nv) { return ggx_split_sum(nv, roughness, table.masking); });
  }
  if (has(Kind::cloth)) {
    cloth = along_cosines<double>(cosines, [&](double nv) { return charlie_albedo(nv, roughness); });
  }
  std::vector<std::vector<double>> line;
  for (const DfgChannel channel : table.channels) {
    std::vector<double>& values = line.emplace_back();
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const Kind kind = kind_of(channel);
      values.push_back(kind == Kind::ggx     ? ggx_value(channel, within_limits(ggx[i], table.masking))
                       : kind == Kind::cloth ? cloth[i]
                                             : dfg_value(channel, cosines[i], roughness));
    }
  }
  return line;
}

}  // namespace

std::string_view name_of(DfgChannel channel) {
  return name_in(kChannels, channel);
}
DfgChannel dfg_channel_from_name(std::string_view name) {
  return value_in(kChannels, "channel", name);
}
std::vector<std::string> dfg_channel_names() {
  return names_in(kChannels);
}
std::string_view name_of(GgxMasking masking) {
  return name_in(kMaskings, masking);
}
GgxMasking ggx_masking_from_name(std::string_view name) {
  return value_in(kMaskings, "masking", name);
}

double DfgTable::cosine_at(int x, int y) const {
  const double u =
      cosine_down ? texel_coordinate(y, height, placement) : texel_coordinate(x, width, placement);
  return cosine == CosineScale::root ? u * u : u;
}

double DfgTable::roughness_at(int x, int y) const {
  const double v =
      cosine_down ? texel_coordinate(x, width, placement) : texel_coordinate(y, height, placement);
  return roughness == RoughnessScale::alpha ? std::sqrt(v) : v;
}

double dfg_value(DfgChannel channel, double nv, double roughness, GgxMasking masking) {
  switch (channel) {
    case DfgChannel::cloth:
      return charlie_albedo(nv, roughness, ClothMasking::neubelt);
    case DfgChannel::sheen:
      return charlie_albedo(nv, roughness, ClothMasking::charlie);
    case DfgChannel::disney_diffuse:
      return disney_diffuse_albedo(nv, roughness) - 0.5;
    case DfgChannel::zero:
      return 0;
    default:
      return ggx_value(channel, ggx_split_sum(nv, roughness, masking));
  }
}

Image make_dfg_table(const DfgTable& table, const Monitor& monitor) {
  require(table.width >= 1 && table.height >= 1 && table.width <= kLargestDfgSide &&
              table.height <= kLargestDfgSide,
          "a table has sides of 1 to 4096 texels");
  require(!table.channels.empty() && table.channels.size() <= 4, "a table has one to four channels");
  Image image(table.width, table.height, static_cast<int>(table.channels.size()));
  const int lines = table.cosine_down ? table.width : table.height;
  const int along = table.cosine_down ? table.height : table.width;
  std::vector<double> cosines;
  for (int i = 0; i < along; ++i)
    cosines.push_back(table.cosine_down ? table.cosine_at(0, i) : table.cosine_at(i, 0));
  parallel_for(
      lines,
      [&](int line) {
        const double roughness =
            table.cosine_down ? table.roughness_at(line, 0) : table.roughness_at(0, line);
        const auto values = line_of(table, cosines, roughness);
        for (int i = 0; i < along; ++i) {
          float* texel = table.cosine_down ? image.at(line, i) : image.at(i, line);
          for (const auto& channel : values)
            *texel++ = static_cast<float>(channel[static_cast<std::size_t>(i)]);
        }
      },
      monitor);
  return image;
}

}  // namespace welkin::brdf
