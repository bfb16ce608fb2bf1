#include "welkin/io/colour/gain_map.h"

#include <algorithm>
#include <cmath>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/jxl/gain_map_box.h"
#include "welkin/io/jxl/gain_map_test_files.h"
#include "welkin/io/test_readers.h"

namespace welkin::io::test {
namespace {

Image of_value(int width, int height, int channels, double value) {
  return picture_of(width, height, channels, [&](int, int, int) { return value; });
}

constexpr double kBase = 188 / 255.0;

/// A picture of kBase, with that box behind it.
Bytes file_with(const Bytes& content, const char* type = "jhgm") {
  return jxl_with_box(of_value(16, 8, 3, kBase), type, content);
}

bool warns_of(const Bytes& file, const std::string& words) {
  for (const std::string& warning : info_of(file).warnings) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

// hdr = sdr·2^gain, the gain interpolated from 0 to 3 between the two texels' centres.
TEST(JxlGainMap, MakesThePictureHdr) {
  for (const int channels : {1, 3}) {
    const Image gains = picture_of(2, 1, channels, [](int x, int, int) { return x; });
    const Bytes file = file_with(gain_map_box(gain_map_metadata_bytes(), encoded_jxl(gains)));
    const FileInfo info = info_of(file);
    EXPECT_TRUE(info.warnings.empty()) << info.warnings.front();
    EXPECT_EQ(info.notes.at(0), "made HDR by its gain map, of up to 3 stops");
    const Image image = decoded(file);
    for (int x = 0; x < 16; ++x) {
      const double weight = std::clamp((x + 0.5) / 8 - 0.5, 0.0, 1.0);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.at(x, 5)[c] / (srgb_to_linear(kBase) * std::exp2(3 * weight)), 1, 1e-5) << x;
    }
  }
}

TEST(JxlGainMap, LeftOutAndTold) {
  const Bytes gains = encoded_jxl(of_value(4, 2, 1, 1));
  const double plain = srgb_to_linear(kBase);
  const auto expect_plain = [&](const Bytes& file) { EXPECT_NEAR(decoded(file).at(3, 3)[0], plain, 1e-6); };
  // A base of more headroom than the alternate: the map makes it darker.
  const Bytes hdr = file_with(gain_map_box(gain_map_metadata_bytes(3, 0), gains));
  EXPECT_TRUE(info_of(hdr).warnings.empty());
  expect_plain(hdr);

  const Bytes later = file_with(gain_map_box(gain_map_metadata_bytes(), gains, 1));
  EXPECT_TRUE(warns_of(later, "not HDR: its gain map's box is of a later version"));
  expect_plain(later);

  const Bytes content = gain_map_box(gain_map_metadata_bytes(), gains);
  for (const std::size_t size : {1u, 2u, 40u, 70u, 78u}) {
    const Bytes cut = file_with(Bytes(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_TRUE(warns_of(cut, "its gain map is left out, so that it is not HDR")) << size;
    expect_plain(cut);
  }
  EXPECT_TRUE(warns_of(file_with(gain_map_box({}, gains)), "not HDR: it has no metadata"));

  // Boxes within the box would nest without end.
  const Bytes nested = file_with(gain_map_box(gain_map_metadata_bytes(), file_with(content)));
  EXPECT_TRUE(warns_of(nested, "holds no picture"));
  expect_plain(nested);

  const Bytes packed = file_with(bytes_of("jhgm..."), "brob");
  EXPECT_TRUE(warns_of(packed, "its gain map is compressed, and left out"));
  expect_plain(packed);
}

TEST(JxlGainMap, DamageIsSurvived) {
  expect_cuts_and_damage_are_survived(
      file_with(gain_map_box(gain_map_metadata_bytes(), encoded_jxl(of_value(4, 2, 1, 1)))));
}

}  // namespace
}  // namespace welkin::io::test
