#include "welkin/image/image.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "welkin/base/error.h"

namespace welkin {
namespace {

TEST(Image, IsZeroAlignedAndReadablePastItsEnd) {
  for (int width : {1, 3, 17, 100}) {
    const Image image(width, 3, 3);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.view().data) % 64, 0u);
    float sum = 0;
    for (int i = 0; i < width * 9 + 16; ++i) sum += image.view().data[i];
    EXPECT_EQ(sum, 0);
  }
}

TEST(Image, RefusesSizesThatMakeNoSense) {
  EXPECT_THROW(Image(0, 1, 1), Error);
  EXPECT_THROW(Image(1, -1, 1), Error);
  EXPECT_THROW(Image(1, 1, 0), Error);
  EXPECT_THROW(Image(2147483647, 2147483647, 2147483647), Error);
}

TEST(Image, PartsAreWindowsOntoTheSamePixels) {
  Image image(4, 4, 2);
  const ImageView<float> part = image.view().part(1, 2, 2, 2);
  part.at(1, 1)[1] = 5;
  EXPECT_EQ(image.at(2, 3)[1], 5);
  Image copy(2, 2, 2);
  copy_pixels(part, copy.view());
  EXPECT_EQ(copy.at(1, 1)[1], 5);
  EXPECT_EQ(copy.at(0, 0)[0], 0);
}

}  // namespace
}  // namespace welkin
