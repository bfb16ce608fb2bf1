#include "welkin/map_file/write_resampled.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <mutex>

#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
using sphere::AnyParameterization;

class WriteResampled : public testing::Test {
 protected:
  WriteResampled()
      : folder_(fs::temp_directory_path() / ("welkin_write_resampled_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~WriteResampled() override { fs::remove_all(folder_); }

  std::vector<char> bytes_of(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  /// The file is, bit for bit, what its map becomes when it is resampled first and written then.
  void expect_same_file(const Map& source, const MapShape& shape, ChartSize size,
                        const WriteResampledOptions& options, const std::string& extension = ".exr") {
    const bool files = shape.layout.kind == LayoutKind::files;
    const std::string ending = (files ? "_%s" : "") + extension;
    const auto report = write_resampled(folder_ / ("drawn" + ending), source, shape, size, options);

    Map target(shape.parameterization, size.width, size.height, source.channels());
    target.channel_names = source.channel_names;
    target.orientation = options.orientation;
    ResampleOptions resampling = options.resample;
    resampling.borders = options.write.border > 0;
    resample(source, target, resampling);
    if (options.factor != 1) scale(target, options.factor);
    const auto expected = write_map(folder_ / ("whole" + ending), target, shape.layout, options.write);

    EXPECT_EQ(report.above, expected.above);
    EXPECT_EQ(report.below, expected.below);
    for (const std::string& chart :
         files ? chart_names(shape.parameterization) : std::vector<std::string>{""}) {
      const std::string end = (files ? "_" + chart : "") + extension;
      const std::vector<char> drawn = bytes_of("drawn" + end);
      EXPECT_FALSE(drawn.empty());
      EXPECT_TRUE(drawn == bytes_of("whole" + end)) << shape.text() << ' ' << size.width << 'x' << size.height
                                                    << ' ' << name_of(options.resample.filter) << ' ' << end;
    }
  }

  fs::path folder_;
};

Map noise(const AnyParameterization& p, int width, int height, int channels) {
  Map map(p, width, height, channels);
  std::uint32_t state = 1;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < width * channels; ++i) {
        state = state * 1664525u + 1013904223u;
        map.level.chart(chart).row(y)[i] = static_cast<float>(state >> 8) * 0x1p-22f;
      }
    }
  }
  fill_borders(map);
  return map;
}

int height_for(const AnyParameterization& p, int width) {
  return std::max(1, static_cast<int>(std::lround(width / p.aspect())));
}

WriteResampledOptions plain(Filter filter = Filter::bilinear) {
  WriteResampledOptions options;
  options.resample.filter = filter;
  options.write.image.compression = "none";
  return options;
}

/// A turn about no axis of the cube.
Matrix3 turn() {
  return rotation_from_yaw_pitch_roll(20, -35, 50);
}

TEST_F(WriteResampled, EveryLayoutOfEveryParameterizationWithEveryFilter) {
  const Map source = noise(AnyParameterization::make("latlong"), 96, 48, 3);
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    for (const Layout& layout : layouts_of(p)) {
      for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::automatic}) {
        WriteResampledOptions options = plain(filter);
        options.resample.rotation = turn();
        // 50: neither whole tiles nor whole bands.
        expect_same_file(source, {p, layout}, {50, height_for(p, 50)}, options);
      }
    }
  }
}

TEST_F(WriteResampled, SmallerAndLargerCharts) {
  const Map source = noise(AnyParameterization::make("latlong"), 256, 128, 3);
  for (const char* shape : {"cube:flat", "cube:bands", "cube:openexr", "octahedral", "fisheye-equidistant"}) {
    for (const int width : {1, 7, 24, 160}) {
      for (const Filter filter : {Filter::nearest, Filter::automatic}) {
        const MapShape parsed = parse_map_shape(shape);
        expect_same_file(source, parsed, {width, height_for(parsed.parameterization, width)}, plain(filter));
      }
    }
  }
}

TEST_F(WriteResampled, OtherNumbersOfChannelsSourcesAndFill) {
  for (const int channels : {1, 2, 4, 5}) {
    for (const char* from : {"cube", "fisheye-equidistant"}) {
      const auto p = AnyParameterization::make(from);
      const Map source = noise(p, 40, height_for(p, 40), channels);
      WriteResampledOptions options = plain();
      options.resample.fill = {0.25f, 0.5f};
      for (const char* shape : {"latlong", "cube:hcross", "fisheye-equisolid"}) {
        const MapShape parsed = parse_map_shape(shape);
        expect_same_file(source, parsed, {66, height_for(parsed.parameterization, 66)}, options);
      }
    }
  }
}

TEST_F(WriteResampled, ACopyIsTurnedIntoItsCells) {
  for (const char* name : {"cube:flat", "cube:vcross", "latlong", "fisheye-equidistant"}) {
    const MapShape shape = parse_map_shape(name);
    const int height = height_for(shape.parameterization, 34);
    expect_same_file(noise(shape.parameterization, 34, height, 3), shape, {34, height}, plain());
  }
}

