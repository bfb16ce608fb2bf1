// The library's face as a whole: a parameterization that only this test knows, files in memory, and every
// precondition that a caller can break.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "welkin/welkin.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// A lat-long of another name, turned by an eighth: no code can know it by name.
struct Turned {
  static constexpr const char* kName = "test-turned";
  static constexpr int kCharts = 1;
  static constexpr sphere::Traits kTraits{
      .projection = sphere::Projection::panorama, .density_by_row = true, .free_aspect = true};
  double tilt = 45;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("tilt", tilt, 0.0, 90.0, "degrees");
  }
  double aspect() const { return 2; }
  double coverage() const { return 4 * kPi; }
  template <class T>
  T angle() const {
    return static_cast<T>(tilt * kPi / 180);
  }
  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T a = static_cast<T>(2 * kPi) * (T(0.5) - u) + angle<T>(), b = static_cast<T>(kPi) * v;
    return {std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a)};
  }
  template <class T>
  sphere::ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T a = std::atan2(d.x, d.z) - angle<T>();
    const T turns = T(0.5) - a / static_cast<T>(2 * kPi);
    return {T(0), turns - std::floor(turns),
            std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y) / static_cast<T>(kPi)};
  }
  template <class T>
  T solid_angle_density(int, T, T v) const {
    return static_cast<T>(2 * kPi * kPi) * std::sin(static_cast<T>(kPi) * v);
  }
  template <class T>
  bool valid(int, T, T) const {
    return true;
  }
  template <class T>
  bool covers(const Vec3<T>&) const {
    return true;
  }
};

const AnyParameterization& turned() {
  static const AnyParameterization p = sphere::register_parameterization<Turned>();
  return p;
}

Map room(const AnyParameterization& p, int width, int height) {
  return render(synth::make("room"), p, width, height);
}

/// Converted, baked, measured, plotted, written and read, by its name and with its parameter.
TEST(Library, WorksOnAParameterizationThatItDoesNotKnow) {
  const auto latlong = AnyParameterization::make("latlong");
  const AnyParameterization& upright = turned();  // registered before it is asked for by name
  EXPECT_EQ(AnyParameterization::make("test-turned,tilt=30").spec(), upright.spec() + ",tilt=30");
  EXPECT_FALSE(AnyParameterization::make("test-turned,tilt=30") == upright);

  const Map original = room(latlong, 128, 64);
  Map there(turned(), 128, 64, 3), back(latlong, 128, 64, 3);
  resample(original, there);
  resample(there, back);
  EXPECT_LT(compare(original, back).all.relative_rmse, 0.03);
  EXPECT_NEAR(measure(there).channels[0].mean / measure(original).channels[0].mean, 1, 1e-3);

  // By traits: a panorama is turned by conventions as lat-longs are.
  const Convention& blender = convention_from_name("blender");
  EXPECT_TRUE(orientation_for(blender, turned()) == blender.latlong);

  // A bake of it is the bake of the same world.
  BakeOptions options;
  options.lobe = lobe::AnyLobe::make("ggx,roughness=0.5");
  options.chain = false;
  options.size = {16, 16};
  const Chain ours = bake(there, options), theirs = bake(original, options);
  EXPECT_LT(compare(theirs.levels[0], ours.levels[0]).all.relative_rmse, 2e-3);
  EXPECT_NEAR(density_of(turned(), 64).limit_maximum, kPi / 2, 1e-6);
  EXPECT_FALSE(draw_density(turned(), density_of(turned(), 64)).empty());

  for (const char* format : {"exr", "ktx2", "png"}) {
    io::MemorySink sink;
    write_map(sink, format, there);
    const LoadedMap read = read_map(sink.bytes(), "there");
    EXPECT_TRUE(read.map.parameterization == turned()) << format;
    EXPECT_EQ(read.info.reason, "declared by the file") << format;
  }
}

TEST(Library, FilesInMemoryAreTheFiles) {
  const Chain chain = bake(room(AnyParameterization::make("latlong"), 64, 32), {.size = ChartSize{32, 32}});
  io::MemorySink sink;
  write_chain(sink, "ktx2", chain);
  const Chain read = read_chain(sink.bytes(), "chain");
  ASSERT_EQ(read.levels.size(), chain.levels.size());
  EXPECT_TRUE(read.notes == chain.notes);
  for (std::size_t k = 0; k < chain.levels.size(); ++k)
    EXPECT_EQ(compare(chain.levels[k], read.levels[k]).all.relative_rmse, 0) << k;
  MapReader reader(sink.bytes(), "chain");
  EXPECT_EQ(reader.read(3).width(), 4);
  EXPECT_EQ(reader.read().width(), 32);
}

