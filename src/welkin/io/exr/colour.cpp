#include "welkin/io/exr/colour.h"

#include <ImfChromaticities.h>
#include <ImfRgbaYca.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace welkin::io::exr {
namespace {

constexpr Chromaticities kBt709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

struct NamedPrimaries {
  std::string_view name;
  Chromaticities primaries;
};

/// ITU-R BT.709 and BT.2020, SMPTE EG 432-1, Adobe RGB (1998), SMPTE ST 2065-1 and S-2014-004 (ACES).
constexpr std::array<NamedPrimaries, 6> kPrimaries{
    {{"rec709", kBt709},
     {"rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}},
     {"p3d65", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}},
     {"adobergb", {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}}},
     {"ap0", {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, {0.32168, 0.33767}}},
     {"ap1", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}}}};

struct NamedCurve {
  std::string_view name;
  double gamma;  ///< 0 for sRGB's curve
};
constexpr std::array<NamedCurve, 6> kCurves{
    {{"lin", 1}, {"srgb", 0}, {"g18", 1.8}, {"g22", 2.2}, {"g24", 2.4}, {"g26", 2.6}}};

/// What a name such as `lin_ap1_scene` or `srgb_texture` says.
struct Interop {
  std::optional<double> gamma;
  std::optional<Chromaticities> primaries;
};

Interop parse_interop(const std::string& id) {
  Interop interop;
  std::istringstream words(id);
  std::string word;
  if (!std::getline(words, word, '_')) return interop;
  for (const NamedCurve& curve : kCurves) {
    if (curve.name == word) interop.gamma = curve.gamma;
  }
  while (std::getline(words, word, '_')) {
    // `lin_srgb` and `srgb_tx` are older names of BT.709's primaries.
    if (word == "srgb" || word == "texture" || word == "tx") interop.primaries = kBt709;
    for (const NamedPrimaries& named : kPrimaries) {
      if (named.name == word) interop.primaries = named.primaries;
    }
  }
  return interop;
}

std::string interop_id(const Part& part) {
  for (const char* key : {"colorInteropID", "colorInteropId", "interopID", "interopId"}) {
    if (const auto found = part.attributes.find(key); found != part.attributes.end()) return found->second;
  }
  return {};
}

/// Whether colours can be computed from them: no point at infinity, and three primaries that span a triangle.
bool are_usable(const Chromaticities& c) {
  for (const double* point : {c.red, c.green, c.blue, c.white}) {
    if (!(std::abs(point[0]) < 10 && std::abs(point[1]) < 10)) return false;
  }
  const double area =
      (c.green[0] - c.red[0]) * (c.blue[1] - c.red[1]) - (c.blue[0] - c.red[0]) * (c.green[1] - c.red[1]);
  return std::abs(area) > 1e-6 && c.white[1] > 1e-6;
}

/// What one part says.
struct Said {
  Chromaticities primaries = kBt709;
  double gamma = 1;
  bool operator==(const Said&) const = default;
};

Said said_by(Part& part) {
  Said said;
  const std::string id = interop_id(part);
  const Interop interop = parse_interop(id);
  const bool no_colour = id.empty() || id == "data" || id == "unknown";
  if (!no_colour && (!interop.gamma || (!interop.primaries && !part.chromaticities))) {
    part.warnings.push_back("the colour space '" + id + "' is not known: values are read as linear BT.709");
  } else if (interop.gamma && *interop.gamma == 0) {
    part.warnings.push_back("the colour space '" + id +
                            "' is not linear: its values are read as if they were");
  } else if (interop.gamma) {
    said.gamma = *interop.gamma;
  }
  if (interop.gamma && interop.primaries) said.primaries = *interop.primaries;
  if (!part.chromaticities) return said;
  if (are_usable(*part.chromaticities)) {
    said.primaries = *part.chromaticities;
  } else {
    part.warnings.push_back("attribute 'chromaticities' holds no primaries and is ignored");
    part.chromaticities.reset();
  }
  return said;
}

}  // namespace

void declare_colour(std::vector<Part>& parts, Declared& declared) {
  std::vector<Said> all;
  bool any = false;
  for (Part& part : parts) {
    all.push_back(said_by(part));
    any = any || part.chromaticities || !(all.back() == Said{});
  }
  if (!any) return;
  const bool alike =
      std::all_of(all.begin(), all.end(), [&](const Said& said) { return said == all.front(); });
  if (alike) {
    declared.primaries = all.front().primaries;
    if (all.front().gamma != 1) {
      declared.curve = Curve::gamma;
      declared.gamma = all.front().gamma;
    }
    return;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (all[i] == Said{}) continue;
    parts[i].warnings.push_back(
        "its colour space is not that of the file's other parts: values are read as linear BT.709");
  }
}

void convert_chroma(const Part& part, ImageView<const float> stored, std::span<const int> channels,
                    ImageView<float> out) {
  Imf::Chromaticities primaries;
  if (part.chromaticities) {
    const auto point = [](const double(&xy)[2]) {
      return Imath::V2f(static_cast<float>(xy[0]), static_cast<float>(xy[1]));
    };
    const Chromaticities& c = *part.chromaticities;
    primaries = {point(c.red), point(c.green), point(c.blue), point(c.white)};
  }
  const Imath::V3f weights = Imf::RgbaYca::computeYw(primaries);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const float* from = stored.at(x, y);
      const float luminance = from[0], red = (from[1] + 1) * luminance, blue = (from[2] + 1) * luminance;
      // Grey exactly where there is no chroma.
      const bool grey = from[1] == 0 && from[2] == 0;
      const float green = grey ? luminance : (luminance - red * weights.x - blue * weights.z) / weights.y;
      const float values[4] = {red, green, blue, stored.channels > 3 ? from[3] : 1.0f};
      float* to = out.at(x, y);
      for (const int channel : channels) *to++ = values[channel];
    }
  }
}

}  // namespace welkin::io::exr
