#include "welkin/sequence/bake_frames.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>

#include "welkin/base/error.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/measure/compare.h"
#include "welkin/sequence/interpolate.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

Map sky(int frame, int width = 32) {
  synth::SynthOptions sun;
  sun.azimuth = 5.0 * frame;
  return render(synth::make("sky", sun), sphere::AnyParameterization::make("latlong"), width, width / 2);
}

/// Frames 1 … 12 of a sky that turns, in a folder that goes with the test.
class BakeFrames : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (int frame = 1; frame <= kFrames; ++frame) write_map(in_.file(frame), sky(frame));
    for (int frame = 1; frame <= kFrames; ++frame) make_older(in_.file(frame));
    options_.bake.lobe = lobe::AnyLobe::make("lambert");
    options_.bake.target = sphere::AnyParameterization::make("latlong");
    options_.bake.size = {8, 4};
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// As if written a while ago.
  static void make_older(const fs::path& file) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  Chain baked(int frame) const { return bake(read_map(in_.file(frame)).map, options_.bake); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  std::string bytes_of(const fs::path& file) const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What bake_frames throws.
  Error failure() const {
    try {
      bake_frames(in_, out_, options_);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "nothing is thrown";
    return {ErrorKind::system, ""};
  }
  static void expect_same(const Map& a, const Map& b) {
    ASSERT_EQ(a.width(), b.width());
    for (int c = 0; c < a.charts(); ++c) {
      for (int y = 0; y < a.height(); ++y) {
        for (int i = 0; i < a.width() * a.channels(); ++i)
          ASSERT_EQ(a.level.chart(c).row(y)[i], b.level.chart(c).row(y)[i]);
      }
    }
  }

  static constexpr int kFrames = 12;
  const fs::path folder_ =
      fs::temp_directory_path() /
      ("welkin-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  const FrameNames in_{folder_ / "sky_%04d.exr"}, out_{folder_ / "diffuse_##.exr"};
  BakeFramesOptions options_;
};

TEST_F(BakeFrames, EachFrameIsWhatBakeMakesOfIt) {
  const BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.frames.size(), 12u);
  EXPECT_EQ(report.baked, report.frames);
  EXPECT_TRUE(report.interpolated.empty() && report.held_out.empty() && report.worst() == nullptr);
  for (const int frame : report.frames)
    expect_same(read_map(out_.file(frame)).map, baked(frame).levels.front());
}

TEST_F(BakeFrames, ChainsKeepTheirLevelsAndNotes) {
  options_.bake = {};
  options_.bake.size = {8, 8};
  options_.every = 4;
  const FrameNames out(folder_ / "chain_%d.ktx2");
  bake_frames(in_, out, options_);
  const Chain key = read_chain(out.file(5)), between = read_chain(out.file(6)), expected = baked(5);
  ASSERT_EQ(key.levels.size(), 4u);
  EXPECT_EQ(key.notes, expected.notes);
  EXPECT_EQ(between.notes, expected.notes);
  for (std::size_t k = 0; k < 4; ++k) expect_same(key.levels[k], expected.levels[k]);
  const Chain half = interpolated(expected, baked(9), 0.25);
  for (std::size_t k = 0; k < 4; ++k) expect_same(between.levels[k], half.levels[k]);
}

TEST_F(BakeFrames, BetweenKeyFramesItInterpolatesAndTellsTheError) {
  options_.every = 5;
  const BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.baked, (std::vector<int>{1, 6, 11, 12}));
  EXPECT_EQ(report.interpolated, (std::vector<int>{2, 3, 4, 5, 7, 8, 9, 10}));
  ASSERT_EQ(report.held_out.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const int key = 1 + 5 * static_cast<int>(k), frame = key + 2;
    const Chain guess = interpolated(baked(key), baked(key + 5), 0.4);
    expect_same(read_map(out_.file(frame)).map, guess.levels.front());
    const ErrorMeasures error = compare(baked(frame).levels.front(), guess.levels.front()).all;
    EXPECT_EQ(report.held_out[k].frame, frame);
    EXPECT_DOUBLE_EQ(report.held_out[k].relative_rmse, error.relative_rmse);
    EXPECT_DOUBLE_EQ(report.held_out[k].maximum, error.maximum_relative);
    EXPECT_GT(error.relative_rmse, 1e-5);
  }
  EXPECT_GE(report.worst()->relative_rmse, report.held_out[0].relative_rmse);
}

