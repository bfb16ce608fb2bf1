#include "welkin/map_file/view_chains_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class ViewChainsFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path path(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("welkin-views-" + std::to_string(::getpid()));
};

/// Texels that tell view, level, chart and position.
Map numbered(const std::string& shape, ChartSize size, int number) {
  Map map(sphere::AnyParameterization::make(shape), size.width, size.height, 3);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        float* texel = map.level.chart(chart).at(x, y);
        texel[0] = static_cast<float>(number);
        texel[1] = static_cast<float>(chart * 100 + y);
        texel[2] = static_cast<float>(x);
      }
    }
  }
  fill_borders(map);
  return map;
}

Chain chain_of(const std::string& shape, ChartSize size, int levels, int first) {
  Chain chain;
  for (int k = 0; k < levels; ++k) chain.levels.push_back(numbered(shape, chain_size(size, k), first + k));
  chain.notes.lobe = "brdf ggx";
  chain.notes.roughness.assign(static_cast<std::size_t>(levels), 0.5);
  return chain;
}

ViewChains stack_of(const std::string& shape, ChartSize size, int views, int levels) {
  ViewChains stack;
  stack.notes = {"ggx,f0=0.04", "fitted", default_view_cosines(views), {levels, {}}, {levels, {}}};
  for (int view = 0; view < views; ++view) {
    stack.views.push_back(chain_of(shape, size, levels, 10 * view));
    for (int k = 0; k < levels; ++k) {
      stack.notes.lift.values.push_back(0.25 * view - 0.125 * k);
      stack.notes.albedo.values.push_back(1.0 / (1 + view + k));
    }
  }
  return stack;
}

void expect_same(const Map& a, const Map& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.charts(), b.charts());
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      for (int i = 0; i < a.width() * 3; ++i)
        ASSERT_EQ(a.level.chart(chart).row(y)[i], b.level.chart(chart).row(y)[i]);
    }
  }
}

TEST_F(ViewChainsFile, StacksComeBack) {
  struct Case {
    std::string name, shape;
    ChartSize size;
    int views, levels;
  };
  for (const Case& c :
       {Case{"cube.ktx2", "cube", {8, 8}, 3, 4}, Case{"latlong.ktx2", "latlong", {16, 8}, 5, 3},
        Case{"paraboloid.ktx2", "paraboloid", {8, 8}, 2, 2}, Case{"one.ktx2", "cube", {4, 4}, 1, 3},
        Case{"latlong.exr", "latlong", {16, 8}, 3, 1}, Case{"cube.exr", "cube", {8, 8}, 3, 1},
        Case{"octahedral.exr", "octahedral", {8, 8}, 2, 1}}) {
    SCOPED_TRACE(c.name);
    const ViewChains stack = stack_of(c.shape, c.size, c.views, c.levels);
    write_view_chains(path(c.name), stack);
    const ViewChains read = read_view_chains(path(c.name));
    EXPECT_EQ(read.notes, stack.notes);
    ASSERT_EQ(read.views.size(), stack.views.size());
    for (std::size_t view = 0; view < read.views.size(); ++view) {
      EXPECT_EQ(read.views[view].notes, stack.views[view].notes);
      ASSERT_EQ(read.views[view].levels.size(), stack.views[view].levels.size());
      for (std::size_t k = 0; k < read.views[view].levels.size(); ++k)
        expect_same(read.views[view].levels[k], stack.views[view].levels[k]);
    }
  }
}

/// What other programs see: layers of a cube array, all with their levels.
TEST_F(ViewChainsFile, ViewsAreLayersOfATexture) {
  write_view_chains(path("cube.ktx2"), stack_of("cube", {8, 8}, 3, 4));
  const io::FileInfo info = io::open(path("cube.ktx2"))->info();
  EXPECT_EQ(info.layers, 3);
  EXPECT_EQ(info.faces, 6);
  EXPECT_EQ(info.levels, 4);
  // Read as a map, it is its first angle of view.
  expect_same(read_map(path("cube.ktx2")).map, numbered("cube", {8, 8}, 0));
}

TEST_F(ViewChainsFile, WhatCannotBeWritten) {
  const auto kind = [&](const std::string& name, const ViewChains& stack) {
    try {
      write_view_chains(path(name), stack);
    } catch (const Error& error) {
      EXPECT_FALSE(fs::exists(path(name)));
      return error.kind();
    }
    ADD_FAILURE() << name << " was written";
    return ErrorKind::system;
  };
  const ViewChains stack = stack_of("cube", {8, 8}, 2, 3);
  EXPECT_EQ(kind("stack.exr", stack), ErrorKind::unsupported);
  EXPECT_EQ(kind("stack.png", stack), ErrorKind::unsupported);
  ViewChains other = stack_of("cube", {8, 8}, 2, 3);
  other.notes.lift.values.pop_back();
  EXPECT_EQ(kind("stack.ktx2", other), ErrorKind::mismatch);
  other = stack_of("cube", {8, 8}, 2, 3);
  other.notes.view_cosines[1] = other.notes.view_cosines[0];
  EXPECT_EQ(kind("stack.ktx2", other), ErrorKind::mismatch);
  other = stack_of("cube", {8, 8}, 2, 3);
  other.views[1] = chain_of("cube", {4, 4}, 3, 0);
  EXPECT_EQ(kind("stack.ktx2", other), ErrorKind::mismatch);
}

