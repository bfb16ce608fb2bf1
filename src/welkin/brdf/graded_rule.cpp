#include "welkin/brdf/graded_rule.h"

#include <array>
#include <cassert>
#include <mutex>

namespace welkin::brdf {

const QuadratureRule& gauss_rule(int count) {
  constexpr std::size_t kSlots = kMostNodes + 1;
  static std::array<std::once_flag, kSlots> made;
  static std::array<QuadratureRule, kSlots> rules;
  assert(count >= 2 && count <= kMostNodes);
  const auto slot = static_cast<std::size_t>(count);
  std::call_once(made[slot], [&] { rules[slot] = gauss_legendre(count); });
  return rules[slot];
}

}  // namespace welkin::brdf