TEST_F(BakeFrames, OnlyKeyFramesNeedASource) {
  for (const int frame : {2, 3, 4, 6, 7, 8, 10, 11}) fs::remove(in_.file(frame));
  EXPECT_EQ(failure().cause(), "frames 2–4, 6–8, 10–11 are missing of 1–12: ask for a range without gaps");
  EXPECT_EQ(files(), 4u);
  options_.every = 4;
  const BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.baked, (std::vector<int>{1, 5, 9, 12}));
  EXPECT_EQ(report.interpolated.size(), 8u);
  EXPECT_TRUE(report.held_out.empty());
  options_.frames = FrameRange{1, 20};
  EXPECT_EQ(failure().kind(), ErrorKind::not_found);
  options_.frames = FrameRange{1, FrameNames::kLargest};
  EXPECT_EQ(failure().kind(), ErrorKind::too_large);
  EXPECT_EQ(failure().file(), in_.name().string());
}

TEST_F(BakeFrames, KeysAloneCanBeWritten) {
  options_.every = 5;
  options_.between = false;
  options_.held_out = 1;
  const BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.frames, (std::vector<int>{1, 6, 11, 12}));
  EXPECT_EQ(report.held_out.size(), 1u);
  EXPECT_EQ(files(), 16u);
}

TEST_F(BakeFrames, AResizedFrameIsFoundBeforeAnyWork) {
  write_map(in_.file(7), sky(7, 64));
  const Error error = failure();
  EXPECT_EQ(error.kind(), ErrorKind::mismatch);
  EXPECT_EQ(error.file(), in_.file(7).string());
  EXPECT_EQ(error.cause(), "is 64×32, but sky_0001.exr is 32×16: frames have one size");
  EXPECT_EQ(files(), 12u);
}

TEST_F(BakeFrames, AFrameThatCannotBeFilteredLeavesThoseBeforeIt) {
  Map broken = sky(9);
  broken.level.chart(0).at(3, 3)[1] = std::nanf("");
  write_map(in_.file(9), broken);
  for (const int every : {1, 4}) {
    options_.every = every;
    const Error error = failure();
    EXPECT_EQ(error.kind(), ErrorKind::bad_value);
    EXPECT_EQ(error.file(), in_.file(9).string());
    EXPECT_NE(error.cause().find("1 texels have NaN"), std::string::npos);
    EXPECT_NE(error.cause().find(" of 12 frames are finished"), std::string::npos) << error.cause();
    EXPECT_FALSE(fs::exists(out_.file(9)));
    for (int frame = 1; frame <= (every == 1 ? 8 : 5); ++frame) {
      EXPECT_TRUE(fs::exists(out_.file(frame))) << frame;
      fs::remove(out_.file(frame));
    }
  }
}

TEST_F(BakeFrames, ADamagedFrameIsFoundBeforeAnyWork) {
  std::ofstream(in_.file(5)) << "no picture";
  EXPECT_EQ(failure().file(), in_.file(5).string());
  EXPECT_EQ(files(), 12u);
}

TEST_F(BakeFrames, SourcesAreNeverWrittenOver) {
  const FrameNames same(folder_ / ".." / folder_.filename() / "sky_####.exr");
  for (const FrameNames& out : {in_, same}) {
    try {
      bake_frames(in_, out, options_);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_request);
    }
  }
  expect_same(read_map(in_.file(1)).map, sky(1));
}

TEST_F(BakeFrames, AFolderThatIsNotThereIsFoundBeforeAnyWork) {
  try {
    bake_frames(in_, FrameNames(folder_ / "none" / "%d.exr"), options_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    EXPECT_EQ(error.file(), (folder_ / "none" / "1.exr").string());
  }
}

TEST_F(BakeFrames, ResumesWhatIsMissing) {
  options_.every = 5;
  options_.held_out = 0;
  bake_frames(in_, out_, options_);
  options_.resume = true;
  EXPECT_EQ(bake_frames(in_, out_, options_).complete.size(), 12u);

  const std::string before = bytes_of(out_.file(8));
  fs::remove(out_.file(8));
  BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.interpolated, (std::vector<int>{8}));
  EXPECT_TRUE(report.baked.empty());
  EXPECT_EQ(bytes_of(out_.file(8)), before);

  // A file that is cut short, or isn't one of these.
  fs::resize_file(out_.file(2), 40);
  write_map(out_.file(3), sky(3));
  report = bake_frames(in_, out_, options_);
  EXPECT_EQ(report.interpolated, (std::vector<int>{2, 3}));
}

TEST_F(BakeFrames, ResumingMixesNothing) {
  bake_frames(in_, out_, options_);
  options_.resume = true;
  // A source that is newer: only what depends on it.
  write_map(in_.file(6), sky(0));
  EXPECT_EQ(bake_frames(in_, out_, options_).baked, (std::vector<int>{6}));
  make_older(in_.file(6));
  // Another request: everything.
  const auto made_again = [&](auto change) {
    BakeFramesOptions changed = options_;
    change(changed);
    const std::size_t count = bake_frames(in_, out_, changed).baked.size();
    EXPECT_EQ(bake_frames(in_, out_, changed).baked.size(), 0u);
    bake_frames(in_, out_, options_);
    return count;
  };
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.bake.lobe = lobe::AnyLobe::make("phong,exponent=2"); }),
            12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.bake.size = {16, 8}; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.bake.prefilter.scale = LobeScale::integral; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.bake.prefilter.tolerance = 0.01; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.factor = 2; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.write.image.type = io::PixelType::half; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.read.image.colour = io::Colour::srgb; }), 12u);
  EXPECT_EQ(made_again([](BakeFramesOptions& o) { o.request = "turned"; }), 12u);
  // Frames 1, 6, 11 and 12 are what they were; those between are interpolated now.
  options_.every = 5;
  EXPECT_EQ(bake_frames(in_, out_, options_).interpolated.size(), 8u);
}

