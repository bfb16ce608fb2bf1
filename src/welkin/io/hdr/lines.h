#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin::io {

/// How one scan line of a Radiance picture is stored. Which it is shows in its first bytes, or in hdr_body.
enum class HdrCoding {
  flat,      ///< four bytes a pixel
  old_runs,  ///< flat, but a pixel (1, 1, 1, n) repeats the one before n times; a second in a row n·256 times
             ///< more…
  components  ///< 2 2 length, then each component run-length coded by itself; only lengths of 8…32767
};

inline constexpr int kShortestComponentLine = 8;
inline constexpr int kLongestComponentLine = 32767;

/// Where a scan line of `length` pixels starting at `at` ends, reading only its run codes, never its pixels,
/// so this is a small fraction of decoding; `coding` says what it was. Everything is checked: decode_hdr_line
/// trusts it. Throws Error without the file's name or the line: `ends early (byte N)`.
std::size_t hdr_line_end(std::span<const std::byte> bytes, std::size_t at, int length, HdrCoding& coding);

/// How the scan lines of a picture are stored, as its length and its run codes tell.
struct HdrBody {
  bool flat = false;          ///< every line is flat, whatever its pixels look like
  std::size_t following = 0;  ///< bytes behind the last line, where that is known
};

/// Pixels of a flat picture may look like run codes: mantissas 1 1 1, or a line that begins with 2 2. Runs
/// make a file shorter, save of noise, so a file that has four bytes for each pixel is flat unless its lines,
/// two at least or all to the very end of the file, are what components look like. Walks over the lines
/// unless the file is too short to be flat and begins with components. Throws what hdr_line_end does, with
/// the line.
HdrBody hdr_body(std::span<const std::byte> bytes, std::size_t at, int lines, int length);

/// The same as hdr_line_end; messages name the line.
std::size_t hdr_line_end(std::span<const std::byte> bytes, std::size_t at, int line, int length,
                         HdrCoding& coding);

/// The fewest bytes that could hold such a scan line: one pixel, then runs.
std::uint64_t min_hdr_line_bytes(int length);

/// Four planes R G B E of one scan line.
class HdrPlanes {
 public:
  explicit HdrPlanes(int length) : length_(length), bytes_(4 * static_cast<std::size_t>(length)) {}
  int length() const { return length_; }
  std::uint8_t* operator[](int k) {
    return bytes_.data() + static_cast<std::size_t>(k) * static_cast<std::size_t>(length_);
  }

 private:
  int length_;
  std::vector<std::uint8_t> bytes_;
};

/// Decodes the scan line at `line`, which hdr_line_end has measured.
void decode_hdr_line(const std::byte* line, HdrCoding coding, HdrPlanes& planes);

/// Appends the scan line to `out`, by components, or flat where `coding` or its length asks for that.
void encode_hdr_line(HdrPlanes& planes, HdrCoding coding, std::vector<std::byte>& out);

}  // namespace welkin::io
