#include "welkin/prefilter/fft.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "welkin/base/cpu.h"
#include "welkin/prefilter/buffer.h"
#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {
namespace {

using Complex = std::complex<double>;

/// The tables that this machine can run.
std::vector<const Kernels*> all_tables() {
  std::vector<const Kernels*> list{&kernels_baseline()};
#ifdef WELKIN_HAS_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(&kernels_avx2());
#endif
  return list;
}

const int kLengths[] = {4,   5,   6,   8,   9,   10,  12,  15,  16,  18,  20,  24,  25,  27,  30,   32,  36,
                        45,  48,  60,  64,  72,  75,  80,  81,  96,  100, 108, 120, 125, 128, 144,  150, 160,
                        180, 240, 243, 250, 256, 300, 360, 384, 400, 500, 512, 625, 640, 720, 1000, 1024};

/// Sixteen real rows of random numbers in −1…1, [column][row].
Buffer random_rows(int length, unsigned seed) {
  Buffer rows(static_cast<std::size_t>(length) * 16);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) rows.data()[i] = value(random);
  return rows;
}

/// Σ row[x] e^(−2πi m x/n) in float64, of one row.
Complex order_of(const float* rows, int length, int row, int m) {
  Complex sum = 0;
  for (int x = 0; x < length; ++x) {
    const double angle = -2 * std::numbers::pi * (m * x % length) / length;
    sum += static_cast<double>(rows[x * 16 + row]) * Complex(std::cos(angle), std::sin(angle));
  }
  return sum;
}

/// Rounding grows with the number of passes (N. Higham, "Accuracy and stability of numerical algorithms",
/// 2002, §24.1): 6e-8 · (1 + log2 n) · √Σ|x|² of the pair of rows, of which each transform is a part.
double bound(int length) {
  return 6e-8 * (1 + std::log2(length)) * std::sqrt(2.0 * length);
}

TEST(Fft, TakesProductsOfTwoThreeAndFive) {
  for (const int length : kLengths) EXPECT_TRUE(fft_takes(length)) << length;
  for (const int length : {-4, 0, 7, 11, 14, 22, 49, 1001}) EXPECT_FALSE(fft_takes(length)) << length;
  for (int minimum = 1; minimum < 3000; ++minimum) {
    const int length = fft_length(minimum);
    EXPECT_TRUE(length >= minimum && length % 4 == 0 && fft_takes(length)) << minimum;
    for (int smaller = (minimum + 3) / 4 * 4; smaller < length; smaller += 4)
      EXPECT_FALSE(fft_takes(smaller));
  }
}

/// The orders of a row and of its mirror image, as the sum and the difference of their transforms.
TEST(Fft, OrdersAreTheFourierSums) {
  constexpr int kParts = 4, kPacks = 3, kChannel = 1;
  for (const Kernels* table : all_tables()) {
    for (const int length : kLengths) {
      const FftPlan plan(length);
      const Buffer rows = random_rows(length, 1);
      Buffer data = random_rows(length, 1), work(data.size());
      // Beyond half the length the orders repeat, and factors apply unchanged.
      const int degree = length + 3;
      std::vector<float> factors;
      for (int m = 0; m <= degree; ++m) factors.push_back(m % 3 == 1 ? 0.5f : 1.0f);
      constexpr int kStep = kPacks * 2 * kParts * 8;
      std::vector<float> orders(static_cast<std::size_t>(kStep * (degree + 1)), 7.0f);
      table->rows_to_orders(plan, data.data(), work.data(), factors.data(), degree, kPacks, kParts,
                            orders.data() + 2 * kChannel * 8);
      for (int m = 0; m <= degree; m += degree > 200 ? 13 : 1) {
        for (int lane = 0; lane < 8; lane += 3) {
          const double factor = static_cast<double>(factors[static_cast<std::size_t>(m)]);
          const Complex north = factor * order_of(rows.data(), length, lane, m);
          const Complex south = factor * order_of(rows.data(), length, lane + 8, m);
          const auto at = [&](int parity, int part) {
            const int index = m * kStep + parity * kParts * 8 + (2 * kChannel + part) * 8 + lane;
            return static_cast<double>(orders[static_cast<std::size_t>(index)]);
          };
          EXPECT_LT(std::abs(Complex(at(0, 0), at(0, 1)) - (north + south)), 2 * bound(length))
              << length << ' ' << m;
          EXPECT_LT(std::abs(Complex(at(1, 0), at(1, 1)) - (north - south)), 2 * bound(length))
              << length << ' ' << m;
        }
      }
      // Nothing is written beside: the other channel and the other packs.
      EXPECT_EQ(orders[0], 7.0f);
      EXPECT_EQ(orders[static_cast<std::size_t>(2 * kParts * 8)], 7.0f);
    }
  }
}

