#include "welkin/io/hdr/header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/io/text_attributes.h"

namespace welkin::io {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

struct Line {
  std::string_view name, value;
};

/// `NAME=value`, without the spaces around the sign that some programs write; nothing of other lines.
std::optional<Line> variable(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos || equals == 0 || line[0] == ' ' || line[0] == '\t') return {};
  return Line{trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))};
}

/// The finite numbers of `text`, if it holds `count` and nothing else.
std::optional<std::vector<double>> numbers(std::string_view text, std::size_t count) {
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  std::vector<double> values(count);
  for (double& value : values) stream >> value;
  std::string rest;
  if (stream.fail() || stream >> rest) return {};
  for (const double value : values) {
    if (!std::isfinite(value)) return {};
  }
  return values;
}

void ignore(HdrHeader& header, const Line& line, const std::string& why) {
  header.warnings.push_back(std::string(line.name) + "=" + std::string(line.value) + " is ignored: " + why);
}

/// Multiplies the line's numbers, one or three, into the divisor.
void multiply_in(HdrHeader& header, const Line& line, std::size_t count) {
  const auto values = numbers(line.value, count);
  double product[3];
  bool usable = values.has_value();
  for (std::size_t k = 0; usable && k < 3; ++k) {
    const double value = (*values)[count == 1 ? 0 : k];
    product[k] = header.divisor[k] * value;
    usable = value > 0 && product[k] > 0 && std::isfinite(product[k]);
  }
  if (!usable) {
    ignore(header, line, count == 1 ? "not a positive number" : "not three positive numbers");
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) header.divisor[k] = product[k];
}

/// GAMMA states the power of which pixels are the root, 2.2 (Walter's rgbe.c), or the power that they were
/// raised to, 0.4545 (ImageMagick); one is below 1, the other above.
void set_gamma(const Source& source, HdrHeader& header, const Line& line) {
  if (source.options.colour != Colour::automatic) return;

  const auto values = numbers(line.value, 1);
  if (!values || !(values->front() > 0)) return ignore(header, line, "not a positive number");
  const double gamma = values->front();
  header.gamma = gamma < 1 ? 1 / gamma : gamma;
  if (header.gamma == 1) return;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "GAMMA=" << line.value << ": taken as encoded, and raised to the power " << header.gamma;
  header.warnings.push_back(text.str());
}

void set_primaries(HdrHeader& header, const Line& line) {
  const auto v = numbers(line.value, 8);
  if (!v) return ignore(header, line, "not eight numbers");
  const auto& n = *v;
  // Photoshop writes eight zeros where it says nothing.
  bool nothing = true;
  for (const double value : n) nothing = nothing && value == 0;
  if (nothing) return;
  const double area = (n[2] - n[0]) * (n[5] - n[1]) - (n[4] - n[0]) * (n[3] - n[1]);
  if (std::fabs(area) < 1e-6 || n[7] <= 0)
    return ignore(header, line, "not the corners of a gamut and its white");
  header.primaries = Chromaticities{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
}

void parse_line(const Source& source, const std::string& text, HdrHeader& header, bool& has_format) {
  const auto line = variable(text);
  if (line && line->name == "FORMAT") {
    if (line->value != "32-bit_rle_rgbe" && line->value != "32-bit_rle_xyze") {
      throw Error(ErrorKind::unsupported, source.name,
                  "FORMAT=" + std::string(line->value) + " is not a picture of RGBE or XYZE pixels");
    }
    header.xyze = line->value == "32-bit_rle_xyze";
    has_format = true;
    return;
  }
  if (line && line->name == "EXPOSURE") multiply_in(header, *line, 1);
  if (line && line->name == "COLORCORR") multiply_in(header, *line, 3);
  if (line && line->name == "GAMMA") set_gamma(source, header, *line);
  if (line && line->name == "PRIMARIES") set_primaries(header, *line);
  if (line && line->name == "PIXASPECT") {
    const auto values = numbers(line->value, 1);
    if (!values || values->front() != 1) {
      header.warnings.push_back("PIXASPECT=" + std::string(line->value) +
                                ": pixels are said not to be square; they are taken as if they were");
    }
  }
  // Attributes are written `name=value`.
  parse_attribute_lines(line ? std::string(line->name) + "=" + std::string(line->value) : text, "history",
                        header.attributes);
}

/// `-Y 512 +X 1024`: the first axis is that of the scan lines' order.
struct Resolution {
  std::string axis[2];
  std::uint64_t size[2];
};

std::optional<Resolution> resolution_of(std::string_view line) {
  constexpr std::size_t kLongest = 80;
  if (line.size() > kLongest) return {};
  std::istringstream stream{std::string(line)};
  Resolution resolution;
  std::string digits[2], rest;
  stream >> resolution.axis[0] >> digits[0] >> resolution.axis[1] >> digits[1];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string& axis = resolution.axis[k];
    const char* end = digits[k].data() + digits[k].size();
    const auto parsed = std::from_chars(digits[k].data(), end, resolution.size[k]);
    const bool named =
        axis.size() == 2 && (axis[0] == '-' || axis[0] == '+') && (axis[1] == 'X' || axis[1] == 'Y');
    if (parsed.ec != std::errc{} || parsed.ptr != end || !named) return {};
  }
  if (resolution.axis[0][1] == resolution.axis[1][1] || stream >> rest) return {};
  return resolution;
}

