#include "welkin/camera/camera_path.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/math/scalar.h"

namespace welkin {
namespace {

constexpr double kTurn = 2 * kPi;

/// Whole turns that a change of angle, degrees, has beyond half a turn either way.
double whole_turns(double change) {
  return change > 0 ? std::ceil((change - 180) / 360) : std::floor((change + 180) / 360);
}

/// Weights of the cumulative Hermite curve at s of [0, 1]: of a third of the velocity at its start, of what
/// is left in its middle, of a third of the velocity at its end.
struct Weights {
  double start, middle, end;
};
Weights weights_at(double s) {
  const double r = 1 - s;
  return {1 - r * r * r, s * s * (3 - 2 * s), s * s * s};
}

/// A number's cubic Hermite curve over a stretch of `length` frames.
double curve(const Weights& w, double from, double change, double start_speed, double end_speed,
             double length) {
  const double start = start_speed * length / 3, end = end_speed * length / 3;
  return from + w.start * start + w.middle * (change - start - end) + w.end * end;
}

/// Of the stretches before and after a key, the factors of their velocities: their mean at the key, weighted
/// by nearness and limited.
struct Mean {
  double before, after;
};
Mean mean_of(double length_before, double length_after, double speed_before, double speed_after,
             double speed) {
  const double all = length_before + length_after, most = 3 * std::min(speed_before, speed_after);
  const double limit = speed > most ? most / speed : 1;
  return {limit * length_after / all, limit * length_before / all};
}

[[noreturn]] void refuse(std::size_t key, const std::string& cause) {
  throw Error(ErrorKind::bad_request, "key " + std::to_string(key + 1) + ": " + cause);
}

void check(const std::vector<CameraKey>& keys) {
  require(!keys.empty(), "there are no key frames");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const CameraKey& key = keys[i];
    for (const double value : {key.frame, key.look.yaw, key.look.pitch, key.look.roll}) {
      // 1e9 turns: an angle of a double beyond that says nothing.
      if (!(std::fabs(value) < 1e9)) refuse(i, "the frame and the angles are numbers below 1e9");
    }
    if (key.fov && !(*key.fov > 0 && *key.fov <= 360))
      refuse(i, "a field of view of " + number_text(*key.fov) + "°, which is over 0 and at most 360");
    if (key.fov.has_value() != keys[0].fov.has_value())
      refuse(i, "either all keys have a field of view or none");
    if (i > 0 && !(key.frame > keys[i - 1].frame))
      refuse(i, "frame " + number_text(key.frame) + " comes after frame " + number_text(keys[i - 1].frame) +
                    "; frames ascend");
  }
}

}  // namespace

CameraPath::Quaternion CameraPath::product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The rotation about `v` by its length, radians.
CameraPath::Quaternion CameraPath::exponential(const Vec& v) {
  const double half = 0.5 * std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  const double scale = half > 1e-9 ? 0.5 * std::sin(half) / half : 0.5;
  return {std::cos(half), scale * v.x, scale * v.y, scale * v.z};
}

/// The shortest v with a·exp(v) = ±b. Of the two of half a turn the one on the hint's side.
CameraPath::Vec CameraPath::between(const Quaternion& a, const Quaternion& b, const Vec& hint) {
  Quaternion q = product({a.w, -a.x, -a.y, -a.z}, b);
  const double side = q.x * hint.x + q.y * hint.y + q.z * hint.z;
  if (std::fabs(q.w) < 1e-9 ? side < 0 : q.w < 0) q = {-q.w, -q.x, -q.y, -q.z};
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double scale = sine > 1e-12 ? 2 * std::atan2(sine, std::max(q.w, 0.0)) / sine : 2;
  return {scale * q.x, scale * q.y, scale * q.z};
}

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) {
  check(keys_);
  zooms_ = keys_[0].fov.has_value();
  const CameraKey* last = nullptr;
  for (const CameraKey& key : keys_) {
    Knot knot;
    knot.frame = key.frame;
    const auto about = [](Vec axis, double degrees) {
      // Whole turns are left out here.
      const double angle = std::remainder(degrees, 360) * (kPi / 180);
      return exponential({axis.x * angle, axis.y * angle, axis.z * angle});
    };
    // As rotation_of.
    knot.rotation = product(product(about({0, 1, 0}, -key.look.yaw), about({1, 0, 0}, -key.look.pitch)),
                            about({0, 0, 1}, key.look.roll));
    if (zooms_) knot.zoom = std::log(*key.fov);
    if (last != nullptr) {
      knot.up_turns = knots_.back().up_turns - whole_turns(key.look.yaw - last->look.yaw);
      knot.axis_turns = knots_.back().axis_turns + whole_turns(key.look.roll - last->look.roll);
      Knot& before = knots_.back();
      before.way = between(before.rotation, knot.rotation,
                           {last->look.pitch - key.look.pitch, last->look.yaw - key.look.yaw,
                            key.look.roll - last->look.roll});
    }
    knots_.push_back(knot);
    last = &key;
  }
  find_speeds();
}

