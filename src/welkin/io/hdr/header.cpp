#include "welkin/io/hdr/header.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/io/text_attributes.h"

namespace welkin::io {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

/// Multiplies `values` (one or three of them in `text`) into the divisor, or notes why not.
void multiply_in(HdrHeader& header, const std::string& name, const std::string& text, int count) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double values[3] = {1, 1, 1};
  for (int k = 0; k < count; ++k) stream >> values[k];
  if (count == 1) values[1] = values[2] = values[0];
  double product[3];
  bool usable = !stream.fail();
  for (int k = 0; k < 3; ++k) {
    product[k] = header.divisor[k] * values[k];
    usable = usable && values[k] > 0 && product[k] > 0 && std::isfinite(product[k]);
  }
  if (!usable) {
    header.notes.push_back(name + "=" + text + " is ignored: not " + (count == 1 ? "a" : "three") +
                           " positive number" + (count == 1 ? "" : "s"));
    return;
  }
  for (int k = 0; k < 3; ++k) header.divisor[k] = product[k];
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

void parse_line(const Source& source, const std::string& line, HdrHeader& header) {
  const std::size_t equals = line.find('=');
  const std::string name = line.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : trimmed(line.substr(equals + 1));
  if (name == "FORMAT") {
    if (value != "32-bit_rle_rgbe" && value != "32-bit_rle_xyze") {
      throw Error(ErrorKind::unsupported, source.name,
                  "FORMAT=" + value + " is not a picture of RGBE or XYZE pixels");
    }
    header.xyze = value == "32-bit_rle_xyze";
    return;
  }
  if (name == "EXPOSURE") multiply_in(header, name, value, 1);
  if (name == "COLORCORR") multiply_in(header, name, value, 3);
  if (name == "PIXASPECT" && std::strtod(value.c_str(), nullptr) != 1) {
    header.notes.push_back("PIXASPECT=" + value + ": pixels are not square; none were resampled");
  }
  if (name == "PRIMARIES") header.notes.push_back("PRIMARIES=" + value + ": not converted");
  parse_attribute_lines(line, "history", header.attributes);
}

/// `-Y 512 +X 1024`: the first axis is that of the scan lines' order.
void parse_resolution(const Source& source, const std::string& line, HdrHeader& header) {
  const auto fail = [&] {
    throw Error(ErrorKind::damaged, source.name,
                "the resolution line '" + line.substr(0, 80) + "' is malformed");
  };
  std::istringstream stream(line);
  std::string axis[2];
  std::string digits[2];
  stream >> axis[0] >> digits[0] >> axis[1] >> digits[1];
  std::uint64_t size[2];
  for (int k = 0; k < 2; ++k) {
    const char* end = digits[k].data() + digits[k].size();
    const auto parsed = std::from_chars(digits[k].data(), end, size[k]);
    const bool named = axis[k].size() == 2 && (axis[k][0] == '-' || axis[k][0] == '+') &&
                       (axis[k][1] == 'X' || axis[k][1] == 'Y');
    if (parsed.ec != std::errc{} || parsed.ptr != end || !named) fail();
  }
  std::string rest;
  if (axis[0][1] == axis[1][1] || stream >> rest) fail();
  header.columns = axis[0][1] == 'X';
  const int x = header.columns ? 0 : 1;
  const int y = 1 - x;
  header.from_right = axis[x][0] == '-';
  header.from_bottom = axis[y][0] == '+';
  check_size(source, size[x], size[y], 3);
  header.width = static_cast<int>(size[x]);
  header.height = static_cast<int>(size[y]);
  if (line.rfind("-Y", 0) != 0 || header.from_right) {
    header.notes.push_back("stored in the order " + axis[0] + " " + axis[1] + "; turned upright");
  }
}

}  // namespace

HdrHeader parse_hdr_header(const Source& source) {
  const std::string_view text(reinterpret_cast<const char*>(source.bytes.data()),
                              std::min(source.bytes.size(), kLongestHeader));
  std::size_t at = 0;
  const auto next_line = [&] {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) {
      throw Error(ErrorKind::damaged, source.name,
                  "the header does not end (byte " + std::to_string(text.size()) + ")");
    }
    std::string line(text.substr(at, end - at));
    at = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  };
  HdrHeader header;
  next_line();  // `#?RADIANCE` or `#?RGBE`: Format::matches has seen it
  for (std::string line = next_line(); !line.empty(); line = next_line()) parse_line(source, line, header);
  parse_resolution(source, next_line(), header);
  header.pixels_at = at;
  return header;
}

}  // namespace welkin::io