void parse_resolution(const Source& source, const std::string& line, HdrHeader& header) {
  const auto resolution = resolution_of(line);
  if (!resolution) {
    throw Error(
        ErrorKind::damaged, source.name,
        "the resolution line '" + line.substr(0, 80) + "' is malformed; it should be as '-Y 512 +X 1024'");
  }
  const auto& [axis, size] = *resolution;
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

std::string_view text_of(std::span<const std::byte> bytes, std::size_t longest) {
  return {reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), longest)};
}

/// The line at `at`, without its end, and `at` of the next; nothing when it doesn't end.
std::optional<std::string_view> next_line(std::string_view text, std::size_t& at) {
  const std::size_t end = text.find('\n', at);
  if (end == std::string_view::npos) return {};
  std::string_view line = text.substr(at, end - at);
  at = end + 1;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool is_text(std::string_view line) {
  return std::none_of(line.begin(), line.end(),
                      [](unsigned char c) { return (c < 32 && c != '\t') || c == 127; });
}

constexpr std::string_view kMark = "#?";

}  // namespace

bool is_hdr(std::span<const std::byte> bytes) {
  constexpr std::size_t kSearched = std::size_t{1} << 16;
  const std::string_view text = text_of(bytes, kSearched);
  if (text.starts_with(kMark)) return true;
  std::size_t at = 0;
  bool first = true;
  for (auto line = next_line(text, at); line && is_text(*line); line = next_line(text, at), first = false) {
    if (line->empty()) {
      line = next_line(text, at);
      return !first && line && resolution_of(*line);
    }
    const auto said = variable(*line);
    if (said && said->name == "FORMAT" && said->value.starts_with("32-bit_rle_")) return true;
  }
  return false;
}

HdrHeader parse_hdr_header(const Source& source) {
  const std::string_view text = text_of(source.bytes, kLongestHeader);
  std::size_t at = 0;
  const auto required_line = [&] {
    const auto line = next_line(text, at);
    if (!line) {
      throw Error(ErrorKind::damaged, source.name,
                  "the header does not end (byte " + std::to_string(text.size()) + ")");
    }
    return std::string(*line);
  };
  HdrHeader header;
  const bool marked = text.starts_with(kMark);
  bool has_format = false;
  if (marked) required_line();
  for (std::string line = required_line(); !line.empty(); line = required_line())
    parse_line(source, line, header, has_format);
  parse_resolution(source, required_line(), header);
  header.pixels_at = at;
  if (!has_format) {
    const std::string guess = "its header has no FORMAT; pixels are taken as RGBE";
    (marked ? header.notes : header.warnings).push_back(guess);
  }
  if (header.xyze && header.primaries) {
    header.primaries.reset();
    header.warnings.push_back("PRIMARIES is ignored: XYZE pixels have no others");
  }
  return header;
}

}  // namespace welkin::io