void CameraPath::find_speeds() {
  /// Velocities on a stretch between two keys.
  struct Stretch {
    double length;
    Vec turning;
    double up, axis, zoom;
    /// How fast it turns in all, as far as that can be said by one number.
    double speed() const {
      return std::sqrt(turning.x * turning.x + turning.y * turning.y + turning.z * turning.z) +
             kTurn * (std::fabs(up) + std::fabs(axis));
    }
  };
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const Knot &a = knots_[i], &b = knots_[i + 1];
    const double length = b.frame - a.frame;
    stretches.push_back({length,
                         {a.way.x / length, a.way.y / length, a.way.z / length},
                         (b.up_turns - a.up_turns) / length,
                         (b.axis_turns - a.axis_turns) / length,
                         (b.zoom - a.zoom) / length});
  }
  if (stretches.empty()) return;
  const auto set = [](Knot& knot, const Stretch& a, double x, const Stretch& b, double y) {
    knot.turning = {x * a.turning.x + y * b.turning.x, x * a.turning.y + y * b.turning.y,
                    x * a.turning.z + y * b.turning.z};
    knot.up_speed = x * a.up + y * b.up;
    knot.axis_speed = x * a.axis + y * b.axis;
  };
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    const Stretch &a = stretches[i - 1], &b = stretches[i];
    const double all = a.length + b.length, x = b.length / all, y = a.length / all;
    const Mean turning = mean_of(a.length, b.length, a.speed(), b.speed(), x * a.speed() + y * b.speed());
    set(knots_[i], a, turning.before, b, turning.after);
    const Mean zoom = mean_of(a.length, b.length, std::fabs(a.zoom), std::fabs(b.zoom),
                              x * std::fabs(a.zoom) + y * std::fabs(b.zoom));
    knots_[i].zoom_speed = zoom.before * a.zoom + zoom.after * b.zoom;
  }
  // At the ends no acceleration: (3 × the stretch − the other end's)/2.
  const auto end = [](Knot& knot, const Stretch& s, const Knot& other) {
    const auto free = [](double mean, double there) { return 1.5 * mean - 0.5 * there; };
    knot.turning = {free(s.turning.x, other.turning.x), free(s.turning.y, other.turning.y),
                    free(s.turning.z, other.turning.z)};
    knot.up_speed = free(s.up, other.up_speed);
    knot.axis_speed = free(s.axis, other.axis_speed);
    knot.zoom_speed = free(s.zoom, other.zoom_speed);
  };
  if (stretches.size() == 1) {
    for (Knot& knot : knots_) {
      set(knot, stretches[0], 1, stretches[0], 0);
      knot.zoom_speed = stretches[0].zoom;
    }
    return;
  }
  end(knots_.front(), stretches.front(), knots_[1]);
  end(knots_.back(), stretches.back(), knots_[knots_.size() - 2]);
}

CameraPath::Pose CameraPath::at(double frame) const {
  require(!std::isnan(frame), "a frame's number is a number");
  const double within = std::clamp(frame, knots_.front().frame, knots_.back().frame);
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), within,
                                      [](double value, const Knot& knot) { return value < knot.frame; });
  const std::size_t i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const Knot& a = knots_[i];
  const Knot& b = knots_[std::min(i + 1, knots_.size() - 1)];
  const double length = b.frame - a.frame;
  const Weights w = weights_at(length > 0 ? (within - a.frame) / length : 0);
  // q(s) = a exp(w₁ ω₁) exp(w₂ ω₂) exp(w₃ ω₃), with ω₁ and ω₃ thirds of the velocities at the ends, ω₂ what
  // leads from one to the other.
  const auto third = [length](const Vec& v) {
    return Vec{v.x * length / 3, v.y * length / 3, v.z * length / 3};
  };
  const auto times = [](double scale, const Vec& v) { return Vec{scale * v.x, scale * v.y, scale * v.z}; };
  const Vec start = third(a.turning), end = third(b.turning);
  const Vec middle = between(product(a.rotation, exponential(start)),
                             product(b.rotation, exponential(times(-1, end))), a.way);
  Quaternion q = product(
      product(product(a.rotation, exponential(times(w.start, start))), exponential(times(w.middle, middle))),
      exponential(times(w.end, end)));
  const double up = curve(w, a.up_turns, b.up_turns - a.up_turns, a.up_speed, b.up_speed, length);
  const double axis = curve(w, a.axis_turns, b.axis_turns - a.axis_turns, a.axis_speed, b.axis_speed, length);
  q = product(product(exponential({0, kTurn * std::remainder(up, 1), 0}), q),
              exponential({0, 0, kTurn * std::remainder(axis, 1)}));
  Pose pose{rotation_from_quaternion(q.w, q.x, q.y, q.z), {}};
  if (zooms_) pose.fov = std::exp(curve(w, a.zoom, b.zoom - a.zoom, a.zoom_speed, b.zoom_speed, length));
  return pose;
}

}  // namespace welkin
