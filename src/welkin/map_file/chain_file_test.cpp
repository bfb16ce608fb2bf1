#include "welkin/map_file/chain_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "welkin/base/error.h"
#include "welkin/map/chain.h"
#include "welkin/map/map_cases.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
using cases::refusal;
using sphere::AnyParameterization;

class ChainFile : public testing::Test {
 protected:
  ChainFile() : folder_(fs::temp_directory_path() / ("welkin_chain_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~ChainFile() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  fs::path folder_;
};

/// Levels whose every value is different.
Chain numbered(const std::string& spec, ChartSize finest, int levels, int channels = 3) {
  Chain chain;
  float next = 1;
  for (int k = 0; k < levels; ++k) {
    const ChartSize size = chain_size(finest, k);
    Map& map = chain.levels.emplace_back(AnyParameterization::make(spec), size.width, size.height, channels);
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < size.height; ++y) {
        for (int i = 0; i < size.width * channels; ++i) map.level.chart(chart).row(y)[i] = next++;
      }
    }
  }
  return chain;
}

/// Of valid texels; reading fills the others.
void expect_same(const Map& a, const Map& b) {
  ASSERT_EQ(a.parameterization.spec(), b.parameterization.spec());
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  ASSERT_EQ(a.channel_names, b.channel_names);
  ASSERT_EQ(a.orientation, b.orientation);
  cases::for_each_valid_texel(a, [&](int chart, int x, int y) {
    for (int c = 0; c < a.channels(); ++c) {
      ASSERT_EQ(a.level.chart(chart).at(x, y)[c], b.level.chart(chart).at(x, y)[c])
          << a.parameterization.spec() << " chart " << chart << " texel " << x << ", " << y;
    }
  });
}

void expect_same(const Chain& a, const Chain& b) {
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t k = 0; k < a.levels.size(); ++k) expect_same(a.levels[k], b.levels[k]);
  EXPECT_EQ(a.notes, b.notes);
}

TEST(Chain, LevelsHalveDownToOneTexel) {
  const auto expect_size = [](ChartSize finest, int level, int width, int height) {
    const ChartSize size = chain_size(finest, level);
    EXPECT_EQ(size.width, width);
    EXPECT_EQ(size.height, height);
  };
  expect_size({256, 256}, 0, 256, 256);
  expect_size({256, 256}, 8, 1, 1);
  expect_size({21, 10}, 1, 10, 5);
  expect_size({21, 10}, 4, 1, 1);
  EXPECT_EQ(max_levels({256, 256}), 9);
  EXPECT_EQ(max_levels({255, 10}), 8);
  EXPECT_EQ(max_levels({1, 1}), 1);
}

TEST(Chain, NotesComeBackFromTheirText) {
  const ChainNotes notes{"ggx", {0, 0.125, 1.0 / 3, 1}, "linear", "radiance", "welkin 1"};
  EXPECT_EQ(chain_notes_from(attributes_of(notes)), notes);
  EXPECT_EQ(attributes_of(notes).at("welkin.roughness").substr(0, 8), "0,0.125,");
  EXPECT_TRUE(attributes_of({}).empty());
  EXPECT_TRUE(chain_notes_from({}).empty());
  EXPECT_EQ(notes.of_level(1).roughness, std::vector<double>{0.125});
  EXPECT_TRUE(notes.of_level(7).roughness.empty());
  EXPECT_EQ(notes.roughness_of(3), 1);
  EXPECT_EQ(notes.roughness_of(4), std::nullopt);
}

TEST(Chain, DamagedNotesAreNone) {
  for (const std::string text :
       {"", ",", "nonsense", "0,1,x", "0,nan", "inf", "-1", "0,,1", "1e999", " 1", "0;1"}) {
    EXPECT_TRUE(chain_notes_from({{"welkin.roughness", text}}).roughness.empty()) << text;
  }
  std::string long_list = "0";
  for (int i = 0; i < 1000; ++i) long_list += ",0";
  EXPECT_TRUE(chain_notes_from({{"welkin.roughness", long_list}}).roughness.empty());
}

TEST_F(ChainFile, EveryParameterizationComesBackFromItsOwnMetadata) {
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    Chain chain = numbered(name, {16, 16}, 4);
    chain.notes = {"ggx", {0, 0.25, 0.5, 1}, "linear", "radiance", "test"};
    for (const char* extension : {".ktx2", ".exr"}) {
      for (const Layout& layout : layouts_of(p)) {
        const bool exr = extension == std::string(".exr");
        if (layout.kind == LayoutKind::files || (exr && layout.kind == LayoutKind::layers)) continue;
        const fs::path path = file(name + extension);
        write_chain(path, chain, layout);
        MapReader reader(path);
        EXPECT_EQ(reader.info().reason, "declared by the file");
        EXPECT_EQ(reader.info().shape->layout.name, layout.name);
        expect_same(chain, read_chain(reader));
      }
    }
  }
}

