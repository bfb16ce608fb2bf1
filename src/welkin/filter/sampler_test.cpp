#include "welkin/filter/sampler.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "welkin/filter/sampler_cases.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

using namespace cases;
using sphere::AnyParameterization;

constexpr Filter kLookUpFilters[] = {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos};

std::vector<float> values_along(const Sampler& sampler, const Vec3d& direction, double level = 0) {
  std::vector<float> values(static_cast<std::size_t>(sampler.channels()));
  sampler.look_up(direction, values, level);
  return values;
}

/// Along the direction of a texel's centre every filter gives that texel, whatever the direction's length;
/// the map's orientation rotates the direction.
TEST(Sampler, GivesTexelsAtTheirCentres) {
  for (const std::string& name : sphere::parameterization_names()) {
    Map map(AnyParameterization::make(name), 16, 16, 3);
    fill_with_noise(map);
    map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
    const auto& p = map.parameterization;
    for (const Filter filter : kLookUpFilters) {
      const Sampler sampler = Sampler::borrow(map, {.filter = filter});
      const double u = 6.5 / 16, v = 5.5 / 16;
      if (!p.valid(0, u, v)) continue;
      for (const double length : {7.0, 1e-30, 1e30, 1e-300, 1e300}) {
        const Vec3d d = length * (transpose(map.orientation) * p.to_sphere(0, u, v));
        const std::vector<float> values = values_along(sampler, d);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(values[c], map.level.chart(0).at(6, 5)[c], 1e-4) << name << " " << length;
        }
      }
    }
  }
}

TEST(Sampler, IsZeroWhereTheMapShowsNothing) {
  Map map(AnyParameterization::make("fisheye-equidistant"), 8, 8, 1);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) *map.level.chart(0).at(x, y) = 5;
  }
  fill_borders(map);
  const Sampler sampler(std::move(map));
  const Vec3d directions[2] = {{0, 0.2, 1}, {0, 0.2, -1}};
  float out[2];
  sampler.look_up(directions, out);
  EXPECT_FLOAT_EQ(out[0], 5);
  EXPECT_EQ(out[1], 0);
  EXPECT_TRUE(sampler.covers(directions[0]));
  EXPECT_FALSE(sampler.covers(directions[1]));
}

/// Zero, infinite and undefined directions give 0, alone and among others, and nothing else is disturbed.
TEST(Sampler, InvalidDirectionsGiveZero) {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = NAN;
  const Vec3<float> none[] = {{0, 0, 0},          {-0.0f, 0, 0},    {kNan, 0, 0},   {0, kNan, 1},
                              {1, 1, kNan},       {kInf, 0, 0},     {0, 0, -kInf},  {kInf, kNan, 1},
                              {kInf, kInf, kInf}, {3e38f, 1, kInf}, {kNan, kInf, 0}};
  for (const std::string& name : sphere::parameterization_names()) {
    for (const bool turned : {false, true}) {
      Map map(AnyParameterization::make(name), 8, 8, 3);
      fill_with_noise(map);
      if (turned) map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
      const Sampler sampler(std::move(map));
      std::vector<Vec3<float>> mixed;
      for (const auto& d : none) {
        mixed.push_back(d);
        mixed.push_back({0.1f, 0.9f, 0.3f});
      }
      std::vector<float> values(3 * mixed.size(), -1.0f), alone(3);
      sampler.look_up(mixed, values);
      for (std::size_t i = 0; i < mixed.size(); i += 2) {
        const Vec3d wide{mixed[i].x, mixed[i].y, mixed[i].z};
        EXPECT_FALSE(sampler.covers(mixed[i]));
        EXPECT_FALSE(sampler.covers(wide));
        EXPECT_EQ(sampler.rgb(mixed[i]), (std::array<float, 3>{0, 0, 0})) << name;
        EXPECT_EQ(sampler.rgb(wide), (std::array<float, 3>{0, 0, 0})) << name;
        const std::array<float, 3> other = sampler.rgb(mixed[i + 1]);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(values[3 * i + c], 0) << name << " " << i;
          EXPECT_EQ(values[3 * i + 3 + c], other[c]) << name << " " << i;
        }
      }
    }
  }
}

/// Between two levels radiance is linear, and at a level it is that level's; a chain of the pyramid's levels
/// is the pyramid.
TEST(Sampler, BlendsLevelsLinearly) {
  for (const char* name : {"cube", "latlong", "openexr-latlong", "openexr-cube"}) {
    Map map = make_map(name, 32, 3);
    fill_with_noise(map);
    const Sampler sampler = Sampler::borrow(map, {.levels = 0});
    ASSERT_EQ(sampler.levels(), levels_below(map.width(), map.height()) + 1);
    std::vector<Level> pyramid = make_pyramid(map, 2);
    std::vector<Map> levels;
    for (Level& level : pyramid) {
      levels.push_back(make_map(name, 1, 3));
      levels.back().parameterization = map.parameterization;
      levels.back().level = std::move(level);
    }
    for (const Vec3d& d : {Vec3d{1, 2, 3}, {-1, 0.1, 0.3}, {0, -1, 0}}) {
      std::vector<float> at[3];
      for (int k = 0; k < 3; ++k) {
        const Map& level = k == 0 ? map : levels[static_cast<std::size_t>(k - 1)];
        at[k] = values_along(Sampler::borrow(level), d);
        EXPECT_EQ(values_along(sampler, d, k), at[k]) << name << " " << k;
      }
      const std::vector<float> between = values_along(sampler, d, 1.25);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(between[c], 0.75f * at[1][c] + 0.25f * at[2][c], 1e-6) << name;
      }
    }
  }
}