// In every format that has text, the note comes back as it was written.
TEST_F(BakeFrames, ResumesInEveryFormatWithText) {
  options_.every = 3;
  options_.held_out = 0;
  options_.frames = FrameRange{1, 4};
  for (const std::string& extension : io::writable_extensions()) {
    if (extension == "env" || extension == "glb") continue;  // hold a cube alone
    const FrameNames out(folder_ / ("out_%d." + extension));
    options_.resume = false;
    bake_frames(in_, out, options_);
    options_.resume = true;
    if (io::capabilities_for(out.name()).attributes) {
      EXPECT_EQ(bake_frames(in_, out, options_).complete.size(), 4u) << extension;
    } else {
      EXPECT_THROW(bake_frames(in_, out, options_), Error) << extension;
    }
  }
}

TEST_F(BakeFrames, FilesAreTheSameWhateverTheNumberOfThreads) {
  options_.every = 3;
  bake_frames(in_, out_, options_);
  const FrameNames other(folder_ / "other_##.exr");
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  options_.max_bytes = 1;
  bake_frames(in_, other, options_);
  for (int frame = 1; frame <= kFrames; ++frame)
    EXPECT_EQ(bytes_of(out_.file(frame)), bytes_of(other.file(frame)));
}

TEST_F(BakeFrames, CancellingKeepsFinishedFramesAndLeavesNoOther) {
  std::atomic<double> done{0};
  options_.monitor.progress = [&](double fraction) { done = std::max(done.load(), fraction); };
  options_.monitor.cancelled = [&] { return done > 0.3; };
  EXPECT_THROW(bake_frames(in_, out_, options_), Cancelled);
  EXPECT_LT(files(), 24u);
  EXPECT_GE(files(), 15u);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_NE(entry.path().extension(), ".tmp");
    EXPECT_NO_THROW(read_map(entry.path())) << entry.path();
  }
  // What is there is as good as ever.
  options_.monitor = {};
  options_.resume = true;
  const BakeFramesReport report = bake_frames(in_, out_, options_);
  EXPECT_GE(report.complete.size(), 3u);
  EXPECT_EQ(report.complete.size() + report.baked.size(), 12u);
  for (const int frame : report.frames)
    expect_same(read_map(out_.file(frame)).map, baked(frame).levels.front());
}

TEST_F(BakeFrames, EachThingIsToldOnce) {
  for (int frame = 3; frame <= kFrames; ++frame) {
    Map map = sky(frame);
    map.level.chart(0).at(frame, 3)[0] = -1;
    write_map(in_.file(frame), map);
  }
  std::vector<std::string> told;
  options_.told = [&](const fs::path& file, const std::string& text) {
    told.push_back(file.filename().string() + " " + text);
  };
  bake_frames(in_, out_, options_);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].starts_with("sky_0003.exr has negative values")) << told[0];
}

TEST_F(BakeFrames, FramesOfFacesAreReadAndWritten) {
  const FrameNames faces(folder_ / "cube_%02d_%s.png"), out(folder_ / "out_%d_%s.exr");
  const auto cube = sphere::AnyParameterization::make("cube");
  for (int frame = 1; frame <= 3; ++frame) {
    Map map(cube, 8, 8, 3);
    for (int c = 0; c < 6; ++c) {
      for (int y = 0; y < 8; ++y) {
        for (int i = 0; i < 24; ++i) map.level.chart(c).row(y)[i] = 0.1f * static_cast<float>(frame);
      }
    }
    write_map(faces.file(frame), map, parse_map_shape("cube:faces").layout);
  }
  options_.bake.target = cube;
  options_.bake.size = {4, 4};
  options_.layout = parse_map_shape("cube:faces").layout;
  EXPECT_EQ(bake_frames(faces, out, options_).baked.size(), 3u);
  const Map made = read_map(out.file(2)).map;
  EXPECT_NEAR(made.level.chart(3).at(1, 1)[0], 0.2, 0.002);  // of eight bits
  fs::remove(folder_ / "out_2_ny.exr");
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() == ".png") make_older(entry.path());
  }
  options_.resume = true;
  EXPECT_EQ(bake_frames(faces, out, options_).baked, (std::vector<int>{2}));
}

}  // namespace
}  // namespace welkin
