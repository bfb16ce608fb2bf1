#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace welkin {

/// Bad data or a bad request. The message names the file or the option, then the cause:
/// `sky.hdr: scan line 12 ends early (byte 40960)`. Our own bugs are asserts instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was cancelled (Ctrl-C, or a caller's request).
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

/// `unknown KIND 'NAME'; did you mean 'NEAREST'? (one of: a, b, c)`: the message for a name that no table
/// has. The nearest is by edit distance, and is left out when nothing is near.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> known);

}  // namespace welkin