TEST(Sampler, LooksUpTheLevelsOfAChain) {
  for (const char* name : {"cube", "openexr-latlong"}) {
    const auto chain = std::make_shared<Chain>();
    for (int k = 0; k < 4; ++k) {
      Map level = make_map(name, 32 >> k, 2);
      fill_with_noise(level);
      level.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
      chain->levels.push_back(std::move(level));
    }
    const Sampler sampler{std::shared_ptr<const Chain>(chain)};
    ASSERT_EQ(sampler.levels(), 4);
    const Vec3d d{1, 2, 3};
    for (int k = 0; k < 4; ++k) {
      const Sampler one = Sampler::borrow(chain->levels[static_cast<std::size_t>(k)]);
      EXPECT_EQ(values_along(sampler, d, k), values_along(one, d)) << name;
    }
    const auto a = values_along(sampler, d, 1), b = values_along(sampler, d, 2);
    const auto between = values_along(sampler, d, 1.5);
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(between[c], 0.5f * (a[c] + b[c]), 1e-6) << name;
  }
}

TEST(Sampler, RefusesWhatItCannotDo) {
  const auto map = std::make_shared<const Map>(make_map("cube", 4, 3));
  const Sampler sampler(map, {.levels = 2});
  const Vec3<float> d{0, 1, 0};
  const std::vector<Vec3<float>> two{d, d};
  std::vector<float> room(6);
  const auto fails = [](const std::function<void()>& work, const std::string& part) {
    const std::string message = refusal(work);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  fails([&] { sampler.look_up(d, std::span(room).first(2)); }, "room for 2 values");
  fails([&] { sampler.look_up(Vec3d{0, 1, 0}, std::span(room).first(2)); }, "room for 2 values");
  fails([&] { sampler.look_up(two, std::span(room).first(5)); }, "room for 5 values");
  for (const double level : {-0.01, 1.01, 1e300, static_cast<double>(NAN)}) {
    fails([&] { sampler.look_up(d, room, level); }, "there are 0 to 1");
    fails([&] { sampler.look_up(two, room, level); }, "there are 0 to 1");
    fails([&] { sampler.rgb(d, level); }, "there are 0 to 1");
    const std::vector<float> levels{0, static_cast<float>(level)};
    fails([&] { sampler.look_up(two, room, levels); }, "there are 0 to 1");
  }
  fails([&] { sampler.look_up(two, room, std::vector<float>{0}); }, "1 levels");
  fails([&] { sampler.look_up(DirectionArrays{room, room, std::span(room).first(1)}, room); }, "length");
  fails([&] { Sampler(make_map("cube", 4, 2)).rgb(d); }, "R, G and B");
  fails([&] { Sampler(std::shared_ptr<const Map>()); }, "no map");
  fails([&] { Sampler(std::shared_ptr<const Chain>()); }, "no levels");
  fails([&] { Sampler(Chain{}); }, "no levels");
  fails([&] { Sampler(map, {.levels = -1}); }, "-1 levels");
  const auto chain_of = [](const char* coarser, int channels) {
    Chain chain;
    chain.levels.push_back(make_map("cube", 4, 3));
    chain.levels.push_back(make_map(coarser, 2, channels));
    return chain;
  };
  fails([&] { Sampler{chain_of("cube", 1)}; }, "channels");
  fails([&] { Sampler{chain_of("latlong", 3)}; }, "parameterization");
  EXPECT_EQ(refusal([&] { sampler.look_up(two, room); }), "done");
  EXPECT_EQ(refusal([&] { sampler.look_up(std::span<const Vec3d>(), {}); }), "done");
}

/// Results of a batch end where they are said to, at any count, for any number of channels.
TEST(Sampler, WritesNoMoreThanItsResults) {
  for (const int channels : {1, 2, 3, 4, 5, 7, kMaxChannels}) {
    Map map = make_map("cube", 8, channels);
    fill_with_noise(map);
    const Sampler sampler(std::move(map), {.levels = 2});
    for (const std::size_t count : {0u, 1u, 7u, 8u, 16u, 17u, 255u, 256u, 257u, 600u}) {
      std::vector<Vec3<float>> directions(count, {0.3f, -0.2f, 0.9f});
      const std::vector<float> levels(count, 0.5f);
      const std::size_t results = count * static_cast<std::size_t>(channels);
      for (int way = 0; way < 3; ++way) {
        std::vector<float> values(results + 64, -7.0f);
        if (way == 0) sampler.look_up(directions, values);
        if (way == 1) sampler.look_up(directions, values, 0.5);
        if (way == 2) sampler.look_up(directions, values, levels);
        for (std::size_t i = 0; i < values.size(); ++i) {
          ASSERT_EQ(values[i] == -7.0f, i >= results) << channels << " " << count << " " << way << " " << i;
        }
      }
    }
  }
}

TEST(Sampler, ManyThreadsAgree) {
  Map map = make_map("octahedral", 64, 3);
  fill_with_noise(map);
  const Sampler sampler(std::move(map), {.filter = Filter::bicubic, .levels = 0});
  const std::vector<Vec3<float>> directions = random_directions(5000);
  const std::vector<float> levels = random_levels(sampler, directions.size());
  std::vector<float> expected(3 * directions.size());
  sampler.look_up(directions, expected, levels);
  std::vector<std::vector<float>> results(4, std::vector<float>(expected.size()));
  std::vector<std::thread> threads;
  for (auto& result : results) {
    threads.emplace_back([&result, &directions, &levels, copy = sampler] {
      for (std::size_t i = 0; i < directions.size(); ++i) {
        copy.look_up(directions[i], std::span(result).subspan(3 * i, 3), static_cast<double>(levels[i]));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected);
}

}  // namespace
}  // namespace welkin