/// A constant map is constant at every edge, whoever made it.
TEST(Library, WhoeverMakesAMapFillsItsBorders) {
  const auto constant = [](const Vec3d&) { return std::array<float, 3>{1, 1, 1}; };
  const Map source = render(constant, AnyParameterization::make("latlong"), 32, 16);
  for (const char* name : {"cube", "octahedral", "healpix", "paraboloid", "angular"}) {
    const auto p = AnyParameterization::make(name);
    std::vector<Map> made;
    made.push_back(Map(p, 16, 16, 3));
    resample(source, made.back());
    made.push_back(
        bake(source, {.lobe = lobe::AnyLobe::make("lambert"), .target = p, .size = ChartSize{16, 16}})
            .levels.front()
            .clone());
    made.push_back(made.front().clone());
    scale(made.back(), 1);
    for (Map& map : made) {
      const Sampler sampler = Sampler::borrow(map);
      for (int i = 0; i < 400; ++i) {
        const double y = 1 - (2 * i + 1) / 400.0, r = std::sqrt(1 - y * y), a = 2.4 * i;
        const Vec3d d{r * std::cos(a), y, r * std::sin(a)};
        if (!sampler.covers(d)) continue;
        EXPECT_NEAR(sampler.rgb(d)[0], 1, 2e-3) << name;
      }
    }
  }
}

TEST(Library, OwnPixelsComeInAndGoOut) {
  const auto cube = AnyParameterization::make("cube");
  std::vector<std::uint16_t> half(6 * 4 * 4 * 3, 0x3c00);  // 1
  std::vector<Pixels> faces;
  for (int face = 0; face < 6; ++face) faces.push_back(pixels_of(half.data() + face * 48, 4, 4, 3));
  const Map map = Map::from_pixels(cube, faces);
  EXPECT_EQ(map.level.chart(5).at(3, 3)[2], 1);
  EXPECT_EQ(map.level.chart(2).at(-1, 0)[0], 1);
  std::vector<std::uint16_t> out(48);
  copy_pixels(map.level.chart(0), pixels_of(out.data(), 4, 4, 3));
  EXPECT_EQ(out[47], 0x3c00);
}

TEST(Library, ASamplerServesManyThreads) {
  const Map map = room(AnyParameterization::make("cube"), 32, 32);
  const Sampler sampler = Sampler::borrow(map);
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  const auto expected = sampler.rgb(Vec3d{1, 2, 3});
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) wrong += sampler.rgb(Vec3d{1, 2, 3}) != expected;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

/// The kind that a call is refused with; a sentence where it isn't.
std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::string(name_of(error.kind()));
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return "nothing was thrown";
}

