#include "welkin/map_file/face_names.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "welkin/base/error.h"
#include "welkin/map_file/map_file.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin::map_file {
namespace {

namespace fs = std::filesystem;

class FaceFiles : public testing::Test {
 protected:
  FaceFiles() : folder_(fs::temp_directory_path() / ("welkin_face_names_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~FaceFiles() override { fs::remove_all(folder_); }

  /// Six faces whose value is 1 to 6.
  void write_six(const std::string& pattern, const std::array<std::string, 6>& names) const {
    for (std::size_t i = 0; i < 6; ++i) {
      std::ofstream file(chart_path(folder_ / pattern, names[i]), std::ios::binary);
      file << "Pf\n2 2\n-1\n";
      const float value = static_cast<float>(i + 1);
      for (int texel = 0; texel < 4; ++texel) file.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }

  std::string failure(const std::string& name) const {
    try {
      read_map(folder_ / name);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  /// The values of the faces +X −X +Y −Y +Z −Z.
  std::vector<float> values_of(const std::string& name) const {
    const LoadedMap loaded = read_map(folder_ / name);
    EXPECT_EQ(loaded.info.shape->text(), "cube:faces");
    std::vector<float> values;
    for (int face = 0; face < 6; ++face) values.push_back(loaded.map.level.chart(face).at(0, 0)[0]);
    return values;
  }

  fs::path folder_;
};

const std::vector<float> kInOrder{1, 2, 3, 4, 5, 6};

TEST(FaceNames, AreDistinctAndBeginWithTheNativeOnes) {
  const std::vector<FaceNames>& all = known_face_names();
  EXPECT_EQ(all.front().text(), "px nx py ny pz nz");
  std::set<std::string> texts;
  for (const FaceNames& names : all) {
    EXPECT_TRUE(texts.insert(names.text()).second) << names.text();
    EXPECT_EQ(std::set<std::string>(names.faces.begin(), names.faces.end()).size(), 6u) << names.text();
  }
  for (const char* text :
       {"posx negx posy negy posz negz", "positive_x negative_x positive_y negative_y positive_z negative_z",
        "PX NX PY NY PZ NZ", "POSX NEGX POSY NEGY POSZ NEGZ", "PosX NegX PosY NegY PosZ NegZ",
        "+X -X +Y -Y +Z -Z", "right left top bottom front back", "Right Left Up Down Front Back",
        "RightTex LeftTex UpTex DownTex FrontTex BackTex", "ft bk up dn rt lf", "0 1 2 3 4 5", "1 2 3 4 5 6",
        "face0 face1 face2 face3 face4 face5"})
    EXPECT_TRUE(texts.contains(text)) << text;
}

TEST_F(FaceFiles, AreReadByAnyNames) {
  for (std::size_t i = 0; i < known_face_names().size(); ++i) {
    const FaceNames& names = known_face_names()[i];
    const std::string pattern = "sky" + std::to_string(i) + "_%s.pfm";
    write_six(pattern, names.faces);
    EXPECT_EQ(values_of(pattern), kInOrder) << names.text();
    const io::FileInfo info = MapReader(folder_ / pattern).info().image;
    const auto told = [&](const std::vector<std::string>& texts) {
      return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
        return text.find("called " + names.text() + ":") != std::string::npos;
      });
    };
    EXPECT_EQ(told(info.warnings), !names.axes) << names.text();
    EXPECT_EQ(told(info.notes), names.axes && i > 0) << names.text();
  }
}

TEST_F(FaceFiles, OfTwoSetsTheFirstCompleteOneIsRead) {
  write_six("two_%s.pfm", {"right", "left", "top", "bottom", "front", "back"});
  write_six("two_%s.pfm", {"px", "nx", "py", "ny", "pz", "nz"});
  const auto is_told = [&] {
    const std::vector<std::string> warnings = MapReader(folder_ / "two_%s.pfm").info().image.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("called right left") != std::string::npos;
    });
  };
  EXPECT_FALSE(is_told());
  fs::remove(folder_ / "two_nz.pfm");
  EXPECT_EQ(values_of("two_%s.pfm"), kInOrder);
  EXPECT_TRUE(is_told());
}

TEST_F(FaceFiles, ThatAreMissingAreNamed) {
  EXPECT_NE(
      failure("none_%s.pfm").find("none of none_px.pfm, none_posx.pfm, none_right.pfm, none_0.pfm… exists"),
      std::string::npos)
      << failure("none_%s.pfm");
  write_six("five_%s.pfm", {"right", "left", "top", "bottom", "front", "back"});
  fs::remove(folder_ / "five_top.pfm");
  EXPECT_NE(failure("five_%s.pfm").find("five_top.pfm: No such file or directory; of six faces, 5 exist"),
            std::string::npos)
      << failure("five_%s.pfm");
}

TEST_F(FaceFiles, OfOtherShapesAreNumbered) {
  Map map(sphere::AnyParameterization::make("paraboloid"), 4, 4, 1);
  map.level.chart(1).at(1, 1)[0] = 7;
  write_map(folder_ / "half_%s.exr", map, parse_map_shape("paraboloid:faces").layout);
  const LoadedMap loaded = read_map(folder_ / "half_%s.exr");
  EXPECT_EQ(loaded.info.shape->text(), "paraboloid:faces");
  EXPECT_EQ(loaded.map.level.chart(1).at(1, 1)[0], 7);
}

TEST_F(FaceFiles, OneAloneSuggestsThePattern) {
  write_six("sky-%s.pfm", {"right", "left", "top", "bottom", "front", "back"});
  EXPECT_EQ(pattern_of_face(folder_ / "sky-top.pfm"), folder_ / "sky-%s.pfm");
  EXPECT_NE(failure("sky-top.pfm")
                .find("it may be one of six faces, which " + (folder_ / "sky-%s.pfm").string() + " reads"),
            std::string::npos)
      << failure("sky-top.pfm");
  fs::copy_file(folder_ / "sky-top.pfm", folder_ / "laptop.pfm");
  EXPECT_TRUE(pattern_of_face(folder_ / "laptop.pfm").empty());
  EXPECT_EQ(failure("laptop.pfm").find("faces"), std::string::npos);
}

TEST_F(FaceFiles, AFileThatIsCalledLikeAPatternIsOne) {
  Map map(sphere::AnyParameterization::make("latlong"), 8, 4, 1);
  write_map(folder_ / "plain.exr", map);
  fs::rename(folder_ / "plain.exr", folder_ / "a%s.exr");
  EXPECT_EQ(read_map(folder_ / "a%s.exr").info.shape->text(), "latlong");
  write_six("a%s.pfm", {"px", "nx", "py", "ny", "pz", "nz"});
  EXPECT_EQ(values_of("a%s.pfm"), kInOrder);
  write_map(folder_ / "100%.exr", map);
  EXPECT_EQ(read_map(folder_ / "100%.exr").info.shape->text(), "latlong");
}

}  // namespace
}  // namespace welkin::map_file
