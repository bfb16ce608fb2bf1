#include "welkin/io/jxl/gain_map_box.h"

#include <cstdint>

#include "welkin/base/error.h"

namespace welkin::io {
namespace {

class Fields {
 public:
  explicit Fields(std::span<const std::byte> left) : left_(left) {}

  std::span<const std::byte> take(std::uint64_t size) {
    if (size > left_.size()) throw Error(ErrorKind::damaged, "its gain map's box ends early");
    const auto taken = left_.first(static_cast<std::size_t>(size));
    left_ = left_.subspan(taken.size());
    return taken;
  }
  std::uint64_t number(std::uint64_t bytes) {
    std::uint64_t value = 0;
    for (const std::byte byte : take(bytes)) value = value << 8 | std::to_integer<std::uint64_t>(byte);
    return value;
  }
  std::span<const std::byte> rest() const { return left_; }

 private:
  std::span<const std::byte> left_;
};

}  // namespace

JxlGainMapBox parse_jxl_gain_map_box(std::span<const std::byte> content) {
  Fields fields(content);
  if (fields.number(1) != 0) throw Error(ErrorKind::unsupported, "its gain map's box is of a later version");
  JxlGainMapBox box;
  box.metadata = fields.take(fields.number(2));
  fields.take(fields.number(1));
  fields.take(fields.number(4));
  box.codestream = fields.rest();
  // A file of boxes could hold a further gain map, and so on.
  const bool naked = box.codestream.size() >= 2 && box.codestream[0] == std::byte{0xff} &&
                     box.codestream[1] == std::byte{0x0a};
  if (!naked) throw Error(ErrorKind::damaged, "its gain map's box holds no picture");
  return box;
}

}  // namespace welkin::io
