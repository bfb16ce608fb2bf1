#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

/// Eight values side by side, in as many packs as the instruction set needs: the layout of data does not
/// depend on it. Included by the *_impl.h files alone, so the instruction set is always in the template's
/// arguments.
namespace welkin::prefilter {

template <class T, class Arch>
struct Lanes {
  using Pack = xsimd::batch<T, Arch>;
  static constexpr std::size_t kPack = Pack::size;
  static constexpr std::size_t kPacks = 8 / kPack;
  static_assert(kPacks * kPack == 8);

  Pack part[kPacks];

  Lanes() = default;
  explicit Lanes(T value) {
    for (Pack& p : part) p = Pack(value);
  }

  static Lanes load(const T* from) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = Pack::load_unaligned(from + i * kPack);
    return out;
  }
  void store(T* to) const {
    for (std::size_t i = 0; i < kPacks; ++i) part[i].store_unaligned(to + i * kPack);
  }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = a.part[i] + b.part[i];
    return out;
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = a.part[i] - b.part[i];
    return out;
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = a.part[i] * b.part[i];
    return out;
  }
  /// a·b + c
  static Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::fma(a.part[i], b.part[i], c.part[i]);
    return out;
  }
  /// a·b − c
  static Lanes fms(const Lanes& a, const Lanes& b, const Lanes& c) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::fms(a.part[i], b.part[i], c.part[i]);
    return out;
  }
  /// c − a·b
  static Lanes fnma(const Lanes& a, const Lanes& b, const Lanes& c) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::fnma(a.part[i], b.part[i], c.part[i]);
    return out;
  }
  static Lanes max(const Lanes& a, const Lanes& b) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::max(a.part[i], b.part[i]);
    return out;
  }
  static Lanes abs(const Lanes& a) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::abs(a.part[i]);
    return out;
  }
  static Lanes exp(const Lanes& a) {
    Lanes out;
    for (std::size_t i = 0; i < kPacks; ++i) out.part[i] = xsimd::exp(a.part[i]);
    return out;
  }
  T sum() const {
    Pack total = part[0];
    for (std::size_t i = 1; i < kPacks; ++i) total = total + part[i];
    return xsimd::hadd(total);
  }
  T largest() const {
    alignas(64) T values[8];
    store(values);
    T found = values[0];
    for (T value : values) found = value > found ? value : found;
    return found;
  }
};

}  // namespace welkin::prefilter
