#include "welkin/camera/camera.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"

namespace welkin {
namespace {

Camera camera_of(const char* lens, ChartSize size = {160, 90}) {
  Camera camera;
  camera.lens = lens;
  camera.size = size;
  return camera;
}

/// The world's direction at a position of the picture.
Vec3d seen(const Camera& camera, double u, double v) {
  const MapFrame frame = frame_of(camera);
  return transpose(frame.orientation) * frame.parameterization.to_sphere(0, u, v);
}

double degrees_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * (180 / kPi);
}

void expect_along(const Vec3d& found, const Vec3d& wanted) {
  EXPECT_LT(degrees_between(found, wanted), 1e-6) << found.x << " " << found.y << " " << found.z;
}

TEST(Look, TurnsRightLooksUpAndTiltsRight) {
  const auto ahead = [](const Look& look) { return rotation_of(look) * Vec3d{0, 0, 1}; };
  const auto right = [](const Look& look) { return rotation_of(look) * Vec3d{-1, 0, 0}; };
  expect_along(ahead({}), {0, 0, 1});
  expect_along(ahead({90, 0, 0}), {-1, 0, 0});  // right of +Z in a lat-long
  expect_along(ahead({0, 90, 0}), {0, 1, 0});
  expect_along(ahead({90, 45, 0}), {-1, 1, 0});
  expect_along(right({0, 0, 90}), {0, -1, 0});  // its right side goes down
  expect_along(right({90, 0, 0}), {0, 0, -1});
}

TEST(Camera, ShowsWhatIsAheadUprightAndNotMirrored) {
  for (const char* lens : {"perspective", "pannini", "stereographic", "equidistant", "equisolid",
                           "orthographic", "cylindrical", "latlong", "fisheye-equidistant"}) {
    const Camera camera = camera_of(lens);
    expect_along(seen(camera, 0.5, 0.5), {0, 0, 1});
    EXPECT_LT(seen(camera, 0.6, 0.5).x, -1e-3) << lens;
    EXPECT_GT(seen(camera, 0.5, 0.4).y, 1e-3) << lens;
  }
}

/// Of all lenses, by any axis: half of it to either side, before shifts.
TEST(Camera, FieldOfViewIsTheAngleBetweenOppositeEdges) {
  for (const char* lens : {"perspective", "pannini", "pannini,d=0.3", "stereographic", "equidistant",
                           "equisolid", "orthographic", "cylindrical"}) {
    for (const double fov : {1.0, 60.0, 90.0}) {
      for (const ChartSize size : {ChartSize{160, 90}, ChartSize{90, 160}}) {
        Camera camera = camera_of(lens, size);
        camera.fov = fov;
        EXPECT_NEAR(degrees_between(seen(camera, 0, 0.5), seen(camera, 1, 0.5)), fov, 1e-9) << lens;
        camera.axis = FovAxis::vertical;
        EXPECT_NEAR(degrees_between(seen(camera, 0.5, 0), seen(camera, 0.5, 1)), fov, 1e-9) << lens;
        camera.axis = FovAxis::diagonal;
        EXPECT_NEAR(degrees_between(seen(camera, 0, 0), {0, 0, 1}), fov / 2, 1e-9) << lens;
        EXPECT_NEAR(degrees_between(seen(camera, 1, 1), {0, 0, 1}), fov / 2, 1e-9) << lens;
      }
    }
  }
}

/// Pixels in the middle are square.
TEST(Camera, KeepsTheShapeOfWhatIsAhead) {
  for (const char* lens :
       {"perspective", "pannini", "pannini,d=0.5,vertical=1,fov=120", "stereographic", "equidistant",
        "equisolid", "orthographic", "cylindrical", "dome", "little-planet"}) {
    const Camera camera = camera_of(lens);
    const double x = 0.5 / 160, y = 0.5 / 90;
    const double across = degrees_between(seen(camera, 0.5 - x, 0.5), seen(camera, 0.5 + x, 0.5));
    const double down = degrees_between(seen(camera, 0.5, 0.5 - y), seen(camera, 0.5, 0.5 + y));
    EXPECT_NEAR(across / down, 1, 1e-3) << lens;
  }
}

/// A frame shifted by its own size shows what lies beside: one edge of each is the other's.
TEST(Camera, ShiftedFramesAdjoin) {
  for (const char* lens : {"perspective,fov=40", "pannini,fov=60", "stereographic,fov=60", "equisolid,fov=60",
                           "cylindrical,fov=60", "latlong"}) {
    Camera camera = camera_of(lens), beside = camera, above = camera;
    if (std::string(lens) == "latlong") camera.fov = beside.fov = above.fov = 40;
    beside.shift_right = 1;
    above.shift_up = 1;
    for (const double t : {0.0, 0.3, 1.0}) {
      expect_along(seen(beside, 0, t), seen(camera, 1, t));
      expect_along(seen(above, t, 1), seen(camera, t, 0));
    }
  }
}

TEST(Camera, IsTurnedAsItLooks) {
  Camera camera = camera_of("perspective");
  camera.fov = 90;
  camera.rotation = rotation_of({90, 0, 0});
  expect_along(seen(camera, 0.5, 0.5), {-1, 0, 0});
  expect_along(seen(camera, 1, 0.5), {-1, 0, -1});
  camera.rotation = rotation_of({0, 0, 90});
  camera.size = {100, 100};
  expect_along(seen(camera, 1, 0.5), {0, -1, 1});
}

/// In the dome the front is at the bottom, and what is on the right when one faces it is on the right.
TEST(Camera, DomesShowTheZenithInTheMiddleAndTheFrontAtTheBottom) {
  for (const ChartSize size : {ChartSize{100, 100}, ChartSize{160, 90}, ChartSize{90, 160}}) {
    const Camera camera = camera_of("dome", size);
    const double shorter = std::min(size.width, size.height), x = 0.5 * shorter / size.width,
                 y = 0.5 * shorter / size.height;
    expect_along(seen(camera, 0.5, 0.5), {0, 1, 0});
    expect_along(seen(camera, 0.5, 0.5 + y), {0, 0, 1});
    expect_along(seen(camera, 0.5 + x, 0.5), {-1, 0, 0});
    EXPECT_NEAR(frame_of(camera).parameterization.coverage(), 2 * kPi, 1e-9);
  }
  // A tilt lowers the front; the whole sphere can be covered.
  expect_along(seen(camera_of("dome,tilt=30", {64, 64}), 0.5, 0.5),
               {0, std::cos(kPi / 6), std::sin(kPi / 6)});
  EXPECT_NEAR(frame_of(camera_of("dome,fov=360", {64, 64})).parameterization.coverage(), 4 * kPi, 1e-9);
  expect_along(seen(camera_of("little-planet", {64, 64}), 0.5, 0.5), {0, -1, 0});
}

TEST(Camera, LatlongsWithAFieldOfViewAreWindows) {
  Camera camera = camera_of("latlong", {200, 100});
  camera.fov = 90;
  expect_along(seen(camera, 1, 0.5), {-1, 0, 1});
  EXPECT_NEAR(degrees_between(seen(camera, 0.5, 0), {0, 0, 1}), 22.5, 1e-9);
  camera.axis = FovAxis::vertical;
  expect_along(seen(camera, 0.5, 0), {0, 1, 1});
}

std::string refusal(const Camera& camera) {
  try {
    frame_of(camera);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_request);
    return error.what();
  }
  return "made";
}

