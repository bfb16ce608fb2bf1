#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// A user's lobe: values at ascending angles from 0, linear in the angle between them, 0 beyond the last.
/// Stored in radians and scaled to a largest value of 1.
struct Table {
  static constexpr const char* kName = "table";
  static constexpr const char* kDescription = "your own: a file of angles in degrees and weights";
  static constexpr const char* kSource = "the table";

  std::string origin;  ///< what follows `table,` in the spec
  std::vector<double> angles{0, kPi / 2}, values{1, 0};

  bool mirror() const { return false; }

  /// The outermost angle where half of the largest value is reached.
  double width() const {
    for (std::size_t i = values.size(); i-- > 0;) {
      if (values[i] < 0.5) continue;
      if (i + 1 == values.size()) return angles[i];
      const double part = (values[i] - 0.5) / (values[i] - values[i + 1]);
      return angles[i] + part * (angles[i + 1] - angles[i]);
    }
    return angles.back();
  }

  std::vector<double> breakpoints() const {
    std::vector<double> list;
    for (const double angle : angles) {
      if (angle > 0 && angle < kPi) list.push_back(s_of_angle(angle));
    }
    return list;
  }

  /// 2π ∫ w sin θ dθ, in closed form. Between two angles m ± h with values a ∓ d it is 4π (a sin m sin h + d
  /// cos m (sin h − h cos h)/h).
  double integral() const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      const double h = (angles[i + 1] - angles[i]) / 2, middle = (angles[i + 1] + angles[i]) / 2;
      const double mean = (values[i] + values[i + 1]) / 2, rise = (values[i + 1] - values[i]) / 2;
      const double square = h * h;  // of a narrow part the series keeps the precision
      const double skew = h < 0.05 ? square * (1.0 / 3 - square * (1.0 / 30 - square / 840))
                                   : (std::sin(h) - h * std::cos(h)) / h;
      sum += mean * std::sin(middle) * std::sin(h) + rise * std::cos(middle) * skew;
    }
    return 4 * kPi * sum;
  }

  template <class T>
  T weight(const T& s) const {
    const T zero = constant<T>(0), two = constant<T>(2);
    const T angle = two * atan2(sqrt(max(s, zero)), sqrt(max(two - s, zero)));
    if constexpr (Scalar<T>) {
      return static_cast<T>(at_angle<T>(angle));
    } else {
      // Look-ups don't vectorise: lane by lane.
      typename T::value_type lanes[T::size];
      angle.store_unaligned(lanes);
      for (auto& lane : lanes) lane = static_cast<typename T::value_type>(at_angle<T>(lane));
      return T::load_unaligned(lanes);
    }
  }

 private:
  /// `T` makes one copy for each instruction set: see kernels_impl.h.
  template <class T>
  double at_angle(double angle) const {
    if (angle > kPi) angle = kPi;  // π of floats is above π
    const double* at = angles.data();
    const std::size_t count = angles.size();
    if (!(angle >= 0 && angle <= at[count - 1])) return 0;
    std::size_t low = 0, high = count - 1;  // at[low] <= angle <= at[high]
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (angle < at[middle] ? high : low) = middle;
    }
    const double part = (angle - at[low]) / (at[high] - at[low]);
    return values.data()[low] + part * (values.data()[high] - values.data()[low]);
  }
};

}  // namespace welkin::lobe
