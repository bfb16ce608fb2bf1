#include "welkin/map_file/byte_remap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "welkin/base/error.h"
#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"
#include "welkin/map_file/cell_walk.h"

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

ByteView<const std::uint8_t> view_of(const Bytes& bytes, ChartSize size, int channels) {
  return {bytes.data(), size.width, size.height, channels,
          static_cast<std::ptrdiff_t>(size.width) * channels};
}

Bytes remapped(const ByteRemap& remap, const Bytes& source, int channels) {
  const ChartSize size = remap.target_size();
  Bytes target(static_cast<std::size_t>(size.width * size.height * channels), 99);
  remap.apply(
      view_of(source, remap.source_size(), channels),
      {target.data(), size.width, size.height, channels, static_cast<std::ptrdiff_t>(size.width) * channels});
  return target;
}

MapFrame frame_of(const char* spec, int width, int height, const Matrix3& orientation = {}) {
  return {sphere::AnyParameterization::make(spec), {width, height}, orientation};
}

Layout layout_called(const MapFrame& frame, const char* name) {
  for (const Layout& layout : layouts_of(frame.parameterization)) {
    if (layout.name == name) return layout;
  }
  return layouts_of(frame.parameterization).front();
}

/// The same by floats.
Image by_floats(const MapFrame& from, const MapFrame& to, const Layout& layout, const Bytes& bytes,
                int channels) {
  Map source(from.parameterization, from.size.width, from.size.height, channels);
  source.orientation = from.orientation;
  for (int y = 0; y < source.height(); ++y) {
    for (int i = 0; i < source.width() * channels; ++i)
      source.level.chart(0).row(y)[i] = bytes[static_cast<std::size_t>(y * source.width() * channels + i)];
  }
  fill_borders(source);
  Map target(to.parameterization, to.size.width, to.size.height, channels);
  target.orientation = to.orientation;
  resample(source, target, {.filter = Filter::bilinear, .borders = false});
  Image picture(layout.columns * to.size.width, layout.rows * to.size.height, channels);
  for (const LayoutCell& cell : layout.cells) {
    copy_walked(target.level.chart(cell.chart), walk_of(cell, to.size),
                picture.view().part(cell.column * to.size.width, cell.row * to.size.height, to.size.width,
                                    to.size.height));
  }
  return picture;
}

struct Case {
  MapFrame from, to;
  const char* layout;
};
std::vector<Case> cases() {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(40, 20, 10);
  return {{frame_of("latlong", 64, 32), frame_of("cube", 17, 17), "3x2"},
          {frame_of("latlong", 64, 32), frame_of("cube", 16, 16, turned), "bands"},
          {frame_of("latlong", 64, 32), frame_of("perspective,fov=120", 48, 27, turned), ""},
          {frame_of("octahedral", 40, 40), frame_of("latlong", 80, 40), ""},
          {frame_of("latlong", 33, 16), frame_of("fisheye-equidistant", 300, 300), ""},
          {frame_of("fisheye-equidistant", 64, 64), frame_of("cube", 16, 16, turned), "hcross"},
          {frame_of("perspective,fov=70", 64, 36, turned), frame_of("latlong", 64, 32), ""}};
}

TEST(ByteRemap, IsWhatFloatsGiveButForRounding) {
  for (const Case& each : cases()) {
    const Layout layout = layout_called(each.to, each.layout);
    const ByteRemap remap(each.from, each.to, layout);
    for (int channels = 1; channels <= 4; ++channels) {
      // Gradients of at most 12 a texel, also across seams of panoramas.
      const int width = each.from.size.width, height = each.from.size.height;
      Bytes source;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const Vec3d d = each.from.parameterization.to_sphere(0, (x + 0.5) / width, (y + 0.5) / height);
          const double values[] = {128 + 100 * d.x, 128 + 100 * d.y, 128 + 100 * d.z,
                                   255 - 100 * std::fabs(d.x)};
          for (int c = 0; c < channels; ++c)
            source.push_back(static_cast<std::uint8_t>(std::lround(values[c])));
        }
      }
      const Bytes found = remapped(remap, source, channels);
      const Image wanted = by_floats(each.from, each.to, layout, source, channels);
      int far = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double value = wanted.view().data[i];
        // Half of rounding, 12/128 each way of the position; borders of partial maps, which are means there
        // and repeated here, are their own affair.
        const bool edge =
            !each.from.parameterization.whole_world() || each.from.parameterization.name() == "octahedral";
        if (std::fabs(found[i] - value) > 0.8) {
          ++far;
          EXPECT_TRUE(edge) << each.to.parameterization.spec() << " " << i << ": " << int{found[i]} << " "
                            << value;
        }
      }
      EXPECT_LT(far, static_cast<int>(found.size()) / 20) << each.from.parameterization.spec();
    }
  }
}

