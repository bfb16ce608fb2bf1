#pragma once

#include <map>
#include <string>
#include <string_view>

/// Text metadata as lines `name=value`, for formats that carry free text: .hdr headers, TIFF's
/// ImageDescription, JPEG comments.
namespace welkin::io {

/// Adds the lines of `text` to `attributes`. Lines that are not `name=value` go, joined by line ends, under
/// `others`. A name begins with a letter and holds letters, digits and any of `_ . : / -` and spaces. Of a
/// name given twice the first value stays.
void parse_attribute_lines(std::string_view text, const std::string& others,
                           std::map<std::string, std::string>& attributes);

/// The reverse. Control characters in a value, line ends among them, become spaces, except that the value of
/// `others` is written as its own lines. Throws Error for a name that parse_attribute_lines would not find
/// again.
std::string attribute_lines(const std::map<std::string, std::string>& attributes, const std::string& others);

}  // namespace welkin::io
