#include "welkin/assemble/composite_over.h"

#include <gtest/gtest.h>

#include <limits>

#include "welkin/base/error.h"

namespace welkin {
namespace {

Image filled(int width, int height, std::initializer_list<float> texel) {
  Image image(width, height, static_cast<int>(texel.size()));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) std::copy(texel.begin(), texel.end(), image.at(x, y));
  }
  return image;
}

TEST(CompositeOver, IsNearPlusWhatItLetsThrough) {
  Image far = filled(3, 2, {1, 2, 4});
  composite_over(filled(3, 2, {0.5f, 0.25f, 0, 0.25f}).view(), far.view());
  EXPECT_FLOAT_EQ(far.at(2, 1)[0], 0.5f + 0.75f * 1);
  EXPECT_FLOAT_EQ(far.at(2, 1)[1], 0.25f + 0.75f * 2);
  EXPECT_FLOAT_EQ(far.at(0, 0)[2], 0.75f * 4);
}

TEST(CompositeOver, StraightColoursAreMultiplied) {
  Image straight = filled(2, 2, {1, 1, 1, 1}), premultiplied = filled(2, 2, {1, 1, 1, 1});
  composite_over(filled(2, 2, {0.8f, 0.4f, 0.2f, 0.5f}).view(), straight.view(), Association::straight);
  composite_over(filled(2, 2, {0.4f, 0.2f, 0.1f, 0.5f}).view(), premultiplied.view());
  for (int c = 0; c < 4; ++c) EXPECT_FLOAT_EQ(straight.at(1, 1)[c], premultiplied.at(1, 1)[c]);
}

// (a over b) over c is a over (b over c).
TEST(CompositeOver, IsAssociative) {
  const auto a = [] { return filled(1, 1, {0.3f, 0.1f, 0, 0.4f}); };
  const auto b = [] { return filled(1, 1, {0.2f, 0.5f, 0.1f, 0.7f}); };
  Image ab = b(), left = filled(1, 1, {2, 3, 4, 0.9f}), right = filled(1, 1, {2, 3, 4, 0.9f});
  composite_over(a().view(), ab.view());
  composite_over(ab.view(), left.view());
  composite_over(b().view(), right.view());
  composite_over(a().view(), right.view());
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(left.at(0, 0)[c], right.at(0, 0)[c], 1e-6);
}

TEST(CompositeOver, RefusesWhatDoesNotFit) {
  Image far = filled(4, 4, {1, 1, 1});
  const auto kind = [&](const Image& near) {
    try {
      composite_over(near.view(), far.view());
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::system;
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(kind(filled(4, 5, {0, 0, 0, 0})), ErrorKind::mismatch);
  EXPECT_EQ(kind(filled(4, 4, {0, 0, 0})), ErrorKind::bad_request);
  EXPECT_EQ(kind(filled(4, 4, {0, 0, 0, 1.1f})), ErrorKind::bad_value);
  EXPECT_EQ(kind(filled(4, 4, {0, 0, 0, -0.1f})), ErrorKind::bad_value);
  EXPECT_EQ(kind(filled(4, 4, {0, 0, 0, kNaN})), ErrorKind::bad_value);
  EXPECT_EQ(kind(filled(4, 4, {0, kNaN, 0, 1})), ErrorKind::bad_value);
  EXPECT_EQ(far.at(3, 3)[0], 1);
}

}  // namespace
}  // namespace welkin
