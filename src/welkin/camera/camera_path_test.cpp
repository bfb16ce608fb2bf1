#include "welkin/camera/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin {
namespace {

double angle_between(const Matrix3& a, const Matrix3& b) {
  const Matrix3 m = transpose(a) * b;
  // By the chord |a − b|² = 8 sin²(angle/2), precise for small ones.
  double square = 0;
  for (std::size_t i = 0; i < 9; ++i) square += std::pow(a.rows[i / 3][i % 3] - b.rows[i / 3][i % 3], 2);
  (void)m;
  return 2 * std::asin(std::min(1.0, std::sqrt(square / 8))) * (180 / kPi);
}

CameraKey key(double frame, double yaw, double pitch = 0, double roll = 0) {
  return {frame, {yaw, pitch, roll}, {}};
}

/// The yaw of a camera that looks level.
double yaw_at(const CameraPath& path, double frame) {
  const Vec3d d = path.at(frame).rotation * Vec3d{0, 0, 1};
  return std::atan2(-d.x, d.z) * (180 / kPi);
}

TEST(CameraPath, PassesThroughItsKeys) {
  const std::vector<CameraKey> keys{key(-3, 10, 20, 30), key(1, 700, -80, 15), key(2.5, -250, 90, 300),
                                    key(40, -250, 90, 300), key(41, 0, 0, 0)};
  const CameraPath path(keys);
  for (const CameraKey& each : keys)
    EXPECT_LT(angle_between(path.at(each.frame).rotation, rotation_of(each.look)), 1e-6);
  EXPECT_LT(angle_between(path.at(-100).rotation, rotation_of(keys.front().look)), 1e-6);
  EXPECT_LT(angle_between(path.at(1e300).rotation, rotation_of(keys.back().look)), 1e-6);
}

TEST(CameraPath, OfTwoKeysTurnsEvenly) {
  const CameraPath path({key(0, 0), key(100, 90)});
  for (const double t : {0.0, 10.0, 37.5, 99.0}) EXPECT_NEAR(yaw_at(path, t), 0.9 * t, 1e-9);
  // About any axis: equal steps.
  const CameraPath tumbling({key(0, 10, 60, -40), key(10, 150, -20, 80)});
  const double step = angle_between(tumbling.at(0).rotation, tumbling.at(1).rotation);
  for (int t = 1; t < 10; ++t)
    EXPECT_NEAR(angle_between(tumbling.at(t).rotation, tumbling.at(t + 1).rotation), step, 1e-9);
}

/// Total yaw from frame 0 to 100, by small steps.
double turned(const CameraPath& path) {
  double sum = 0;
  for (int i = 0; i < 1000; ++i)
    sum += std::remainder(yaw_at(path, 0.1 * (i + 1)) - yaw_at(path, 0.1 * i), 360);
  return sum;
}

TEST(CameraPath, TurnsTheShortestWayUnlessMoreThanHalfATurnIsWritten) {
  for (const double yaw : {0.0, 90.0, -90.0, 179.0, 180.0, -180.0, 181.0, 200.0, -200.0, 360.0, -360.0, 540.0,
                           720.0, -1000.0, 36000.0})
    EXPECT_NEAR(turned(CameraPath({key(0, 0), key(100, yaw)})), yaw, 1e-6) << yaw;
  EXPECT_NEAR(turned(CameraPath({key(0, 170), key(100, -170)})), -340, 1e-6);
  EXPECT_NEAR(turned(CameraPath({key(0, 170), key(100, 190)})), 20, 1e-6);
  EXPECT_NEAR(turned(CameraPath({key(0, 0), key(50, 360), key(100, 720)})), 720, 1e-6);
  // A whole turn about the axis, level all the time.
  const CameraPath rolling({key(0, 30, 0, 0), key(8, 30, 0, 360)});
  EXPECT_LT(angle_between(rolling.at(2).rotation, rotation_of({30, 0, 90})), 1e-6);
  EXPECT_LT(angle_between(rolling.at(6).rotation, rotation_of({30, 0, 270})), 1e-6);
  // Pitched, a turn is about the world's up all the same.
  const CameraPath pan({key(0, 0, 40), key(8, 360, 40)});
  EXPECT_LT(angle_between(pan.at(2).rotation, rotation_of({90, 40, 0})), 1e-6);
}

/// Velocities on both sides of every key agree: the path has no kinks. Their difference over a step of h is
/// the acceleration times h.
TEST(CameraPath, HasNoJumpsOfVelocityAtKeys) {
  const std::vector<CameraKey> keys{key(0, 0, 0, 0), key(10, 80, 30, 20), key(14, 100, -40, 90),
                                    key(40, 500, 20, 10), key(41, 520, 10, 0)};
  const CameraPath path(keys);
  const double h = 1e-5;
  for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
    const double t = keys[i].frame;
    const Matrix3 before = path.at(t - h).rotation, here = path.at(t).rotation,
                  after = path.at(t + h).rotation;
    // before → here, once more, against after.
    const Matrix3 expected = here * transpose(before) * here;
    const double step = angle_between(before, here);
    EXPECT_LT(angle_between(expected, after), 1e-3 * step + 1e-9) << t;
  }
}

