// Pixels of a program in, pixels of a program out: floats and halves, packed and strided.
#include <welkin/filter/resample.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// What a program may have: RGBA of half floats, rows from the bottom up, each padded to 256 bytes.
constexpr int kWidth = 64, kHeight = 32, kRowBytes = 512 + 256;

std::vector<std::byte> framebuffer() {
  std::vector<float> packed(kWidth * kHeight * 4);
  for (int i = 0; i < kWidth * kHeight; ++i) packed[static_cast<std::size_t>(4 * i)] = 1.0f;  // red
  std::vector<std::byte> bytes(kRowBytes * kHeight);
  welkin::ImageView<const float> view{packed.data(), kWidth, kHeight, 4, kWidth * 4};
  copy_pixels(view, welkin::MutablePixels{bytes.data() + kRowBytes * (kHeight - 1), kWidth, kHeight, 4,
                                          welkin::PixelFormat::half, 0, -kRowBytes});
  return bytes;
}

}  // namespace

int main() try {
  // In, with one copy: three of the four channels.
  const std::vector<std::byte> bytes = framebuffer();
  welkin::Pixels pixels{bytes.data() + kRowBytes * (kHeight - 1), kWidth, kHeight, 3};
  pixels.format = welkin::PixelFormat::half;
  pixels.texel_bytes = 4 * 2;
  pixels.row_bytes = -kRowBytes;
  const welkin::Map panorama =
      welkin::Map::from_pixels(welkin::sphere::AnyParameterization::make("latlong"), pixels);

  welkin::Map cube(welkin::sphere::AnyParameterization::make("cube"), 16, 16, 3);
  welkin::resample(panorama, cube);

  // Out, without a copy: a window onto the face +Y.
  const welkin::ImageView<const float> face = std::as_const(cube).level.chart(2);
  std::printf("red of +Y's middle: %g\n", static_cast<double>(face.at(8, 8)[0]));

  // Out, into a buffer of one's own.
  std::vector<float> own(16 * 16 * 3);
  copy_pixels(face, welkin::pixels_of(own.data(), 16, 16, 3));
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (std::fabs(own[i] - (i % 3 == 0 ? 1.0f : 0.0f)) > 1e-6f) return std::puts("not red"), 1;
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "own_pixels: %s\n", error.what());
  return 1;
}
