#pragma once

#include <algorithm>

#include "welkin/io/heif/heif_test_files.h"
#include "welkin/io/test_readers.h"

/// What the tests of AVIF and HEIF share.
namespace welkin::io::test {

inline constexpr int kLinear = 8, kSrgb = 13;

/// libheif 1.15 asks libaom for a wrong profile of ten bits, save for 4:2:2.
inline bool can_encode(heif_compression_format codec, int depth, heif_chroma chroma = heif_chroma_444) {
  return codec != heif_compression_AV1 || depth != 10 || chroma == heif_chroma_422;
}

inline heif_compression_format codec_for(int depth, heif_chroma chroma = heif_chroma_444) {
  return can_encode(heif_compression_AV1, depth, chroma) ? heif_compression_AV1 : heif_compression_HEVC;
}

/// A code that no neighbour has, 0 and the largest among them.
inline int varied(heif_channel channel, int x, int y, int depth) {
  const int largest = (1 << depth) - 1;
  if (x == 0 && y == 0) return 0;
  if (x == 1 && y == 0) return largest;
  return (x * 397 + y * 1213 + static_cast<int>(channel) * 71) % (largest + 1);
}

inline HeifPicture varied_picture(int width, int height, int depth,
                                  heif_colorspace space = heif_colorspace_RGB, bool alpha = false) {
  HeifPicture picture{width, height, depth, space, heif_chroma_444, alpha, nullptr};
  if (space == heif_colorspace_monochrome) picture.chroma = heif_chroma_monochrome;
  picture.code = [depth](heif_channel channel, int x, int y) { return varied(channel, x, y, depth); };
  return picture;
}

inline HeifOptions identity(int transfer = kLinear, int depth = 8) {
  HeifOptions options;
  options.codec = codec_for(depth);
  options.matrix = heif_matrix_coefficients_RGB_GBR;
  options.transfer = transfer;
  return options;
}

inline Bytes replaced(Bytes bytes, const std::string& from, const std::string& to) {
  const Bytes pattern = bytes_of(from), value = bytes_of(to);
  const auto found = std::search(bytes.begin(), bytes.end(), pattern.begin(), pattern.end());
  if (found == bytes.end() || value.size() > static_cast<std::size_t>(bytes.end() - found)) {
    ADD_FAILURE() << "the file has no " << from;
    return bytes;
  }
  std::copy(value.begin(), value.end(), found);
  return bytes;
}

}  // namespace welkin::io::test
