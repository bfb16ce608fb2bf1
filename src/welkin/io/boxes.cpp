#include "welkin/io/boxes.h"

#include <bit>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"

namespace welkin::io {

std::optional<Box> Boxes::next() {
  constexpr std::size_t kHeader = 8, kLargeHeader = 16;
  constexpr std::uint64_t kToTheEnd = 0, kLarge = 1;
  if (left_.empty()) return {};
  const auto fail = [&](const char* cause) {
    throw Error(ErrorKind::damaged, source_.name,
                std::string(cause) + " (byte " + std::to_string(left_.data() - source_.bytes.data()) + ")");
  };
  if (left_.size() < kHeader) fail("ends early, within the header of a box");
  std::uint64_t size = load<std::uint32_t>(&left_[0], std::endian::big);
  std::size_t header = kHeader;
  if (size == kLarge) {
    header = kLargeHeader;
    if (left_.size() < header) fail("ends early, within the header of a box");
    size = std::uint64_t{load<std::uint32_t>(&left_[kHeader], std::endian::big)} << 32 |
           load<std::uint32_t>(&left_[kHeader + 4], std::endian::big);
  } else if (size == kToTheEnd) {
    size = left_.size();
  }
  if (size < header) fail("a box is smaller than its header");
  if (size > left_.size()) fail("ends early: a box passes the end");
  const auto whole = left_.first(static_cast<std::size_t>(size));
  left_ = left_.subspan(whole.size());
  return Box{{reinterpret_cast<const char*>(&whole[4]), 4}, whole.subspan(header)};
}

}  // namespace welkin::io