/// row[x] = A_0 + 2 Re Σ A_m e^(2πi m x/n), with north = even + odd and south = even − odd.
TEST(Fft, RowsAreTheFourierSeries) {
  for (const Kernels* table : all_tables()) {
    for (const int length : kLengths) {
      const FftPlan plan(length);
      for (const int degree : {0, 1, (length - 1) / 2}) {
        std::mt19937 random(2);
        std::uniform_real_distribution<float> value(-1, 1);
        std::vector<float> orders(static_cast<std::size_t>(degree + 1) * 32);
        for (float& each : orders) each = value(random);
        // A real row's order 0 is real.
        for (int parity = 0; parity < 2; ++parity) {
          for (int lane = 0; lane < 8; ++lane) orders[static_cast<std::size_t>(parity * 16 + 8 + lane)] = 0;
        }
        Buffer lanes(static_cast<std::size_t>(length) * 16), work(lanes.size());
        const float* rows =
            table->orders_to_rows(plan, orders.data(), degree, 1, 2, lanes.data(), work.data());
        const double norm = std::sqrt(8.0 * (degree + 1));
        for (const int lane : {0, 5, 8, 13}) {
          for (int x = 0; x<length; x += length> 200 ? 7 : 1) {
            double sum = 0;
            for (int m = 0; m <= degree; ++m) {
              const auto at = [&](int parity, int part) {
                return static_cast<double>(
                    orders[static_cast<std::size_t>(m * 32 + parity * 16 + part * 8 + lane % 8)]);
              };
              const double side = lane < 8 ? 1 : -1;
              const Complex a(at(0, 0) + side * at(1, 0), at(0, 1) + side * at(1, 1));
              const double angle = 2 * std::numbers::pi * (m * x % length) / length;
              sum += (m == 0 ? 1 : 2) * (a * Complex(std::cos(angle), std::sin(angle))).real();
            }
            EXPECT_NEAR(static_cast<double>(rows[x * 16 + lane]), sum,
                        1.2e-7 * (1 + std::log2(length)) * norm)
                << length << ' ' << degree << ' ' << x;
          }
        }
      }
    }
  }
}

/// Forward and inverse with all orders give `length` times the rows, twice: once by each of the halves.
TEST(Fft, BackIsTheInverse) {
  for (const Kernels* table : all_tables()) {
    for (const int length : kLengths) {
      if (length % 2 == 0) continue;  // an even one's highest order is its own mirror image
      const FftPlan plan(length);
      const int degree = (length - 1) / 2;
      const Buffer rows = random_rows(length, 3);
      Buffer data = random_rows(length, 3), work(data.size());
      const std::vector<float> factors(static_cast<std::size_t>(degree + 1),
                                       0.5f / static_cast<float>(length));
      std::vector<float> orders(static_cast<std::size_t>(degree + 1) * 32);
      table->rows_to_orders(plan, data.data(), work.data(), factors.data(), degree, 1, 2, orders.data());
      const float* back = table->orders_to_rows(plan, orders.data(), degree, 1, 2, data.data(), work.data());
      for (int i = 0; i < length * 16; ++i) {
        EXPECT_NEAR(static_cast<double>(back[i]), static_cast<double>(rows.data()[i]),
                    3e-7 * (1 + std::log2(length)))
            << length << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
