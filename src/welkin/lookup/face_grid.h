#pragma once

#include <cassert>
#include <cstddef>

#include "welkin/base/large_memory.h"

namespace welkin {

/// Values on an equi-angular cube whose faces go on past their edges by `margin` texels, for sums with the
/// same weights on all faces: two faces lie side by side in the memory, with four values each.
/// [3 pairs of faces][side rows][side columns][2 faces][4 values].
class FaceGrid {
 public:
  static constexpr std::size_t kValues = 4, kPair = 2 * kValues;

  FaceGrid() = default;
  FaceGrid(int size, int margin, LargeMemory::Contents contents)
      : size_(size), margin_(margin), memory_(3 * pair_values() * sizeof(float), contents) {}

  /// The same memory for faces that are no larger; its values are anything.
  void resize(int size, int margin) {
    assert(size + 2 * margin <= side());
    size_ = size;
    margin_ = margin;
  }

  int size() const { return size_; }  ///< texels of a face's side
  int margin() const { return margin_; }
  int side() const { return size_ + 2 * margin_; }
  std::size_t pair_values() const {
    return static_cast<std::size_t>(side()) * static_cast<std::size_t>(side()) * kPair;
  }
  float* pair(int index) { return values() + static_cast<std::size_t>(index) * pair_values(); }
  const float* pair(int index) const { return values() + static_cast<std::size_t>(index) * pair_values(); }
  /// The four values of a texel; x and y count from the margin's first.
  float* at(int face, int x, int y) { return pair(face / 2) + offset(face, x, y); }
  const float* at(int face, int x, int y) const { return pair(face / 2) + offset(face, x, y); }

 private:
  float* values() { return reinterpret_cast<float*>(memory_.data()); }
  const float* values() const { return reinterpret_cast<const float*>(memory_.data()); }
  std::size_t offset(int face, int x, int y) const {
    const std::size_t texel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(side()) + static_cast<std::size_t>(x);
    return texel * kPair + static_cast<std::size_t>(face % 2) * kValues;
  }

  int size_ = 0, margin_ = 0;
  LargeMemory memory_;
};

}  // namespace welkin
