#include "welkin/image/font.h"

#include <cassert>
#include <span>

#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// A straight stroke from (a, b) to (c, d), or an arc about (a, b) of radius r from angle c to d, degrees,
/// clockwise on the page from the right.
struct Stroke {
  double a, b, c, d, r = 0;
};

struct Glyph {
  char letter;
  double width;
  std::span<const Stroke> strokes;
};

constexpr Stroke kPlus[] = {{-.27, 0, .27, 0}, {0, -.27, 0, .27}};
constexpr Stroke kMinus[] = {{-.27, 0, .27, 0}};
constexpr Stroke kPoint[] = {{-.01, .48, .01, .48}};
constexpr Stroke kPercent[] = {{-.22, -.32, 0, 360, .16}, {.22, .32, 0, 360, .16}, {.3, -.5, -.3, .5}};
constexpr Stroke kX[] = {{-.35, -.5, .35, .5}, {.35, -.5, -.35, .5}};
constexpr Stroke kY[] = {{-.35, -.5, 0, 0}, {.35, -.5, 0, 0}, {0, 0, 0, .5}};
constexpr Stroke kZ[] = {{-.32, -.5, .32, -.5}, {.32, -.5, -.32, .5}, {-.32, .5, .32, .5}};
constexpr Stroke k0[] = {
    {0, -.22, 180, 360, .28}, {0, .22, 0, 180, .28}, {-.28, -.22, -.28, .22}, {.28, -.22, .28, .22}};
constexpr Stroke k1[] = {{-.14, -.36, .06, -.5}, {.06, -.5, .06, .5}};
constexpr Stroke k2[] = {{0, -.22, 180, 395, .28}, {.229, -.059, -.28, .5}, {-.28, .5, .28, .5}};
constexpr Stroke k3[] = {{0, -.26, 205, 450, .24}, {0, .24, 270, 515, .26}};
constexpr Stroke k4[] = {{.12, -.5, -.3, .2}, {-.3, .2, .3, .2}, {.12, -.5, .12, .5}};
constexpr Stroke k5[] = {{.24, -.5, -.2, -.5}, {-.2, -.5, -.229, -.047}, {-.03, .19, 230, 510, .31}};
constexpr Stroke k6[] = {{0, .22, 0, 360, .28}, {-.253, .1, .08, -.5}};
constexpr Stroke k7[] = {{-.28, -.5, .28, -.5}, {.28, -.5, -.1, .5}};
constexpr Stroke k8[] = {{0, -.26, 0, 360, .24}, {0, .24, 0, 360, .26}};
constexpr Stroke k9[] = {{0, -.22, 0, 360, .28}, {.253, -.1, -.08, .5}};
constexpr Stroke kDegrees[] = {{0, -.36, 0, 360, .13}};

constexpr Glyph kGlyphs[] = {{'+', .54, kPlus},  {'-', .54, kMinus},  {'X', .70, kX}, {'Y', .70, kY},
                             {'Z', .64, kZ},     {'0', .56, k0},      {'1', .34, k1}, {'2', .56, k2},
                             {'3', .52, k3},     {'4', .60, k4},      {'5', .56, k5}, {'6', .56, k6},
                             {'7', .56, k7},     {'8', .52, k8},      {'9', .56, k9}, {'o', .26, kDegrees},
                             {'.', .06, kPoint}, {'%', .76, kPercent}};

constexpr double kGap = 0.26;

const Glyph& glyph_of(char letter) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.letter == letter) return glyph;
  }
  assert(false && "a letter the font lacks");
  return kGlyphs[0];
}

double distance_to(const Stroke& s, double x, double y) {
  if (s.r > 0) {
    const double dx = x - s.a, dy = y - s.b;
    const double past_start = atan2(dy, dx) / kDegree - s.c;
    if (past_start - 360 * floor(past_start / 360) <= s.d - s.c) return abs(std::hypot(dx, dy) - s.r);
    const auto to_end = [&](double angle) {
      return std::hypot(dx - s.r * cos(angle * kDegree), dy - s.r * sin(angle * kDegree));
    };
    return min(to_end(s.c), to_end(s.d));
  }
  const double ex = s.c - s.a, ey = s.d - s.b;
  const double along = clamp(((x - s.a) * ex + (y - s.b) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
  return std::hypot(x - s.a - along * ex, y - s.b - along * ey);
}

}  // namespace

double text_width(std::string_view text) {
  assert(!text.empty());
  double width = -kGap;
  for (const char letter : text) width += glyph_of(letter).width + kGap;
  return width;
}

double text_distance(std::string_view text, double x, double y) {
  double nearest = 1e9;
  double left = -text_width(text) / 2;
  for (const char letter : text) {
    const Glyph& glyph = glyph_of(letter);
    const double centre = left + glyph.width / 2;
    for (const Stroke& stroke : glyph.strokes) nearest = min(nearest, distance_to(stroke, x - centre, y));
    left += glyph.width + kGap;
  }
  return nearest;
}

}  // namespace welkin
