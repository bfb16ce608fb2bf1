#include "welkin/io/hdr/lines.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>

#include "welkin/base/error.h"

namespace welkin::io {
namespace {

constexpr int kLongestRun = 127;
constexpr int kLongestLiteral = 128;
constexpr int kShortestRun = 4;  ///< a shorter one costs more than it saves inside literals

bool may_be_components(int length) {
  return length >= kShortestComponentLine && length <= kLongestComponentLine;
}

struct EndsEarly : Error {
  explicit EndsEarly(std::size_t at)
      : Error(ErrorKind::damaged, "ends early (byte " + std::to_string(at) + ")") {}
};

[[noreturn]] void ends_early(std::size_t at) {
  throw EndsEarly(at);
}

[[noreturn]] void overruns(std::size_t at) {
  throw Error(ErrorKind::damaged, "a run passes the end of the line (byte " + std::to_string(at) + ")");
}

/// Whether a line of that length begins as one by components does.
bool starts_components(std::span<const std::byte> bytes, std::size_t at, int length) {
  if (!may_be_components(length) || bytes.size() - at < 4) return false;
  const auto* head = reinterpret_cast<const std::uint8_t*>(bytes.data()) + at;
  return head[0] == 2 && head[1] == 2 && (head[2] << 8 | head[3]) == length;
}

[[noreturn]] void throw_numbered(const Error& error, int line) {
  throw Error(error.kind(), "scan line " + std::to_string(line) + ": " + error.what());
}

std::size_t components_end(std::span<const std::byte> bytes, std::size_t at, int length) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const int stored = data[at + 2] << 8 | data[at + 3];
  if (stored != length) {
    throw Error(ErrorKind::damaged, "its length is given as " + std::to_string(stored) + ", not " +
                                        std::to_string(length) + " (byte " + std::to_string(at) + ")");
  }
  at += 4;
  for (int component = 0; component < 4; ++component) {
    for (int left = length; left > 0;) {
      if (at >= bytes.size()) ends_early(bytes.size());
      const int code = data[at];
      const bool run = code > kLongestLiteral;
      const int count = run ? code - kLongestLiteral : code;
      if (count == 0)
        throw Error(ErrorKind::damaged, "a literal of length 0 (byte " + std::to_string(at) + ")");
      if (count > left) overruns(at);
      left -= count;
      at += run ? 2 : 1 + static_cast<std::size_t>(count);
    }
  }
  if (at > bytes.size()) ends_early(bytes.size());
  return at;
}

bool is_old_run(const std::uint8_t* pixel) {
  return pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
}

std::size_t flat_end(std::span<const std::byte> bytes, std::size_t at, int length, HdrCoding& coding) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  coding = HdrCoding::flat;
  int shift = 0;
  for (std::int64_t left = length; left > 0; at += 4) {
    if (bytes.size() - at < 4) ends_early(bytes.size());
    const std::uint8_t* pixel = data + at;
    if (!is_old_run(pixel)) {
      --left;
      shift = 0;
      continue;
    }
    coding = HdrCoding::old_runs;
    if (left == length)
      throw Error(ErrorKind::damaged, "begins with a run of no pixel (byte " + std::to_string(at) + ")");
    if (shift > 24) overruns(at);
    left -= static_cast<std::int64_t>(pixel[3]) << shift;
    if (left < 0) overruns(at);
    shift += 8;
  }
  return at;
}

}  // namespace

std::size_t hdr_line_end(std::span<const std::byte> bytes, std::size_t at, int length, HdrCoding& coding) {
  if (bytes.size() - at < 4) ends_early(bytes.size());
  const auto* head = reinterpret_cast<const std::uint8_t*>(bytes.data()) + at;
  if (may_be_components(length) && head[0] == 2 && head[1] == 2 && head[2] < 128) {
    coding = HdrCoding::components;
    return components_end(bytes, at, length);
  }
  return flat_end(bytes, at, length, coding);
}

std::size_t hdr_line_end(std::span<const std::byte> bytes, std::size_t at, int line, int length,
                         HdrCoding& coding) {
  try {
    return hdr_line_end(bytes, at, length, coding);
  } catch (const Error& error) {
    throw_numbered(error, line);
  }
}