TEST(Library, PreconditionsAreErrorsOfAKind) {
  const auto latlong = AnyParameterization::make("latlong"), cube = AnyParameterization::make("cube");
  Map map(latlong, 8, 4, 3), other(cube, 4, 4, 1);
  const Map sound = map.clone();
  Matrix3 skew;
  skew.rows[0][0] = 2;
  const io::WriteOptions options;
  io::MemorySink sink;
  std::vector<float> few(2);
  const Sampler sampler = Sampler::borrow(sound);
  struct Case {
    const char* what;
    const char* kind;
    std::function<void()> call;
  };
  const io::WritePart empty{"", {}, {"R"}};
  const io::WritePart unnamed{"", sound.level.chart(0), {"R", "G"}};
  ImageView<float> wrong_view{few.data(), 1, 1, 2, 2};
  for (const Case& c : std::initializer_list<Case>{
           {"chart of a level", "bad request", [&] { map.level.chart(1); }},
           {"chart below 0", "bad request", [&] { map.level.chart(-1); }},
           {"chart of a parameterization", "bad request", [&] { cube.to_sphere(6, 0.5, 0.5); }},
           {"density of a chart", "bad request", [&] { cube.solid_angle_density(-1, 0.5, 0.5); }},
           {"a map of no texels", "bad request", [&] { Map(latlong, 0, 4, 3); }},
           {"a map too large", "too large", [&] { Map(latlong, 1 << 21, 4, 3); }},
           {"a map of no channels", "bad request", [&] { Map(latlong, 8, 4, 0); }},
           {"channels that differ", "bad request", [&] { resample(map, other); }},
           {"onto itself", "bad request", [&] { resample(map, map); }},
           {"no rotation", "bad request",
            [&] {
              Map to(cube, 4, 4, 3);
              resample(map, to, {.rotation = skew});
            }},
           {"a map whose names are too few", "bad request",
            [&] {
              Map torn = map.clone();
              torn.channel_names.pop_back();
              scale(torn, 2);
            }},
           {"a map of other charts", "bad request",
            [&] {
              Map torn = map.clone();
              torn.parameterization = cube;
              fill_borders(torn);
            }},
           {"a turn that is none", "bad request", [&] { turn_world(map, skew); }},
           {"alpha that isn't there", "bad request", [&] { without_alpha(map); }},
           {"a span too short", "bad request",
            [&] {
              sampler.look_up(Vec3d{0, 1, 0}, few);
            }},
           {"a level too far", "bad request",
            [&] {
              sampler.rgb(Vec3d{0, 1, 0}, 1);
            }},
           {"a level that is no number", "bad request",
            [&] {
              sampler.rgb(Vec3d{0, 1, 0}, NAN);
            }},
           {"an empty chain to sample", "bad request", [&] { Sampler{Chain{}}; }},
           {"an empty chain to write", "bad request", [&] { write_chain(sink, "ktx2", Chain{}); }},
           {"levels that don't belong together", "mismatch",
            [&] {
              Chain chain;
              chain.levels.push_back(map.clone());
              chain.levels.push_back(map.clone());
              write_chain(sink, "ktx2", chain);
            }},
           {"levels where there are none", "unsupported",
            [&] {
              check_write_map("a.hdr", {latlong, layouts_of(latlong)[0]}, {8, 4}, 3, {"R", "G", "B"});
            }},
           {"no picture", "bad request", [&] { io::write(sink, "exr", {}, options); }},
           {"a picture without pixels", "bad request",
            [&] {
              io::write(sink, "exr", {&empty, 1}, options);
            }},
           {"names and channels", "bad request",
            [&] {
              io::write(sink, "exr", {&unnamed, 1}, options);
            }},
           {"a format by no name", "bad request", [&] { write_map(sink, "gif", map); }},
           {"a type that the format lacks", "unsupported",
            [&] { write_map(sink, "png", map, {.image = {.type = io::PixelType::half}}); }},
           {"a compression that it lacks", "bad request",
            [&] { write_map(sink, "hdr", map, {.image = {.compression = "zip"}}); }},
           {"a view of another size", "bad request",
            [&] {
              write_map(sink, "pfm", map);
              const int channel = 0;
              io::open(sink.bytes(), "map")->read(0, {&channel, 1}, wrong_view);
            }},
           {"a part that isn't there", "bad request",
            [&] {
              const int channel = 0;
              io::open(sink.bytes(), "map")->read(7, {&channel, 1}, wrong_view);
            }},
           {"pixels for too few charts", "mismatch",
            [&] { Map::from_pixels(cube, pixels_of(few.data(), 1, 1, 2)); }},
           {"pixels without data", "bad request",
            [&] { Map::from_pixels(latlong, pixels_of(static_cast<const float*>(nullptr), 2, 1, 1)); }},
           {"copies between sizes", "bad request",
            [&] { copy_pixels(sound.level.chart(0), other.level.chart(0)); }},
           {"a level of a chain below 0", "bad request",
            [&] {
              chain_size({8, 4}, -1);
            }},
           {"a plan for nothing", "bad request",
            [&] {
              BakePlan(PrefilterShape{latlong, {0, 0}, 3});
            }},
           {"another map than the plan's", "mismatch",
            [&] {
              BakePlan(PrefilterShape{latlong, {16, 8}, 3}).run(map);
            }},
           {"more levels than there are", "bad request",
            [&] {
              bake(map, {.size = ChartSize{4, 4}, .levels = 9});
            }},
           {"levels of one lobe", "bad request",
            [&] { bake(map, {.lobe = lobe::AnyLobe::make("lambert"), .levels = 3}); }},
           {"verified with another number of maps", "bad request",
            [&] {
              verify_prefilter(map, {}, std::vector<PrefilterLevel>{{{4, 4}, lobe::AnyLobe::mirror()}});
            }},
           {"a border wider than a chart", "mismatch", [&] { with_safety_border(map, 0, 5); }},
           {"roughness of a lambert", "bad request",
            [&] { lobe::AnyLobe::make("lambert").with_roughness(0.5); }},
           {"a share over 1", "bad request",
            [&] { lobe::energy_cone_angle(lobe::AnyLobe::make("ggx"), 1.5); }},
           {"harmonics below 0", "bad request",
            [&] { lobe::zonal_coefficients(lobe::AnyLobe::make("ggx"), -1); }},
           {"a curve of no levels", "bad request",
            [&] { lobe::RoughnessCurve::from_name("linear").roughness(0, 0); }},
           {"a lobe of no width", "bad request", [&] { lobe::AnyLobe::from_model(nullptr); }},
           {"a name that is taken", "bad request",
            [&] { turned(), sphere::register_parameterization<Turned>(); }},
           {"a parameter out of range", "bad request",
            [&] { turned(), AnyParameterization::make("test-turned,tilt=91"); }},
       }) {
    EXPECT_EQ(refusal(c.call), c.kind) << c.what;
  }
}

TEST(Library, CancelledIsNoError) {
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  const Map map = room(AnyParameterization::make("latlong"), 64, 32);
  try {
    bake(map, {}, monitor);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    FAIL() << error.what();
  } catch (const Cancelled&) {
  }
}

}  // namespace
}  // namespace welkin
