#pragma once

#include <string>
#include <string_view>

namespace welkin::io {

/// What a message of libtiff's says, in words for people: the field or the cause that it names, without its
/// functions and numbers. Empty for one that says nothing more than that something failed.
std::string tiff_failure(std::string_view message);

}  // namespace welkin::io
