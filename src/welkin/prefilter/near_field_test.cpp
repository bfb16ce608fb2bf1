#include "welkin/prefilter/near_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "welkin/math/scalar.h"
#include "welkin/prefilter/widen.h"

namespace welkin::prefilter {
namespace {

constexpr int kRows = 1280, kDegree = 300;

/// K of a northern row, as the kernel reads it.
double at(const NearField& field, int row, int offset, int order) {
  const NearField::Pack& pack = field.packs[static_cast<std::size_t>(row / 8)];
  const double t = static_cast<double>(order % pack.stride) / pack.stride;
  const double blend[4] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
                           -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int column = (order / pack.stride + i) * (2 * field.reach + 1) + field.reach + offset;
    const std::ptrdiff_t index = pack.begin + column * 8 + row % 8;
    sum += blend[i] * static_cast<double>(field.table[static_cast<std::size_t>(index)]);
  }
  return sum;
}

/// 2π Σ K f sin θ′ Δθ over the rows around `row`.
template <class Function>
double sum_of(const NearField& field, int row, int order, const Function& f) {
  double sum = 0;
  for (int offset = -field.reach; offset <= field.reach; ++offset) {
    const double angle = (row + offset + 0.5) * kPi / kRows;
    if (angle <= 0) continue;
    sum += at(field, row, offset, order) * f(angle) * std::sin(angle);
  }
  return 2 * kPi * sum * kPi / kRows;
}

std::vector<WidenedLobe> lobes() {
  std::vector<WidenedLobe> list;
  for (const char* roughness : {"0.0625", "0.015625"}) {
    list.push_back(
        widen(lobe::AnyLobe::make(std::string("ggx,roughness=") + roughness), 2.3 * kPi / kRows, 2e-4));
  }
  return list;
}

/// sinᵐ θ e^(imφ) is a harmonic of degree m: convolving multiplies it by λ_m, of which the near part has what
/// the far part leaves. Splitting may be off by five times the tolerance, 1e-3; rows that bend by as much.
TEST(NearField, HasWhatTheFarPartLeaves) {
  for (const WidenedLobe& lobe : lobes()) {
    const NearField field(lobe.lobe, lobe.zonal, kRows, kDegree, 2e-4);
    ASSERT_EQ(field.packs.size() * 16, static_cast<std::size_t>(kRows));
    ASSERT_EQ(field.far.size(), static_cast<std::size_t>(kDegree) + 1);
    for (const int row : {4, 5, 9, 20, 37, 64, 90, 130, 200, 280, 400, 560, 639}) {
      const int last = field.packs[static_cast<std::size_t>(row / 8)].last;
      for (const int m : {0, 1, 3, 12, 29, 64, 150, 301, 390, 500, 777}) {
        if (m > last) continue;
        const std::size_t degree = static_cast<std::size_t>(m);
        const double expected = lobe.zonal[degree] - (m <= kDegree ? field.far[degree] : 0.0);
        const double found =
            sum_of(field, row, m, [m](double angle) { return std::pow(std::sin(angle), m); });
        EXPECT_NEAR(found, expected * std::pow(std::sin((row + 0.5) * kPi / kRows), m), 1.5e-3)
            << lobe.lobe.spec() << " row " << row << " order " << m;
      }
    }
  }
}

/// Waves across the rows, at the equator: as strong as λ_l has them and sharpened by what spreading and
/// splines take, 3 to 13 per cent here.
TEST(NearField, SharpensAcrossRows) {
  for (const WidenedLobe& lobe : lobes()) {
    const NearField field(lobe.lobe, lobe.zonal, kRows, kDegree, 2e-4);
    for (const double part : {0.48, 0.5, 0.55, 0.6}) {
      const double degree = part * kRows, middle = (kRows / 2 - 0.5) * kPi / kRows;
      const double found =
          sum_of(field, kRows / 2 - 1, 0, [&](double angle) { return std::cos(degree * (angle - middle)); });
      const double gain = 1 + std::pow(2 * std::sin(kPi * part / 2), 6) / 150;
      EXPECT_NEAR(found, gain * lobe.zonal[static_cast<std::size_t>(degree)], 2e-3)
          << lobe.lobe.spec() << ' ' << part;
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
