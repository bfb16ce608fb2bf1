#include "welkin/brdf/merl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/brdf/file_bytes.h"
#include "welkin/brdf/models.h"
#include "welkin/math/angles.h"

namespace welkin::brdf {
namespace {

constexpr std::size_t kHalf = 90, kDifference = 90, kAround = 180, kCells = kHalf * kDifference * kAround;
constexpr std::size_t kHeader = 12, kBytes = kHeader + 3 * 8 * kCells;
constexpr std::array<double, 3> kScale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
/// ITU-R BT.709.
constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722};

template <class T>
T little_endian(const char* bytes) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

class Merl final : public AnyBrdf::Model {
 public:
  Merl(std::string origin, std::vector<float> values, std::size_t unmeasured)
      : origin_(std::move(origin)), values_(std::move(values)), unmeasured_(unmeasured) {}

  std::string name() const override { return "merl"; }
  std::string description() const override { return "measured: a file of the MERL database"; }
  std::string source() const override { return "Matusik et al. 2003"; }
  std::string origin() const override { return origin_; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> list{"one lobe for all colours: of the luminance (BT.709)"};
    if (unmeasured_ > 0)
      list.push_back(std::to_string(unmeasured_) + " of " + std::to_string(3 * kCells) +
                     " values are negative, which marks what was not measured: 0");
    return list;
  }

  double value(const Vec3d& view, const Vec3d& light) const override {
    const Vec3d h = half_vector(view, light);
    // The light about the half vector: its angle to it, and φd from the plane of normal and half vector.
    const double sine = std::hypot(h.x, h.y), theta_h = std::atan2(sine, h.z);
    const double cosine = std::clamp(dot(light, h), -1.0, 1.0);
    const Vec3d along = sine > 0 ? Vec3d{h.x * h.z / sine, h.y * h.z / sine, -sine} : Vec3d{1, 0, 0};
    const Vec3d across = cross(h, along);
    const double x = dot(light, along), y = dot(light, across),
                 theta_d = std::atan2(std::hypot(x, y), cosine);
    double phi_d = std::atan2(y, x);
    if (phi_d < 0) phi_d += kPi;  // f is the same when light and viewer change places
    return interpolated(std::sqrt(std::min(1.0, theta_h / (kPi / 2))) * kHalf,
                        theta_d / (kPi / 2) * kDifference, phi_d / kPi * kAround);
  }
  double width() const override { return 0.5 * kDegree; }

 private:
  /// Positions in cells, whose middles are at i + ½.
  double interpolated(double half, double difference, double around) const {
    const auto split = [](double position, std::size_t count, bool goes_round) {
      const double at = position - 0.5, below = std::floor(at), part = at - below;
      const auto index = [&](double i) {
        const auto n = static_cast<double>(count);
        return static_cast<std::size_t>(goes_round ? i - n * std::floor(i / n) : std::clamp(i, 0.0, n - 1));
      };
      return std::array{std::pair{index(below), 1 - part}, std::pair{index(below + 1), part}};
    };
    double sum = 0;
    for (const auto& [i, wi] : split(half, kHalf, false)) {
      for (const auto& [j, wj] : split(difference, kDifference, false)) {
        for (const auto& [k, wk] : split(around, kAround, true))
          sum += wi * wj * wk * static_cast<double>(values_[(i * kDifference + j) * kAround + k]);
      }
    }
    return sum;
  }

  std::string origin_;
  std::vector<float> values_;
  std::size_t unmeasured_;
};

}  // namespace

std::shared_ptr<const AnyBrdf::Model> read_merl(const std::string& path, const std::string& origin) {
  const std::string bytes = file_bytes(path, kBytes + (1 << 20), "more than a file of the MERL database has");
  const auto fail = [&](ErrorKind kind, const std::string& what) { throw Error(kind, path, what); };
  if (bytes.size() < kHeader)
    fail(ErrorKind::damaged, "ends in its header (byte " + std::to_string(bytes.size()) + " of 12)");
  constexpr std::array<std::size_t, 3> kSizes{kHalf, kDifference, kAround};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto size = little_endian<std::int32_t>(&bytes[4 * k]);
    if (size != static_cast<std::int32_t>(kSizes[k]))
      fail(ErrorKind::unsupported, "is not of the MERL database: its size " + std::to_string(k + 1) + " is " +
                                       std::to_string(size) + ", not " + std::to_string(kSizes[k]));
  }
  if (bytes.size() != kBytes)
    fail(ErrorKind::damaged, (bytes.size() < kBytes ? "ends early: " : "has more than its values: ") +
                                 std::to_string(bytes.size()) + " bytes, not " + std::to_string(kBytes));
  std::vector<float> values(kCells);
  std::size_t unmeasured = 0;
  double largest = 0;
  for (std::size_t i = 0; i < kCells; ++i) {
    double luminance = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = kHeader + 8 * (c * kCells + i);
      const double value = little_endian<double>(&bytes[at]);
      if (!(std::fabs(value) < 1e30))
        fail(ErrorKind::bad_value, "the value at byte " + std::to_string(at) + " is not finite");
      unmeasured += value < 0 ? 1 : 0;
      luminance += kLuminance[c] * kScale[c] * std::max(0.0, value);
    }
    values[i] = static_cast<float>(luminance);
    largest = std::max(largest, luminance);
  }
  if (largest == 0) fail(ErrorKind::bad_value, "all values are 0");
  return std::make_shared<Merl>(origin, std::move(values), unmeasured);
}

}  // namespace welkin::brdf
