#include "welkin/render/shading/sphere_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/scalar.h"

namespace welkin::scene {
namespace {

using Rgb = std::array<float, 3>;

constexpr Rgb kBlack{0.01f, 0.01f, 0.01f}, kWhite{0.9f, 0.9f, 0.9f};
/// Samples along each side of a texel.
constexpr int kSamples = 4;
/// Texels of the rim of `outline`.
constexpr double kRim = 2;

Rgb mixed(const Rgb& a, const Rgb& b, double t) {
  Rgb value{};
  for (std::size_t c = 0; c < 3; ++c) value[c] = static_cast<float>(a[c] + t * (b[c] - a[c]));
  return value;
}

/// A window of four panes, bent as on a ball.
Rgb window(double x, double y) {
  const double u = x + 0.32, v = y - 0.34;
  const double bent_u = u / std::sqrt(std::max(0.05, 1 - 0.5 * y * y)),
               bent_v = v / std::sqrt(std::max(0.05, 1 - 0.5 * x * x));
  const bool inside = std::abs(bent_u) < 0.3 && std::abs(bent_v) < 0.3;
  const bool bar = std::abs(bent_u) < 0.03 || std::abs(bent_v) < 0.03;
  const bool rim = x * x + y * y > 0.93 * 0.93;
  return (inside && !bar) || rim ? kBlack : kWhite;
}

/// Two triangles and a disc, blurred: from cold below to warm above, with a highlight. Gooch et al. 1998.
Rgb cool_warm(double x, double y) {
  const Rgb cold{0.02f, 0.05f, 0.35f}, warm{0.75f, 0.55f, 0.06f}, light{1, 1, 0.95f};
  const double along = (x * -0.5 + y * 0.866) * 1.1;
  const Rgb ground = mixed(cold, warm, 0.5 + 0.5 * std::tanh(1.6 * along));
  const double from = std::hypot(x + 0.35, y - 0.5);
  return mixed(ground, light, std::exp(-std::pow(from / 0.22, 2)));
}

/// Strokes that come where the surface turns away, and cross nearer to the rim.
Rgb hatching(double x, double y) {
  const double r = std::hypot(x, y);
  const auto strokes = [&](double begin, double turn, double width) {
    if (r < begin) return false;
    const double line = (x * std::cos(turn) + y * std::sin(turn)) * 26;
    return line - std::floor(line) < width * std::min(1.0, (r - begin) / (1 - begin) + 0.4);
  };
  const bool dark = r > 0.975 || strokes(0.62, kPi / 4, 0.45) || strokes(0.82, -kPi / 4, 0.45);
  return dark ? kBlack : kWhite;
}

struct Entry {
  const char* name;
  Rgb (*at)(double x, double y);
};
constexpr Entry kPictures[] = {{"window", window}, {"cool-warm", cool_warm}, {"hatching", hatching}};

/// The means over texels of a function of the disc; outside it, of the rim.
template <class At>
Image drawn(int size, const At& at) {
  Image image(size, size, 3);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      for (int k = 0; k < kSamples * kSamples; ++k) {
        double x = 2 * (column + (k % kSamples + 0.5) / kSamples) / size - 1;
        double y = 1 - 2 * (row + (k / kSamples + 0.5) / kSamples) / size;
        const double r = std::hypot(x, y);
        if (r > 1) {
          x /= r;
          y /= r;
        }
        const Rgb value = at(x, y);
        for (std::size_t c = 0; c < 3; ++c) image.at(column, row)[c] += value[c] / (kSamples * kSamples);
      }
    }
  }
  return image;
}

}  // namespace

std::vector<std::string> sphere_picture_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kPictures) names.emplace_back(entry.name);
  names.insert(names.begin() + 2, "outline");
  return names;
}

std::vector<Image> sphere_picture(std::string_view name, int size) {
  require(size >= 8 && size <= 8192, "a picture of a sphere has 8 to 8192 texels a side");
  std::vector<Image> levels;
  if (name == "outline") {
    for (int side = size; side >= 1; side /= 2) {
      // A level of few texels is white but for its rim, at least in its middle.
      const double inner = std::max(1 - 2 * kRim / side, 0.0);
      levels.push_back(
          drawn(side, [&](double x, double y) { return std::hypot(x, y) > inner ? kBlack : kWhite; }));
    }
    return levels;
  }
  const auto found = std::find_if(std::begin(kPictures), std::end(kPictures),
                                  [&](const Entry& each) { return name == each.name; });
  if (found == std::end(kPictures)) {
    throw Error(ErrorKind::bad_request, unknown_name("picture of a sphere", name, sphere_picture_names()));
  }
  for (int side = size; side >= 1; side /= 2) {
    if (levels.empty()) {
      levels.push_back(drawn(side, found->at));
      continue;
    }
    const Image& finer = levels.back();
    Image coarse(side, side, 3);
    const int last = finer.width() - 1;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < 3; ++c)
          coarse.at(x, y)[c] = (finer.at(2 * x, 2 * y)[c] + finer.at(std::min(2 * x + 1, last), 2 * y)[c] +
                                finer.at(2 * x, std::min(2 * y + 1, last))[c] +
                                finer.at(std::min(2 * x + 1, last), std::min(2 * y + 1, last))[c]) /
                               4;
    levels.push_back(std::move(coarse));
  }
  return levels;
}

}  // namespace welkin::scene