TEST(ByteRemap, KeepsConstantsAndFillsTheRest) {
  for (const Case& each : cases()) {
    const ByteRemap remap(each.from, each.to, layout_called(each.to, each.layout), 7);
    const Bytes found = remapped(
        remap, Bytes(static_cast<std::size_t>(each.from.size.width * each.from.size.height * 3), 201), 3);
    EXPECT_TRUE(std::all_of(found.begin(), found.end(),
                            [](std::uint8_t value) { return value == 201 || value == 7; }));
    // The least is a perspective picture of 70°: a sixteenth of a world.
    EXPECT_GT(std::count(found.begin(), found.end(), 201), static_cast<std::ptrdiff_t>(found.size()) / 30);
  }
}

/// The extremes of every weight: nothing wraps around.
TEST(ByteRemap, StaysBetweenTheTexels) {
  const MapFrame from = frame_of("latlong", 64, 32), to = frame_of("cube", 200, 200);
  std::mt19937 random(1);
  Bytes source(64 * 32 * 3);
  for (std::uint8_t& value : source) value = random() % 2 == 0 ? 255 : 250;
  const Bytes found = remapped(ByteRemap(from, to, layout_called(to, "3x2")), source, 3);
  EXPECT_GE(*std::min_element(found.begin(), found.end()), 250);
}

TEST(ByteRemap, ReadsAndWritesRowsThatAreFartherApart) {
  const MapFrame from = frame_of("latlong", 64, 32), to = frame_of("perspective,fov=100", 40, 30);
  const ByteRemap remap(from, to, layouts_of(to.parameterization).front());
  Bytes source(64 * 32 * 3), wide(70 * 3 * 32, 0);
  std::mt19937 random(2);
  for (std::uint8_t& value : source) value = static_cast<std::uint8_t>(random());
  for (std::size_t y = 0; y < 32; ++y) std::copy_n(source.data() + y * 192, 192, wide.data() + y * 210);
  const Bytes packed = remapped(remap, source, 3);
  Bytes out(130 * 30, 5);
  remap.apply({wide.data(), 64, 32, 3, 210}, {out.data(), 40, 30, 3, 130});
  for (std::size_t y = 0; y < 30; ++y) {
    EXPECT_TRUE(std::equal(packed.data() + y * 120, packed.data() + (y + 1) * 120, out.data() + y * 130));
    EXPECT_EQ(out[y * 130 + 121], 5);
  }
}

TEST(ByteRemap, RefusesWhatDoesNotFit) {
  const MapFrame from = frame_of("latlong", 64, 32), to = frame_of("perspective", 40, 40);
  const Layout plain = layouts_of(to.parameterization).front();
  EXPECT_THROW(ByteRemap(frame_of("cube", 16, 16), to, plain), Error);
  const MapFrame cube = frame_of("cube", 16, 16);
  EXPECT_THROW(ByteRemap(from, cube, layout_called(cube, "faces")), Error);
  const ByteRemap remap(from, to, plain);
  Bytes source(64 * 32 * 5), target(40 * 40 * 5);
  EXPECT_THROW(remap.apply({source.data(), 32, 32, 3, 96}, {target.data(), 40, 40, 3, 120}), Error);
  EXPECT_THROW(remap.apply({source.data(), 64, 32, 3, 192}, {target.data(), 40, 40, 1, 40}), Error);
  EXPECT_THROW(remap.apply({source.data(), 64, 32, 5, 320}, {target.data(), 40, 40, 5, 200}), Error);
}

}  // namespace
}  // namespace welkin
