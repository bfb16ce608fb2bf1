#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/map_file/map_file.h"

namespace welkin {
namespace {

using Names = std::vector<std::string>;

/// Channel c of texel (x, y) of a chart is 100·chart + 10·(y + 2·x) + c, in borders too.
Map numbered(const Names& names) {
  Map map(sphere::AnyParameterization::make("cube"), 3, 3, static_cast<int>(names.size()));
  map.channel_names = names;
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = -kBorder; y < 3 + kBorder; ++y) {
      for (int x = -kBorder; x < 3 + kBorder; ++x) {
        for (int c = 0; c < map.channels(); ++c)
          map.level.chart(chart).at(x, y)[c] = static_cast<float>(100 * chart + 10 * (y + 2 * x) + c);
      }
    }
  }
  return map;
}

struct Fitted {
  Map map;
  std::vector<std::string> notes;
};

Fitted fitted(const Names& names, const std::string& file, const io::WriteOptions& options = {}) {
  Fitted result{numbered(names), {}};
  result.notes = fit_channels(result.map, file, options);
  return result;
}

TEST(FitChannels, AlphaIsLeftOutWhereTheFormatHasNone) {
  for (const char* file : {"o.hdr", "o.pfm", "o.jpg"}) {
    for (const Names& names : {Names{"R", "G", "B", "A"}, Names{"A", "R", "G", "B"}}) {
      const Fitted result = fitted(names, file);
      EXPECT_EQ(result.map.channel_names, (Names{"R", "G", "B"}));
      ASSERT_EQ(result.notes.size(), 1u);
      EXPECT_NE(result.notes[0].find("holds no alpha"), std::string::npos);
      const int first = names[0] == "A" ? 1 : 0;
      for (int chart = 0; chart < 6; ++chart) {
        for (const auto& [x, y] : {std::pair(-1, -1), std::pair(0, 0), std::pair(2, 1), std::pair(3, 3)}) {
          for (int c = 0; c < 3; ++c)
            EXPECT_EQ(result.map.level.chart(chart).at(x, y)[c], 100 * chart + 10 * (y + 2 * x) + c + first);
        }
      }
    }
    EXPECT_EQ(fitted({"Y", "A"}, file).map.channel_names, (Names{"Y"}));
  }
  io::WriteOptions packed;
  packed.type = io::PixelType::rgb9e5;
  EXPECT_EQ(fitted({"R", "G", "B", "A"}, "o.ktx2", packed).map.channel_names, (Names{"R", "G", "B"}));
}

TEST(FitChannels, WhatTheFormatHoldsStays) {
  const auto stays = [](const Names& names, const std::string& file) {
    const Fitted result = fitted(names, file);
    return result.map.channel_names == names && result.notes.empty();
  };
  EXPECT_TRUE(stays({"R", "G", "B", "A"}, "o.png"));
  EXPECT_TRUE(stays({"R", "G", "B", "A"}, "o.ktx2"));
  EXPECT_TRUE(stays({"B", "G", "R"}, "o.hdr"));
  EXPECT_TRUE(stays({"Y"}, "o.pfm"));
  EXPECT_TRUE(stays({"Y", "A"}, "o.tif"));
  EXPECT_TRUE(stays({"u", "v", "w", "id", "Z"}, "o.exr"));
}

TEST(FitChannels, OtherNamesBecomeThoseOfTheFormat) {
  const Fitted vector = fitted({"X", "Y", "Z"}, "o.hdr");
  EXPECT_EQ(vector.map.channel_names, (Names{"R", "G", "B"}));
  EXPECT_EQ(vector.notes, (Names{"channels X Y Z are written as R G B"}));
  EXPECT_EQ(fitted({"Z"}, "o.pfm").map.channel_names, (Names{"Y"}));
  EXPECT_EQ(fitted({"Z"}, "o.pfm").notes, (Names{"channel Z is written as Y"}));
  EXPECT_EQ(fitted({"a", "b", "c", "d"}, "o.png").map.channel_names, (Names{"R", "G", "B", "A"}));
}

TEST(FitChannels, WhatDoesNotFitNamesTheRemedy) {
  const auto refused = [](const Names& names, const std::string& file) {
    try {
      fitted(names, file);
    } catch (const Error& error) {
      return error.kind() == ErrorKind::unsupported &&
             std::string(error.what()).find("read one channel or three") != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({"u", "v"}, "o.hdr"));
  EXPECT_TRUE(refused({"u", "v"}, "o.png"));
  EXPECT_TRUE(refused({"a", "b", "c", "d"}, "o.hdr")) << "none of them is alpha";
  EXPECT_TRUE(refused({"R", "G", "B", "A", "Z"}, "o.ktx2"));
}

}  // namespace
}  // namespace welkin
