#pragma once

#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "welkin/base/export.h"

/// @file
/// What is thrown: Error, its kinds, Cancelled.
namespace welkin {

/// What kind of thing went wrong: what a program can act on. The message is for people.
enum class ErrorKind {
  not_found,    ///< there is no such file or folder
  denied,       ///< the system doesn't let this user read or write there
  system,       ///< the system failed: a full disk, a broken device, a name too long
  damaged,      ///< a file whose bytes contradict its format, or end early
  unsupported,  ///< a valid file, or a sensible request, of a kind that isn't read, written or computed
  mismatch,     ///< things that don't fit together: a picture's size and a shape, a plan and a map, two spans
  too_large,    ///< more than a limit, or than memory can be expected to hold
  bad_value,    ///< radiance that can't be worked with: NaN, infinite, beyond a stated bound
  bad_request,  ///< an unknown name, a number out of range, a call whose precondition doesn't hold
};

/// `not found`, `damaged`…: the kind in words, for messages.
WELKIN_API std::string_view name_of(ErrorKind kind);

/// Bad data or a bad request. The message names the file where there is one, the cause, and what helps:
/// `sky.hdr: scan line 12 ends early (byte 40960)`. Memory that can't be had is std::bad_alloc; a bug of the
/// library is an assert.
class WELKIN_API Error : public std::runtime_error {
 public:
  /// About no file: the message is the cause.
  Error(ErrorKind kind, const std::string& cause);
  /// The message is `FILE: CAUSE`.
  Error(ErrorKind kind, const std::string& file, const std::string& cause);
  ~Error() override;

  /// What a program acts on.
  ErrorKind kind() const { return kind_; }
  /// The file that it is about, as it was named; empty where it is about none.
  const std::string& file() const { return file_; }
  /// The message without the file.
  std::string cause() const;

 private:
  ErrorKind kind_;
  std::string file_;
};

/// The same error, now about `file`, of the same kind and with the same cause.
WELKIN_API Error in_file(const std::string& file, const Error& error);

/// The work was cancelled, as Monitor::cancelled asked. Not an Error: nothing is wrong.
class WELKIN_API Cancelled : public std::exception {
 public:
  ~Cancelled() override;
  /// `cancelled`.
  const char* what() const noexcept override { return "cancelled"; }
};

/// Throws Error(bad_request, cause) unless the caller kept to the contract. For preconditions of public
/// functions, in release builds too.
inline void require(bool holds, const char* cause) {
  if (!holds) throw Error(ErrorKind::bad_request, cause);
}

/// `unknown KIND 'NAME'; did you mean 'NEAREST'? (one of: a, b, c)`: the message for a name that no table
/// has. The nearest is by edit distance, and is left out when nothing is near.
WELKIN_API std::string unknown_name(std::string_view kind, std::string_view name,
                                    std::span<const std::string> known);

}  // namespace welkin
