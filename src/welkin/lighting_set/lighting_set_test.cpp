#include "welkin/lighting_set/lighting_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "welkin/base/error.h"
#include "welkin/brdf/engine_tables.h"
#include "welkin/harmonics/coefficients_file.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/lighting_set/manifest.h"
#include "welkin/lighting_set/page.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/sphere/convention.h"
#include "welkin/synth/render_synth.h"
#include "welkin/synth/synth.h"

namespace welkin {
namespace {

const Map& room() {
  static const Map map = render(synth::make("room"), sphere::AnyParameterization::make("latlong"), 64, 32);
  return map;
}

/// Small, so that every engine's set is made quickly.
SetOptions small(const Engine& engine) {
  SetOptions options;
  for (const SetFile& file : engine.files) {
    if (file.content == SetContent::specular && engine.limits.fewest_levels == 1) options.width = 16;
  }
  return options;
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class EveryEngine : public testing::TestWithParam<std::string> {
 protected:
  const Engine& engine() const { return engine_from_name(GetParam()); }
};

TEST_P(EveryEngine, HasFilesOfDifferentNamesThatCanBeMade) {
  const std::vector<SetFile> files = set_files(engine());
  std::set<std::string> names;
  for (const SetFile& file : files) {
    EXPECT_TRUE(names.insert(file.name).second) << file.name;
    EXPECT_FALSE(file.about.empty()) << file.name;
    EXPECT_NO_THROW(convention_from_name(file.convention));
  }
  EXPECT_FALSE(files.empty());
  EXPECT_FALSE(engine().source.empty());
}

TEST_P(EveryEngine, ItsFilesReadBackAndAreNamedInTheManifestAndOnThePage) {
  const LightingSet set = make_lighting_set(room(), engine(), small(engine()));
  const SetRequest request{"welkin bake a'b.hdr <out>/", "a<b.hdr", "latlong", 64, 32, 1e-3, {}};
  const std::string manifest = manifest_text(set, request), page = page_text(set, request);
  ASSERT_EQ(set.files.size(), engine().files.size());
  for (const MadeFile& file : set.files) {
    EXPECT_NE(manifest.find("\"" + file.made.name + "\""), std::string::npos) << file.made.name;
    EXPECT_NE(page.find("<code>" + file.made.name + "</code>"), std::string::npos) << file.made.name;
    EXPECT_GT(file.bytes.size(), 100u) << file.made.name;
    if (file.levels.empty() || file.made.content == SetContent::atlas) continue;
    ReadMapOptions options;
    options.shape = file.made.to;
    options.join_faces = false;
    const Chain chain = read_chain(file.bytes, file.made.name, options);
    ASSERT_EQ(chain.levels.size(), file.levels.size()) << file.made.name;
    EXPECT_EQ(chain.levels[0].width(), file.levels[0].size.width);
    // RGBD and BC6H among them.
    for (const SetLevel& level : file.levels) EXPECT_LT(level.stored.rmsle(), 0.05) << file.made.name;
  }
  EXPECT_FALSE(set.specular.levels.empty());
  EXPECT_EQ(page.find("a<b.hdr"), std::string::npos);
  EXPECT_NE(page.find("a&lt;b.hdr"), std::string::npos);
  EXPECT_EQ(page.find("http:"), std::string::npos) << "the page needs a network";
  EXPECT_EQ(page.find("https:"), std::string::npos) << "the page needs a network";
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Engine& engine : engines()) all.push_back(engine.name);
  return all;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(LightingSet, EveryEngine, testing::ValuesIn(names()), test_name);

TEST(LightingSet, WhatAnEngineCantLoadIsRefusedWithItsReason) {
  const Engine& engine = engine_from_name("filament");
  EXPECT_NE(message_of([&] { set_files(engine, {.levels = 9}); }).find("five levels"), std::string::npos);
  EXPECT_NE(message_of([&] { set_files(engine, {.type = "bc6h"}); }).find("half and float"),
            std::string::npos);
  EXPECT_NE(message_of([&] { set_files(engine, {.width = 100}); }).find("power of two"), std::string::npos);
  EXPECT_NE(
      message_of([&] { set_files(engine_from_name("godot"), {.width = 64}); }).find("filters a panorama"),
      std::string::npos);
  EXPECT_NE(message_of([] { engine_from_name("filement"); }).find("filament"), std::string::npos);
}

TEST(LightingSet, OptionsOverrideTheEnginesData) {
  SetOptions options;
  options.width = 32;
  options.levels = 3;
  options.curve = lobe::RoughnessCurve::from_name("unity");
  options.type = "rgb9e5";
  options.convention = "unity";
  const std::vector<SetFile> files = set_files(engines().front(), options);
  EXPECT_EQ(files[0].width, 32);
  EXPECT_EQ(files[0].levels, 3);
  EXPECT_EQ(files[0].curve, "unity");
  EXPECT_EQ(files[0].type, "rgb9e5");
  for (const SetFile& file : files) {
    if (file.content != SetContent::table) {
      EXPECT_EQ(file.convention, "unity") << file.name;
    }
  }
}

TEST(LightingSet, FacesAreHalvedUntilTheFileIsSmallEnough) {
  SetOptions options;
  options.width = 64;
  options.most_bytes = 3000;
  const LightingSet set = make_lighting_set(room(), engines().front(), options);
  EXPECT_LE(set.files[0].bytes.size(), 3000u);
  EXPECT_LT(set.files[0].made.width, 64);
  EXPECT_FALSE(set.warnings.empty());
  options.most_bytes = 10;
  EXPECT_NE(message_of([&] { make_lighting_set(room(), engines().front(), options); }).find("more than 10"),
            std::string::npos);
}

TEST(LightingSet, ItsMapsAreThoseOfBake) {
  SetOptions options;
  options.width = 16;
  options.type = "half";
  options.exposure = 2;
  const LightingSet set = make_lighting_set(room(), engines().front(), options);
  BakeOptions bake_options;
  bake_options.size = ChartSize{16, 16};
  const Chain chain = bake(room(), bake_options);
  ASSERT_EQ(set.specular.levels.size(), chain.levels.size());
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    const float ours = set.specular.levels[i].level.chart(2).at(0, 0)[1],
                wanted = chain.levels[i].level.chart(2).at(0, 0)[1];
    // Half floats have 11 bits.
    EXPECT_NEAR(ours, 2 * wanted, 2 * wanted / 2048) << i;
    EXPECT_EQ(set.files[0].levels[i].roughness, chain.notes.roughness[i]);
  }
}

TEST(LightingSet, ItsHarmonicsAreNowhereNegativeAndKeepTheMean) {
  Map sun(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int c = 0; c < 3; ++c) sun.level.chart(0).at(20, 9)[c] = 1000;
  const LightingSet set = make_lighting_set(sun, engines().front(), small(engines().front()));
  const harmonics::CoefficientsFile file = harmonics::parse_coefficients(
      {reinterpret_cast<const char*>(set.files[3].bytes.data()), set.files[3].bytes.size()}, "h.json");
  const harmonics::SphericalHarmonics light = harmonics_of(file);
  EXPECT_NEAR(light.at(0, 0, 0), set.light.at(0, 0, 0), 1e-12);
  EXPECT_GT(light.at(0, 0, 0), 0);
  double least = 1e9;
  for (int i = 0; i < 2000; ++i) {
    const double z = 1 - (2 * i + 1) / 2000.0, angle = 2.399963 * i, r = std::sqrt(1 - z * z);
    double value[3];
    harmonics::convolved(light, harmonics::irradiance_factors(2))
        .evaluate({r * std::cos(angle), r * std::sin(angle), z}, value);
    least = std::min(least, value[0]);
  }
  EXPECT_GT(least, -1e-6 * light.at(0, 0, 0));
}

TEST(LightingSet, AlphaIsLeftOut) {
  Map map(sphere::AnyParameterization::make("latlong"), 16, 8, 4);
  for (int y = 0; y < 8; ++y) std::fill_n(map.level.chart(0).row(y), 64, 0.5f);
  const LightingSet set = make_lighting_set(map, engines().front(), small(engines().front()));
  EXPECT_EQ(set.specular.levels[0].level.chart(0).at(3, 3)[0], 0.5f);
}

TEST(LightingSet, VerificationIsOfTheLevelsBeforeStoring) {
  SetOptions options = small(engines().front());
  options.verified_texels = 8;
  const LightingSet set = make_lighting_set(room(), engines().front(), options);
  for (const SetLevel& level : set.files[0].levels) {
    ASSERT_TRUE(level.verification.has_value());
    EXPECT_LT(level.verification->reference.relative_rmse, 0.01);
  }
}

}  // namespace
}  // namespace welkin