void expect_refused(const Camera& camera, const char* with) {
  const std::string message = refusal(camera);
  EXPECT_NE(message.find(with), std::string::npos) << camera.lens << ": " << message;
}

TEST(Camera, RefusesWhatThereCannotBe) {
  const auto with_fov = [](const char* lens, double fov, FovAxis axis = FovAxis::horizontal) {
    Camera camera = camera_of(lens);
    camera.fov = fov;
    camera.axis = axis;
    return camera;
  };
  for (const FovAxis axis : {FovAxis::horizontal, FovAxis::vertical, FovAxis::diagonal}) {
    for (const double fov : {0.0, -1.0, 0.01, 180.0, 360.0, 1e9})
      EXPECT_NE(refusal(with_fov("perspective", fov, axis)), "made") << fov;
    EXPECT_NE(refusal(with_fov("perspective", NAN, axis)), "made");
  }
  expect_refused(with_fov("perspective", 180), "is not a number in");
  expect_refused(with_fov("orthographic", 181), "is not a number in");
  expect_refused(with_fov("pannini,d=0.5", 240), "is at most");
  expect_refused(with_fov("pannini,vertical=1", 175), "is at most");
  expect_refused(with_fov("dome", 361), "is not a number in");
  expect_refused(with_fov("latlong", 360, FovAxis::vertical), "is not a number in");
  Camera wide = with_fov("latlong", 180, FovAxis::vertical);
  wide.size = {300, 100};
  expect_refused(wide, "would show");
  expect_refused(with_fov("latlong", 90, FovAxis::diagonal), "no diagonal");
  expect_refused(with_fov("octahedral", 90), "no field of view");
  expect_refused(with_fov("perspective,fov=60", 60), "given twice");
  expect_refused(with_fov("perspective,vfov=60", 60), "given twice");
  expect_refused(camera_of("cube"), "one chart");
  expect_refused(camera_of("perspectiv"), "did you mean 'perspective'");
  expect_refused(camera_of("perspective", {0, 90}), "at least one pixel");
  expect_refused(camera_of("perspective,vfov=50,dfov=60"), "one says it");
  expect_refused(camera_of("perspective,vfov=170", {10000, 1}), "smaller field of view");
  Camera shifted = camera_of("fisheye-equidistant");
  shifted.shift_up = 0.1;
  expect_refused(shifted, "no frame to shift");
  shifted.lens = "perspective";
  shifted.shift_up = 2;
  expect_refused(shifted, "is not a number in");
  Camera mirrored = camera_of("perspective");
  mirrored.rotation.rows[0][0] = -1;
  expect_refused(mirrored, "rotation");
}

}  // namespace
}  // namespace welkin