TEST_F(WriteResampled, OrientationExposureFacesAndBorders) {
  const Map source = noise(AnyParameterization::make("latlong"), 64, 32, 4);
  const Matrix3 reflection{{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
  for (const Matrix3& orientation : {turn(), reflection}) {
    for (const char* shape : {"cube:hcross", "cube:bands", "cube:layers", "latlong"}) {
      WriteResampledOptions options = plain();
      options.orientation = orientation;
      options.factor = 2.75f;
      expect_same_file(source, parse_map_shape(shape), {32, shape[0] == 'l' ? 16 : 32}, options);
    }
  }
  WriteResampledOptions turned = plain(Filter::automatic), bordered = plain();
  turned.write.faces = "nx,px:90,py:mirror,ny:270:mirror,pz:180,nz";
  expect_same_file(source, parse_map_shape("cube:hstrip"), {20, 20}, turned);
  bordered.write.border = 2;
  expect_same_file(source, parse_map_shape("cube:hstrip"), {20, 20}, bordered);
}

TEST_F(WriteResampled, EveryFormat) {
  const Map source = noise(AnyParameterization::make("latlong"), 64, 32, 3);
  for (const char* extension : {".pfm", ".hdr", ".png", ".tif", ".jpg", ".webp", ".ktx2", ".exr"}) {
    WriteResampledOptions options = plain();
    options.write.image.compression = "";
    const fs::path path = "a" + std::string(extension);
    expect_same_file(source, parse_map_shape_for(path, "cube"), {48, 48}, options, extension);
  }
  for (const char* compression : {"rle", "zips", "zip", "piz", "dwaa"}) {
    WriteResampledOptions options = plain();
    options.write.image.compression = compression;
    expect_same_file(source, parse_map_shape("cube:hcross"), {48, 48}, options);
  }
}

TEST_F(WriteResampled, NotesAreThoseOfAChainOfOneLevel) {
  const Map source = noise(AnyParameterization::make("latlong"), 64, 32, 3);
  WriteResampledOptions options = plain();
  options.notes.lobe = "ggx";
  const MapShape shape = parse_map_shape("cube:hcross");
  write_resampled(folder_ / "a.exr", source, shape, {16, 16}, options);
  EXPECT_EQ(MapReader(folder_ / "a.exr").info().notes.lobe, "ggx");
}

TEST_F(WriteResampled, TellsProgressAndIsCancelledWithoutATrace) {
  const Map source = noise(AnyParameterization::make("latlong"), 64, 32, 3);
  for (const char* extension : {".exr", ".pfm", ".png"}) {
    WriteResampledOptions options = plain();
    options.write.image.compression = "";
    std::atomic<double> furthest{0};
    options.resample.monitor.progress = [&](double done) {
      double before = furthest;
      while (before < done && !furthest.compare_exchange_weak(before, done)) {
      }
    };
    const fs::path path = folder_ / ("a" + std::string(extension));
    const MapShape shape = parse_map_shape("cube:hcross");
    write_resampled(path, source, shape, {300, 300}, options);
    EXPECT_EQ(furthest, 1);
    fs::remove(path);

    options.resample.monitor.cancelled = [&, asked = std::make_shared<std::atomic<int>>(0)] {
      return ++*asked > 1;
    };
    EXPECT_THROW(write_resampled(path, source, shape, {300, 300}, options), Cancelled);
    EXPECT_EQ(files(), 0u);

    options.resample.monitor = {[](double) { throw 17; }, nullptr};
    EXPECT_THROW(write_resampled(path, source, shape, {300, 300}, options), int);
    EXPECT_EQ(files(), 0u);
  }
}

TEST_F(WriteResampled, TellsEveryRowThatIsMadeBeforeItIsScaled) {
  const Map source = noise(AnyParameterization::make("latlong"), 96, 48, 3);
  for (const char* text : {"cube:hstrip", "cube:vcross", "cube:faces", "octahedral", "fisheye-equidistant"}) {
    for (const Filter filter : {Filter::bilinear, Filter::automatic}) {
      for (const int border : {0, 2}) {
        const MapShape shape = parse_map_shape(text);
        const ChartSize size{50, height_for(shape.parameterization, 50)};
        WriteResampledOptions options = plain(filter);
        options.factor = 3;
        options.write.border = border;
        Map told(shape.parameterization, size.width, size.height, 3);
        std::mutex mutex;
        options.made = [&](int chart, int y, ImageView<const float> rows) {
          ASSERT_EQ(rows.width, size.width);
          const std::scoped_lock lock(mutex);
          for (int i = 0; i < rows.height; ++i)
            std::copy_n(rows.row(i), 3 * size.width, told.level.chart(chart).row(y + i));
        };
        const bool files = shape.layout.kind == LayoutKind::files;
        write_resampled(folder_ / (files ? "a_%s.exr" : "a.exr"), source, shape, size, options);
        Map whole(shape.parameterization, size.width, size.height, 3);
        ResampleOptions resampling = options.resample;
        resampling.borders = border > 0;
        resample(source, whole, resampling);
        for (int chart = 0; chart < whole.charts(); ++chart) {
          for (int y = 0; y < size.height; ++y) {
            for (int i = 0; i < 3 * size.width; ++i)
              ASSERT_EQ(told.level.chart(chart).row(y)[i], whole.level.chart(chart).row(y)[i]) << text;
          }
        }
      }
    }
  }
}

TEST_F(WriteResampled, RefusesChartsThatCannotBeTurned) {
  const Map source = noise(AnyParameterization::make("latlong"), 64, 32, 3);
  EXPECT_THROW(write_resampled(folder_ / "a.exr", source, parse_map_shape("cube:flat"), {8, 4}, plain()),
               Error);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace welkin