template <class Read>
ErrorKind kind_of_reading(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "was read";
  return ErrorKind::system;
}

TEST_F(ViewChainsFile, WhatIsNoStack) {
  const Chain chain = chain_of("cube", {8, 8}, 3, 0);
  write_chain(path("chain.ktx2"), chain);
  EXPECT_EQ(kind_of_reading([&] { read_view_chains(path("chain.ktx2")); }), ErrorKind::unsupported);
  EXPECT_EQ(kind_of_reading([&] { read_lobe_sums(path("chain.ktx2")); }), ErrorKind::unsupported);
  // Notes of a stack on a file that is none, and notes that are not numbers.
  const auto with = [&](std::map<std::string, std::string> notes) {
    WriteMapOptions options;
    options.image.attributes = std::move(notes);
    write_chain(path("notes.ktx2"), chain, options);
    return kind_of_reading([&] { read_view_chains(path("notes.ktx2")); });
  };
  EXPECT_EQ(with({{"welkin.view-cosines", "0.5"}}), ErrorKind::damaged);
  EXPECT_EQ(with({{"welkin.view-cosines", "0.5,x"}, {"welkin.view-lift", "0"}, {"welkin.view-albedo", "1"}}),
            ErrorKind::damaged);
  EXPECT_EQ(with({{"welkin.view-cosines", "0.5"}, {"welkin.view-lift", "0"}, {"welkin.view-albedo", "1"}}),
            ErrorKind::damaged);
  EXPECT_NE(with({{"welkin.view-cosines", "0.25,0.5"},
                  {"welkin.view-lift", "0,0,0,0,0,0"},
                  {"welkin.view-albedo", "1,1,1,1,1,1"}}),
            ErrorKind::system);
}

LobeSumChain sums_of(int views, int roughnesses, int count) {
  LobeSumChain made{chain_of("cube", {8, 8}, 3, 0), {}};
  made.sums.brdf = "ggx";
  made.sums.view_cosines = default_view_cosines(views);
  for (int k = 0; k < roughnesses; ++k) made.sums.roughness.push_back(0.125 * k);
  made.sums.count = count;
  for (int i = 0; i < views * roughnesses * count; ++i)
    made.sums.look_ups.push_back({0.125 * i, i % 5 * 0.5, -0.25 * i});
  made.sums.albedo = {roughnesses, std::vector<double>(static_cast<std::size_t>(views * roughnesses), 0.75)};
  return made;
}

TEST_F(ViewChainsFile, SumsComeBackAsAnOrdinaryChain) {
  const LobeSumChain made = sums_of(3, 2, 4);
  for (const char* name : {"sums.ktx2", "sums.exr"}) {
    SCOPED_TRACE(name);
    write_lobe_sums(path(name), made);
    const LobeSumChain read = read_lobe_sums(path(name));
    EXPECT_EQ(read.sums, made.sums);
    const Chain chain = read_chain(path(name));
    ASSERT_EQ(chain.levels.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) expect_same(chain.levels[k], made.chain.levels[k]);
    EXPECT_EQ(chain.notes, made.chain.notes);
  }
  LobeSumChain bad = sums_of(3, 2, 4);
  bad.sums.look_ups[2].level = 7;
  EXPECT_EQ(kind_of_reading([&] { write_lobe_sums(path("bad.ktx2"), bad); }), ErrorKind::mismatch);
  WriteMapOptions options;
  options.image.attributes = {{"welkin.lobes-cosines", "0.5"}, {"welkin.lobes-roughness", "0.5"},
                              {"welkin.lobes-weight", "1"},    {"welkin.lobes-level", "9"},
                              {"welkin.lobes-lift", "0"},      {"welkin.lobes-albedo", "1"}};
  write_chain(path("level.ktx2"), made.chain, options);
  EXPECT_EQ(kind_of_reading([&] { read_lobe_sums(path("level.ktx2")); }), ErrorKind::damaged);
  options.image.attributes["welkin.lobes-lift"] = "0,0";
  write_chain(path("sizes.ktx2"), made.chain, options);
  EXPECT_EQ(kind_of_reading([&] { read_lobe_sums(path("sizes.ktx2")); }), ErrorKind::damaged);
}

}  // namespace
}  // namespace welkin
