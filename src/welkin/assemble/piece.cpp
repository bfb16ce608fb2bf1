#include "welkin/assemble/piece.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "welkin/assemble/circle_part.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/sphere/custom.h"

namespace welkin {
namespace {

/// How far beyond 0 … 1 alpha may be by the rounding of who filtered it.
constexpr float kAlphaRound = 1e-3f;
/// A circle may reach over a picture's edge by its rounding, texels.
constexpr double kCircleRound = 0.5;

/// Which channels of a map become R G B A; −1: there is no alpha.
struct Sources {
  int channel[4];
};

Sources sources_of(const std::string& name, const std::vector<std::string>& channels) {
  const auto at = [&](const char* wanted) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c] == wanted) return static_cast<int>(c);
    }
    return -1;
  };
  const int r = at("R"), g = at("G"), b = at("B"), y = at("Y"), a = at("A");
  if (r >= 0 && g >= 0 && b >= 0) return {{r, g, b, a}};
  if (y >= 0) return {{y, y, y, a}};
  throw Error(ErrorKind::unsupported, name, "pieces of a world have channels R G B or Y, and perhaps A");
}

void check_values(const std::string& name, const Map& map) {
  std::int64_t not_finite = 0, alpha_outside = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<const float> view = map.level.chart(chart);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const float* texel = view.at(x, y);
        bool finite = true;
        for (int c = 0; c < 4; ++c) finite = finite && std::isfinite(texel[c]);
        if (!finite) ++not_finite;
        if (finite && !(texel[3] >= -kAlphaRound && texel[3] <= 1 + kAlphaRound)) ++alpha_outside;
      }
    }
  }
  if (not_finite > 0)
    throw Error(ErrorKind::bad_value, name,
                std::to_string(not_finite) + " texels have NaN or infinite values: repair them first");
  if (alpha_outside > 0)
    throw Error(ErrorKind::bad_value, name,
                std::to_string(alpha_outside) + " texels have an alpha outside 0 … 1");
}

Map with_colour_and_alpha(const std::string& name, const Map& map) {
  const Sources from = sources_of(name, map.channel_names);
  Map made(map.parameterization, map.width(), map.height(), 4, PixelContents::unset);
  made.orientation = map.orientation;
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<const float> in = map.level.chart(chart);
    const ImageView<float> out = made.level.chart(chart);
    parallel_for(map.height(), [&](int y) {
      for (int x = 0; x < in.width; ++x) {
        for (int c = 0; c < 4; ++c)
          out.at(x, y)[c] = from.channel[c] < 0 ? 1.0f : in.at(x, y)[from.channel[c]];
      }
    });
  }
  return made;
}

void check(const PanelOptions& options) {
  require(options.feather >= 0 && options.feather <= 90, "a picture's feather is 0 to 90 degrees");
  require(options.gain > 0 && std::isfinite(options.gain), "a picture's gain is a positive number");
}

}  // namespace

Piece::Piece(std::string what, Map pixels) : name(std::move(what)), map(with_colour_and_alpha(name, pixels)) {
  check_values(name, map);
  fill_borders(map);
}

Piece make_panel(std::string name, Map map, const PanelOptions& options) {
  check(options);
  map.orientation = transpose(rotation_of(options.look));
  Piece piece(std::move(name), std::move(map));
  piece.feather = options.feather * kDegree;
  piece.layer = options.layer;
  piece.gain = options.gain;
  try {
    piece.edges = edges_of(piece.map.parameterization);
  } catch (const Error& error) {
    if (options.feather > 0) throw in_file(piece.name, error);
  }
  return piece;
}

Piece make_flat_panel(std::string name, Map picture, double fov, const PanelOptions& options) {
  if (!(fov >= 0.1 && fov <= 179))
    throw Error(ErrorKind::bad_request, name,
                "a flat picture's field of view is 0.1 to 179 degrees, not " + number_text(fov));
  const double proportions = static_cast<double>(picture.width()) / picture.height();
  require(proportions >= 1e-3 && proportions <= 1e3, "a flat picture is at most 1000 times as wide as high");
  const auto flat = sphere::AnyParameterization::make("perspective,fov=" + number_text(fov) +
                                                      ",aspect=" + number_text(proportions));
  return make_panel(std::move(name), with_parameterization(flat, std::move(picture)), options);
}

void check_circle(const std::string& name, const Map& picture, const PictureCircle& circle) {
  const double width = picture.width(), height = picture.height();
  const auto [x, y, radius] = circle;
  const bool inside = std::isfinite(x) && std::isfinite(y) && radius >= 2 && x - radius >= -kCircleRound &&
                      y - radius >= -kCircleRound && x + radius <= width + kCircleRound &&
                      y + radius <= height + kCircleRound;
  if (inside) return;
  throw Error(ErrorKind::bad_request, name,
              "the circle of radius " + number_text(radius) + " around (" + number_text(x) + ", " +
                  number_text(y) + ") is not inside the picture of " + number_text(width) + "×" +
                  number_text(height) + " texels, or its radius is below 2");
}

Piece make_disc_panel(std::string name, Map picture, const sphere::AnyParameterization& disc,
                      const std::optional<PictureCircle>& circle, const PanelOptions& options) {
  if (disc.charts() != 1 || disc.full_charts())
    throw Error(ErrorKind::bad_request, name, disc.spec() + " has no disc that could lie in a circle");
  const double width = picture.width(), height = picture.height();
  const PictureCircle where =
      circle.value_or(PictureCircle{width / 2, height / 2, std::min(width, height) / 2});
  check_circle(name, picture, where);
  // The parameterization's own functions are the faster ones.
  if (!circle && picture.width() == picture.height())
    return make_panel(std::move(name), with_parameterization(disc, std::move(picture)), options);
  CirclePart part{disc, where.x / width, where.y / height, where.radius / width, where.radius / height};
  return make_panel(std::move(name),
                    with_parameterization(sphere::make_parameterization(part), std::move(picture)), options);
}

Map with_parameterization(const sphere::AnyParameterization& parameterization, Map map) {
  require(map.charts() == 1 && parameterization.charts() == 1, "a picture is a single chart");
  Map made(parameterization, map.width(), map.height(), map.channels(), PixelContents::unset);
  made.channel_names = map.channel_names;
  made.orientation = map.orientation;
  copy_pixels(map.level.chart(0), made.level.chart(0));
  fill_borders(made);
  return made;
}

}  // namespace welkin
