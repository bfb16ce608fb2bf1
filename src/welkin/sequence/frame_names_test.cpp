#include "welkin/sequence/frame_names.h"

#include <gtest/gtest.h>

#include <fstream>

#include "welkin/base/error.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

/// A folder of empty files, gone with the test.
class FrameNamesOnDisk : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void make(const std::vector<std::string>& names) const {
    for (const std::string& name : names) std::ofstream(folder_ / name) << "x";
  }
  std::vector<int> found(const std::string& name) const { return FrameNames(folder_ / name).find(); }

  const fs::path folder_ =
      fs::temp_directory_path() /
      ("welkin-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST(FrameNames, PlaceBecomesTheNumber) {
  EXPECT_EQ(FrameNames("a/sky_%04d.exr").file(7), "a/sky_0007.exr");
  EXPECT_EQ(FrameNames("sky_%04d.exr").file(12345), "sky_12345.exr");
  EXPECT_EQ(FrameNames("sky_%d.exr").file(7), "sky_7.exr");
  EXPECT_EQ(FrameNames("sky_%3d.exr").file(7), "sky_007.exr");
  EXPECT_EQ(FrameNames("####.hdr").file(0), "0000.hdr");
  EXPECT_EQ(FrameNames("v##_%s.png").file(5), "v05_%s.png");
  EXPECT_EQ(FrameNames("%s_%02d.png").place(), "%02d");
}

TEST(FrameNames, OtherNamesHaveNoPlace) {
  for (const char* name : {"sky.exr", "100%.exr", "%s.png", "%x.png", "%0d.png", "%00d.png", "%12d.png",
                           "no#1.exr", "%", "%0", "%04", "shot_%04d/sky.exr", "##########.exr", ""}) {
    EXPECT_FALSE(FrameNames::has_place(name)) << name;
    EXPECT_THROW(FrameNames{name}, Error) << name;
  }
  EXPECT_THROW(FrameNames("%d_##.exr"), Error);
  EXPECT_TRUE(FrameNames::has_place("%d_##.exr"));
}

TEST(FrameNames, NumbersOutOfRangeAreRefused) {
  const FrameNames names("%d.exr");
  EXPECT_THROW(names.file(-1), Error);
  EXPECT_THROW(names.file(FrameNames::kLargest + 1), Error);
  EXPECT_EQ(names.file(FrameNames::kLargest), "999999999.exr");
}

TEST_F(FrameNamesOnDisk, FindsWhatFileWouldName) {
  make({"a_0010.exr", "a_0009.exr", "a_0011.hdr", "a_12.exr", "a_12345.exr", "a_01234.exr", "b_0001.exr",
        "a_.exr", "a_0001.exr.tmp", "xa_0002.exr", ".a_0003.exr.1.tmp"});
  EXPECT_EQ(found("a_%04d.exr"), (std::vector<int>{9, 10, 12345}));
  EXPECT_EQ(found("a_####.exr"), (std::vector<int>{9, 10, 12345}));
  EXPECT_EQ(found("a_%d.exr"), (std::vector<int>{12, 12345}));
  EXPECT_EQ(found("a_%02d.exr"), (std::vector<int>{12, 12345}));
  EXPECT_EQ(found("a_%04d.hdr"), (std::vector<int>{11}));
}

TEST_F(FrameNamesOnDisk, FindsFramesOfFaces) {
  make(
      {"c_0001_px.png", "c_0001_nx.png", "c_0002_left.png", "c_0003_old.png", "c_0004_.png", "c_0005_3.png"});
  EXPECT_EQ(found("c_%04d_%s.png"), (std::vector<int>{1, 2, 5}));
}

// The number may stand beside digits of the name.
TEST_F(FrameNamesOnDisk, DigitsOfTheNameAreNotTheNumber) {
  make({"take200071.exr", "take200081.exr"});
  EXPECT_EQ(found("take2%04d1.exr"), (std::vector<int>{7, 8}));
}

// What find returns, file names, whatever the digits.
TEST_F(FrameNamesOnDisk, FindIsTheInverseOfFile) {
  const std::vector<int> frames{0, 9, 10, 99, 100, 101, 12345, 999999999};
  for (const char* name : {"%d.x", "%02d.x", "%09d.x", "p##.x"}) {
    std::vector<std::string> names;
    for (const int frame : frames) names.push_back(FrameNames(name).file(frame).string());
    make(names);
    EXPECT_EQ(found(name), frames) << name;
    for (const std::string& each : names) fs::remove(folder_ / each);
  }
}

TEST_F(FrameNamesOnDisk, NothingFoundIsAnErrorAboutTheName) {
  make({"a_0001.exr"});
  try {
    found("b_%04d.exr");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    EXPECT_NE(error.file().find("b_%04d.exr"), std::string::npos);
  }
  try {
    found("none/b_%04d.exr");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
  }
}

TEST(FramesText, IsShort) {
  EXPECT_EQ(frames_text(std::vector<int>{}), "");
  EXPECT_EQ(frames_text(std::vector<int>{4}), "4");
  EXPECT_EQ(frames_text(std::vector<int>{1, 2, 3, 7, 9, 10}), "1–3, 7, 9–10");
  EXPECT_EQ(frames_text(std::vector<int>{1, 3, 5, 7}, 2), "1, 3, …");
}

TEST(FrameRangeFrom, ReadsRangesAndRefusesOtherTexts) {
  EXPECT_EQ(frame_range_from("7").first, 7);
  EXPECT_EQ(frame_range_from("7").last, 7);
  EXPECT_EQ(frame_range_from("1-0300").last, 300);
  for (const char* text : {"", "-", "1-", "-3", "3-1", "a", "1-2-3", "1:2", "1 - 2", "1e3", "99999999999"})
    EXPECT_THROW(frame_range_from(text), Error) << text;
}

}  // namespace
}  // namespace welkin