TEST(CameraPath, StandsStillBetweenEqualKeys) {
  const CameraPath path({key(0, 0), key(10, 90, 10), key(20, 90, 10), key(30, 0)});
  for (const double t : {10.0, 12.0, 15.0, 19.9})
    EXPECT_LT(angle_between(path.at(t).rotation, rotation_of({90, 10, 0})), 1e-6) << t;
}

TEST(CameraPath, ZoomsByEqualRatios) {
  const CameraPath path({{0, {}, 90.0}, {10, {}, 22.5}});
  EXPECT_NEAR(*path.at(0).fov, 90, 1e-9);
  EXPECT_NEAR(*path.at(5).fov, 45, 1e-9);
  EXPECT_NEAR(*path.at(10).fov, 22.5, 1e-9);
  // Between two keys it stays between, where neighbours go the same way.
  const CameraPath steps({{0, {}, 90.0}, {10, {}, 30.0}, {11, {}, 29.0}, {20, {}, 10.0}});
  for (double t = 0; t < 20; t += 0.25) EXPECT_LE(*steps.at(t + 0.25).fov, *steps.at(t).fov + 1e-12) << t;
  EXPECT_FALSE(CameraPath({key(0, 0)}).at(0).fov);
}

TEST(CameraPath, IsReadFromATableOrJson) {
  const CameraPath table = parse_camera_path(
      "\xEF\xBB\xBF# a pan\r\nframe, fov,yaw\r\n\r\n1, 60, 0\r\n101,40,-3.5e1\n", "keys.csv");
  ASSERT_EQ(table.keys().size(), 2U);
  EXPECT_EQ(table.keys()[1].frame, 101);
  EXPECT_EQ(table.keys()[1].look.yaw, -35);
  EXPECT_EQ(table.keys()[1].look.roll, 0);
  EXPECT_EQ(*table.keys()[1].fov, 40);
  const CameraPath json =
      parse_camera_path(R"( [{"frame": 1, "fov": 60}, {"frame": 101, "yaw": -35, "fov": 40}])", "keys.json");
  for (const double t : {1.0, 20.0, 77.7}) EXPECT_EQ(table.at(t).rotation, json.at(t).rotation);
}

TEST(CameraPath, RefusesWhatIsNoPathAndSaysWhere) {
  const auto message = [](const char* text) -> std::string {
    try {
      parse_camera_path(text, "keys.csv");
    } catch (const Error& error) {
      return error.what();
    }
    return "read";
  };
  const auto expect = [&](const char* text, const char* part) {
    const std::string found = message(text);
    EXPECT_NE(found.find(part), std::string::npos) << text << ": " << found;
    EXPECT_EQ(found.find("keys.csv: "), 0U) << found;
  };
  expect("", "is empty");
  expect(" \n\n", "is empty");
  expect("frame,yaw\n", "no key frames");
  expect("yaw,pitch\n1,2\n", "no column is called frame");
  expect("frame,yawn\n1,2\n", "did you mean 'yaw'");
  expect("frame,yaw,yaw\n1,2,3\n", "two columns");
  expect("frame,yaw\n1,2\n3\n", "line 3: 1 values");
  expect("frame,yaw\n1,2,3\n", "line 2: 3 values");
  expect("frame,yaw\n1,x\n", "line 2: 'x' is not a number");
  expect("frame,yaw\n1,nan\n", "is not a number");
  expect("frame,yaw\n1,1e300\n", "below 1e9");
  expect("frame,yaw\n5,0\n4,0\n", "key 2: frame 4 comes after frame 5");
  expect("frame,yaw\n5,0\n5,0\n", "frames ascend");
  expect("frame,fov\n5,0\n", "field of view");
  expect("frame,fov\n5,361\n", "field of view");
  expect("frame,fov\n5,-1\n", "field of view");
  expect("[", "no valid JSON");
  expect("[1]", "key 1: is no object");
  expect("[{\"yaw\": 1}]", "has no frame");
  expect("[{\"frame\": \"1\"}]", "frame is not a number");
  expect("[{\"frame\": 1, \"zoom\": 1}]", "unknown column");
  expect("[{\"frame\": 1, \"fov\": 50}, {\"frame\": 2}]", "either all keys");
  EXPECT_THROW(CameraPath({key(0, 0)}).at(NAN), Error);
  EXPECT_THROW(CameraPath({key(NAN, 0)}), Error);
  EXPECT_THROW(read_camera_path("/nowhere/keys.csv"), Error);
  EXPECT_THROW(read_camera_path("/"), Error);
}

}  // namespace
}  // namespace welkin