HdrBody hdr_body(std::span<const std::byte> bytes, std::size_t at, int lines, int length) {
  const std::uint64_t held = bytes.size() - at;
  const std::uint64_t flat_bytes =
      std::uint64_t{4} * static_cast<std::uint64_t>(lines) * static_cast<std::uint64_t>(length);
  const bool may_be_flat = held >= flat_bytes;
  const HdrBody flat{true, may_be_flat ? static_cast<std::size_t>(held - flat_bytes) : 0};
  int line = 0, component_lines = 0, other_lines = 0;
  try {
    for (; line < lines; ++line) {
      if (starts_components(bytes, at, length)) ++component_lines;
      HdrCoding coding;
      at = hdr_line_end(bytes, at, length, coding);
      if (coding != HdrCoding::components) ++other_lines;
      if (!may_be_flat && line == 0 && component_lines == 1) return {};
    }
  } catch (const EndsEarly& error) {
    // A picture by components that was cut off to the length of a flat one.
    if (!may_be_flat || component_lines > 0) throw_numbered(error, line);
    return flat;
  } catch (const Error& error) {
    if (!may_be_flat || component_lines > 1) throw_numbered(error, line);
    return flat;
  }
  const bool by_components =
      component_lines > 1 || (component_lines == 1 && (other_lines == 0 || at == bytes.size()));
  if (may_be_flat && !by_components) return flat;
  return {false, bytes.size() - at};
}

std::uint64_t min_hdr_line_bytes(int length) {
  // One pixel, then old runs of at most 255, 255·2^8, 255·2^16 …
  std::uint64_t bytes = 4;
  std::int64_t left = length - 1;
  for (int shift = 0; left > 0; shift += 8, bytes += 4) left -= std::int64_t{255} << shift;
  return bytes;
}

void decode_hdr_line(const std::byte* line, HdrCoding coding, HdrPlanes& planes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(line);
  const int length = planes.length();
  if (coding == HdrCoding::components) {
    data += 4;
    // The planes follow each other, and no run passes the end of its own.
    std::uint8_t* out = planes[0];
    std::uint8_t* const end = out + 4 * static_cast<std::size_t>(length);
    while (out < end) {
      const int code = *data++;
      if (code > kLongestLiteral) {
        const auto count = static_cast<std::size_t>(code - kLongestLiteral);
        std::memset(out, *data++, count);
        out += count;
      } else {
        const auto count = static_cast<std::size_t>(code);
        std::memcpy(out, data, count);
        out += count;
        data += count;
      }
    }
    return;
  }
  std::uint8_t* const out[4] = {planes[0], planes[1], planes[2], planes[3]};
  if (coding == HdrCoding::flat) {
    for (int i = 0; i < length; ++i) {
      for (int k = 0; k < 4; ++k)
        out[k][i] = data[4 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)];
    }
    return;
  }
  int shift = 0;
  for (int i = 0; i < length; data += 4) {
    if (!is_old_run(data)) {
      for (int k = 0; k < 4; ++k) out[k][i] = data[k];
      ++i;
      shift = 0;
      continue;
    }
    const int count = data[3] << shift;
    for (int k = 0; k < 4; ++k) std::memset(out[k] + i, out[k][i - 1], static_cast<std::size_t>(count));
    i += count;
    shift += 8;
  }
}

void encode_hdr_line(HdrPlanes& planes, HdrCoding coding, std::vector<std::byte>& out) {
  assert(coding != HdrCoding::old_runs);
  const int length = planes.length();
  if (coding == HdrCoding::flat || !may_be_components(length)) {
    for (int i = 0; i < length; ++i) {
      for (int k = 0; k < 4; ++k) out.push_back(static_cast<std::byte>(planes[k][i]));
    }
    return;
  }
  for (const int head : {2, 2, length >> 8, length & 255}) out.push_back(static_cast<std::byte>(head));
  for (int k = 0; k < 4; ++k) {
    const std::uint8_t* plane = planes[k];
    const auto* bytes = reinterpret_cast<const std::byte*>(plane);
    int literal = 0;  // where the values that are in no run begin
    for (int i = 0; i < length;) {
      int run = 1;
      while (i + run < length && run < kLongestRun && plane[i + run] == plane[i]) ++run;
      const bool worth_it = run >= kShortestRun;
      if (!worth_it) i += run;
      if (!worth_it && i < length) continue;
      while (literal < i) {
        const int count = std::min(i - literal, kLongestLiteral);
        out.push_back(static_cast<std::byte>(count));
        out.insert(out.end(), bytes + literal, bytes + literal + count);
        literal += count;
      }
      if (!worth_it) break;
      out.push_back(static_cast<std::byte>(kLongestLiteral + run));
      out.push_back(bytes[i]);
      i += run;
      literal = i;
    }
  }
}

}  // namespace welkin::io
