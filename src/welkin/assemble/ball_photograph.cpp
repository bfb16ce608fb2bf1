#include "welkin/assemble/ball_photograph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/assemble/ball_picture.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/math/angles.h"
#include "welkin/sphere/custom.h"

namespace welkin {
namespace {

constexpr double kNearest = 1.01;
/// The ball's outline is seen at an angle from the axis whose sine is 1/distance.
double distance_of(const std::string& name, const Map& photograph, const PictureCircle& circle,
                   const BallPhotographOptions& options) {
  double distance = options.distance;
  if (options.fov) {
    if (!(*options.fov > 0 && *options.fov < 180))
      throw Error(ErrorKind::bad_request, name,
                  "a photograph's field of view is more than 0 and less than 180 degrees, not " +
                      number_text(*options.fov));
    const double tangent =
        circle.radius / (0.5 * photograph.width()) * std::tan(0.5 * *options.fov * kDegree);
    distance = std::sqrt(1 + 1 / (tangent * tangent));
  }
  if (!(distance >= kNearest))
    throw Error(ErrorKind::bad_request, name,
                "the camera is " + number_text(distance) +
                    " ball radii from the ball's centre, and has to be outside the ball: 1.01 at least");
  return distance;
}

void check(const std::string& name, const BallPhotographOptions& options) {
  const auto within = [&](double value, double least, double most, const char* what) {
    if (!(value >= least && value <= most))
      throw Error(ErrorKind::bad_request, name,
                  std::string(what) + " is " + number_text(least) + " to " + number_text(most) + ", not " +
                      number_text(value));
  };
  within(options.camera, 0, 89, "the half angle that the camera hides, degrees,");
  within(options.rim, 0, 1e6, "the rim that is left out, texels,");
  within(options.feather, 0, 90, "the feather, degrees,");
  within(options.gain, 1e-30, 1e30, "the gain");
}

}  // namespace

BallPiece make_ball_piece(std::string name, Map photograph, const BallPhotographOptions& options) {
  check(name, options);
  const double width = photograph.width(), height = photograph.height();
  const PictureCircle circle =
      options.circle.value_or(PictureCircle{width / 2, height / 2, std::min(width, height) / 2});
  check_circle(name, photograph, circle);
  BallPicture picture;
  picture.distance = distance_of(name, photograph, circle, options);
  picture.x = circle.x / photograph.width();
  picture.y = circle.y / photograph.height();
  picture.across = circle.radius / photograph.width();
  picture.down = circle.radius / photograph.height();
  picture.update();
  const double used = 1 - options.rim / circle.radius;
  if (!(used > 0.1))
    throw Error(ErrorKind::bad_request, name,
                "a rim of " + number_text(options.rim) + " texels leaves little of a ball of radius " +
                    number_text(circle.radius));
  const Vec3d last = sphere::MirrorBall(picture.distance).to_sphere(0, 0.5 + 0.5 * used, 0.5);

  // The ball's frame has the camera on +Z: the camera's, turned by half a turn about +Y.
  const Matrix3 turn{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
  photograph.orientation = turn * transpose(rotation_of(options.look));
  Piece piece(std::move(name),
              with_parameterization(sphere::make_parameterization(picture), std::move(photograph)));
  piece.feather = options.feather * kDegree;
  piece.layer = options.layer;
  piece.gain = options.gain;
  const double shown = angle_between(last, {0, 0, 1});
  piece.edges = {{{0, 0, 1}, shown}};
  if (options.camera > 0) piece.edges.push_back({{0, 0, -1}, kPi - options.camera * kDegree});
  return {std::move(piece), picture.distance, std::asin(1 / picture.distance), kPi - shown};
}

}  // namespace welkin
