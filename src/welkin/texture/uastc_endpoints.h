#pragma once

#include <array>
#include <cstdint>

/// Endpoints of UASTC HDR: rounded to what ASTC's HDR modes 7 and 11 can store. Internal to texture.
namespace welkin::texture::uastc {

/// The largest that both ASTC and BC6H can have, of 12 bits.
inline constexpr int kLargestEnd = 3967;

/// Values of a range: those that it stores, as bytes after unquantization.
struct StoredValues {
  /// The nearest that is stored and keeps the `kept` highest bits, by kept.
  std::array<std::array<std::uint8_t, 256>, 5> nearest;
  std::array<std::uint8_t, 256> code;   ///< of those that are stored
  std::array<std::uint8_t, 256> above;  ///< the next larger one that is stored, itself for the last
  std::array<std::uint8_t, 256> below;  ///< the next smaller one

  static const StoredValues& of(int range);
};

/// A region's endpoints as they are stored, before they become codes of their range, and what they are.
struct StoredEnds {
  std::uint8_t values[6] = {};
  int ends[2][3] = {};

  bool legal() const;  ///< none above kLargestEnd
};

/// Of mode 11: its eight layouts, of which the last store the most bits of the least differences, and 8, all
/// channels as they are.
inline constexpr int kDirectLayouts = 9;
/// Rounds ends of 12 bits. The largest channel of the second must not be below that of the first.
StoredEnds store_direct(const float (*ends)[3], int layout, const StoredValues& range);

/// Layouts that are worth trying: the finest that the endpoints fit into, and of those that are a step finer
/// `finer` ones, into which they fit but for a clamped difference.
struct Layouts {
  int count = 0;
  int layout[5] = {};

  void add(int which) { layout[count++] = which; }
};
Layouts direct_layouts(const float (*ends)[3], int finer);
Layouts scale_layouts(const float* end, float scale, int finer);

/// Of mode 7: the second endpoint, and how far the first is below it in all channels.
inline constexpr int kScaleLayouts = 6;
StoredEnds store_scale(const float* end, float scale, int layout, const StoredValues& range);

}  // namespace welkin::texture::uastc