TEST_F(ChainFile, OddSizesOrientationsAndFacesComeBack) {
  for (const ChartSize size : {ChartSize{1, 1}, ChartSize{3, 3}, ChartSize{13, 13}, ChartSize{96, 96}}) {
    Chain chain = numbered("cube", size, max_levels(size));
    for (Map& map : chain.levels) map.orientation = convention_from_name("unreal").lookup;
    write_chain(file("odd.ktx2"), chain, parse_map_shape("cube:layers").layout);
    expect_same(chain, read_chain(file("odd.ktx2")));
    WriteMapOptions options;
    options.faces = "nz:90,px,ny:180,py:mirror,nx,pz:270";
    write_chain(file("odd.ktx2"), chain, parse_map_shape("cube:layers").layout, options);
    expect_same(chain, read_chain(file("odd.ktx2")));
  }
  for (const char* extension : {"ktx2", "exr"}) {
    const fs::path path = file(std::string("odd.") + extension);
    for (const ChartSize size : {ChartSize{1, 1}, ChartSize{21, 17}, ChartSize{64, 1}, ChartSize{5, 100}}) {
      const Chain chain = numbered("latlong", size, max_levels(size));
      write_chain(path, chain, parse_map_shape("latlong").layout);
      expect_same(chain, read_chain(path));
    }
    const Chain chain = numbered("octahedral", {8, 8}, 3, 4);
    write_chain(path, chain, parse_map_shape("octahedral").layout);
    expect_same(chain, read_chain(path));
  }
}

TEST_F(ChainFile, OneLevelAloneGoesIntoAnyFormat) {
  Chain chain = numbered("cube", {8, 8}, 1);
  chain.notes.lobe = "lambert";
  for (const char* name : {"one.exr", "one.ktx2", "one.pfm"}) {
    write_chain(file(name), chain, default_layout(chain.levels[0].parameterization, name));
    ReadMapOptions options;
    options.shape = parse_map_shape_for(name, "cube").text();
    const LoadedMap back = read_map(file(name), options);
    expect_same(chain.levels[0], back.map);
    EXPECT_EQ(back.info.levels.size(), 1u);
    EXPECT_EQ(back.info.notes.lobe, name == std::string("one.pfm") ? "" : "lambert");
  }
}

TEST_F(ChainFile, LevelsAreReadOneByOne) {
  const Chain chain = numbered("cube", {16, 16}, 5);
  for (const char* name : {"chain.ktx2", "chain.exr"}) {
    write_chain(file(name), chain, default_layout(chain.levels[0].parameterization, name, 5));
    ReadMapOptions options;
    for (options.level = 0; options.level < 5; ++options.level) {
      const LoadedMap back = read_map(file(name), options);
      expect_same(chain.levels[static_cast<std::size_t>(options.level)], back.map);
      EXPECT_EQ(back.info.levels.size(), 5u);
    }
    EXPECT_NE(refusal([&] { read_map(file(name), options); }).find("has levels 0…4, not 5"),
              std::string::npos);
    // A level that isn't there leaves the reader as it was.
    MapReader reader(file(name));
    reader.set_level(2);
    EXPECT_NE(refusal([&] { reader.set_level(9); }).find("not 9"), std::string::npos);
    expect_same(chain.levels[2], reader.read());
  }
  write_map(file("plain.exr"), chain.levels[0], parse_map_shape("cube").layout);
  ReadMapOptions options;
  options.level = 1;
  EXPECT_NE(refusal([&] { read_map(file("plain.exr"), options); }).find("has one level, not level 1"),
            std::string::npos);
}

TEST_F(ChainFile, NotesThatDontFitTheLevelsAreTolerated) {
  Chain chain = numbered("latlong", {16, 8}, 4);
  for (const std::vector<double>& roughness : {std::vector<double>{0.5}, std::vector<double>(12, 1.0)}) {
    chain.notes.roughness = roughness;
    write_chain(file("notes.ktx2"), chain, parse_map_shape("latlong").layout);
    const Chain back = read_chain(file("notes.ktx2"));
    expect_same(chain, back);
    EXPECT_EQ(back.notes.roughness_of(3).has_value(), roughness.size() > 3);
  }
}

TEST(Chain, RefusesWhatAFileCannotHold) {
  const auto message = [](const fs::path& path, const char* shape, ChartSize size, int levels,
                          int border = 0) {
    WriteMapOptions options;
    options.border = border;
    return refusal(
        [&] { check_chain(path, parse_map_shape_for(path, shape, levels), size, levels, options); });
  };
  const auto expect_part = [](const std::string& whole, const char* part) {
    EXPECT_NE(whole.find(part), std::string::npos) << whole;
  };
  EXPECT_EQ(message("a.hdr", "cube", {96, 96}, 1), "done");
  EXPECT_EQ(message("a.KTX2", "cube", {96, 96}, 7), "done");
  EXPECT_EQ(message("a.exr", "cube", {96, 96}, 6), "done");
  EXPECT_EQ(message("a.exr", "latlong", {97, 13}, 7), "done");
  EXPECT_EQ(message("a.ktx2", "healpix", {13, 13}, 4), "done");
  expect_part(message("a.hdr", "cube", {96, 96}, 2), "a.hdr: holds one level, not 2");
  expect_part(message("a.exr", "cube", {96, 96}, 7),
              "a.exr: cube:vstrip of charts of 96x96 can be halved to 6 levels only, not 7");
  expect_part(message("a.ktx2", "cube:hcross", {13, 13}, 2), "can be halved to 1 levels only");
  expect_part(message("a.ktx2", "cube", {16, 16}, 6), "charts of 16x16 have 5 levels, not 6");
  expect_part(message("a.ktx2", "cube", {16, 16}, 5, 2), "no safety border");
  expect_part(message("a.exr", "cube:layers", {16, 16}, 5), "an EXR of several parts holds no levels");
  expect_part(message("a_%s.ktx2", "cube:faces", {16, 16}, 5), "go into one file");
}

}  // namespace
}  // namespace welkin
