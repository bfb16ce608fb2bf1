#include "welkin/brdf/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <unistd.h>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin::brdf {
namespace {

namespace fs = std::filesystem;

Vec3d upward(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

class Files : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    const std::string path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("welkin-brdf-" + std::to_string(::getpid()));
};

std::string error_of(const std::string& spec, ErrorKind kind) {
  try {
    AnyBrdf::make(spec);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  ADD_FAILURE() << spec << " was accepted";
  return {};
}

TEST(AnyBrdf, IsReciprocalAndIsotropic) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const char* spec : {"ggx,roughness=0.3", "ggx,roughness=0.7,f0=0.04", "ward,roughness=0.4"}) {
    const AnyBrdf brdf = AnyBrdf::make(spec);
    EXPECT_EQ(brdf.spec(), spec);
    for (int i = 0; i < 100; ++i) {
      const double a = 1.5 * unit(random), b = 1.5 * unit(random), turn = 6 * unit(random);
      const double value = brdf.value(upward(a, 0), upward(b, turn));
      EXPECT_NEAR(brdf.value(upward(b, turn), upward(a, 0)), value, 1e-12 * value);
      EXPECT_NEAR(brdf.value(upward(a, 1), upward(b, 1 + turn)), value, 1e-9 * value);
      EXPECT_NEAR(brdf.value(upward(a, 0), upward(b, -turn)), value, 1e-9 * value);
      EXPECT_EQ(brdf.value(upward(a, 0), upward(2, turn)), 0);
    }
  }
}

TEST(AnyBrdf, NamesAndRanges) {
  EXPECT_NE(error_of("gxg", ErrorKind::bad_request).find("did you mean 'ggx'"), std::string::npos);
  error_of("ggx,roughness=2", ErrorKind::bad_request);
  error_of("ggx,rough=0.5", ErrorKind::bad_request);
  error_of("table", ErrorKind::bad_request);
  error_of("table,file=", ErrorKind::bad_request);
  error_of("table,file=/nowhere/there.csv", ErrorKind::not_found);
  error_of("merl,file=/nowhere/there.binary", ErrorKind::not_found);
  EXPECT_TRUE(AnyBrdf::make("ggx").with_roughness(0).is_mirror());
  EXPECT_EQ(AnyBrdf::make("ward").with_roughness(0.25).roughness(), 0.25);
  EXPECT_THROW(AnyBrdf::from_function("none", 0.1, nullptr), Error);
  EXPECT_THROW(AnyBrdf::from_function("flat", 0, [](const Vec3d&, const Vec3d&) { return 1.0; }), Error);
}

/// A table of a function that is linear in each angle, which interpolation reproduces.
std::string table_of(const auto& value, const std::string& first_line = "") {
  std::string text = first_line;
  for (const int light : {0, 20, 50, 90}) {
    for (const int view : {0, 45, 90}) {
      for (const int between : {0, 60, 180})
        text += std::to_string(light) + "," + std::to_string(view) + "," + std::to_string(between) + "," +
                std::to_string(value(light, view, between)) + "\n";
    }
  }
  return text;
}
double linear(double light, double view, double between) {
  return 1 + 0.01 * light + 0.02 * view + 0.003 * between + 1e-6 * light * view * between;
}

TEST_F(Files, TablesAreLinearInEachAngle) {
  const std::string path =
      write("linear.csv", table_of(linear, "theta_i,theta_r,delta_phi,value\n# a comment\n"));
  const AnyBrdf brdf = AnyBrdf::make("table,file=" + path);
  EXPECT_EQ(brdf.spec(), "table,file=" + path);
  EXPECT_FALSE(brdf.has_roughness());
  EXPECT_TRUE(brdf.notes().empty());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 100; ++i) {
    const double light = 89 * unit(random), view = 89 * unit(random), between = 180 * unit(random);
    EXPECT_NEAR(brdf.value(upward(view * kDegree, 0.3), upward(light * kDegree, 0.3 - between * kDegree)),
                linear(light, view, between), 1e-5);
  }
}

TEST_F(Files, TablesThatAreNotOne) {
  const auto fails = [&](const std::string& text, ErrorKind kind) {
    return error_of("table,file=" + write("bad.csv", text), kind);
  };
  const std::string good = table_of(linear);
  const std::size_t row = good.find("20,45,60,"), end = good.find('\n', row) + 1;
  const std::string gap = fails(good.substr(0, row) + good.substr(end), ErrorKind::bad_request);
  EXPECT_NE(gap.find("no value for θi 20°, θr 45°, Δφ 60°"), std::string::npos) << gap;
  EXPECT_NE(fails(good + "20,45,60,1\n", ErrorKind::bad_request).find("again"), std::string::npos);
  EXPECT_NE(fails("10,0,0,1\n20,0,0,1\n", ErrorKind::bad_request).find("below 10°"), std::string::npos);
  EXPECT_NE(fails("0,0,0,1\n0,0,90,1\n", ErrorKind::bad_request).find("above 90°"), std::string::npos);
  EXPECT_NE(fails("0,0,0,-1\n", ErrorKind::bad_value).find("line 1: the value -1 is negative"),
            std::string::npos);
  fails("0,0,0,nan\n", ErrorKind::damaged);
  fails("0,0,0,1\n0,0,0\n", ErrorKind::damaged);
  fails("0,0,0,1,2\n", ErrorKind::damaged);
  fails("0,100,0,1\n", ErrorKind::bad_request);
  fails("0,0,270,1\n", ErrorKind::bad_request);
  fails("0,0,0,0\n", ErrorKind::bad_value);
  fails("", ErrorKind::damaged);
  std::string diagonal;  // would be a grid of 3000³
  for (int i = 0; i < 3000; ++i) {
    const std::string angle = std::to_string(i * 0.03);
    diagonal += angle + " " + angle + " " + angle + " 1\n";
  }
  EXPECT_NE(fails(diagonal, ErrorKind::bad_request).find("has gaps"), std::string::npos);
}

TEST(AnyBrdf, GridsAreChecked) {
  MeasuredGrid grid{{0, 90}, {0, 60}, {0, 180}, {1, 1, 1, 1, 1, 1, 1, 1}};
  const AnyBrdf brdf = AnyBrdf::from_grid("mine", grid);
  EXPECT_EQ(brdf.spec(), "table,mine");
  ASSERT_EQ(brdf.notes().size(), 1u);  // what is held beyond 60°
  EXPECT_EQ(brdf.value(upward(1.4, 0), upward(0.5, 1)), 1);
  grid.values.pop_back();
  EXPECT_THROW(AnyBrdf::from_grid("short", grid), Error);
  grid.values.push_back(std::numeric_limits<double>::infinity());
  EXPECT_THROW(AnyBrdf::from_grid("infinite", grid), Error);
}

/// A file of the MERL database whose red, green and blue are `value(θh, θd, φd)` in cells' middles, divided
/// by their scales.
template <class Value>
std::string merl_bytes(const Value& value) {
  std::string bytes;
  const auto put = [&](auto number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
  for (const std::int32_t size : {90, 90, 180}) put(size);
  for (const double scale : {1.0, 1.15, 1.66}) {
    for (int h = 0; h < 90; ++h) {
      for (int d = 0; d < 90; ++d) {
        for (int p = 0; p < 180; ++p) {
          const double part = (h + 0.5) / 90;
          put(1500 / scale * value(part * part * kPi / 2, (d + 0.5) / 180 * kPi, (p + 0.5) / 180 * kPi));
        }
      }
    }
  }
  return bytes;
}

TEST_F(Files, MerlIsReadByItsAngles) {
  // Smooth in all three angles, and symmetric as a BRDF is: of period π in φd.
  const auto value = [](double h, double d, double p) {
    return 1 + std::cos(h) + 0.5 * std::sin(d) * (1 + 0.3 * std::cos(2 * p));
  };
  const AnyBrdf brdf = AnyBrdf::make("merl,file=" + write("smooth.binary", merl_bytes(value)));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d view = upward(1.4 * unit(random), 1),
                light = upward(1.4 * unit(random), 1 + 6 * unit(random));
    // The angles by their definition, without the reader's formulas.
    const Vec3d half = normalize(view + light), normal{0, 0, 1};
    const double h = angle_between(half, normal), d = angle_between(half, light);
    const Vec3d across = cross(normal, half);
    if (length(across) < 0.05 || d < 0.05) continue;  // φd means nothing there
    const Vec3d u = normalize(across), t = cross(u, half);
    const double p = std::atan2(dot(light, u), dot(light, t));
    EXPECT_NEAR(brdf.value(view, light), value(h, d, p), 5e-3);  // linear between cells of 1°
  }
}

TEST_F(Files, MerlThatIsNot) {
  const std::string good = merl_bytes([](double, double, double) { return 1.0; });
  const auto fails = [&](const std::string& bytes, ErrorKind kind) {
    return error_of("merl,file=" + write("bad.binary", bytes), kind);
  };
  EXPECT_NE(fails(good.substr(0, 1000), ErrorKind::damaged).find("ends early: 1000 bytes"),
            std::string::npos);
  fails(good.substr(0, 7), ErrorKind::damaged);
  fails(good + "more", ErrorKind::damaged);
  std::string other = good;
  other[0] = 91;
  fails(other, ErrorKind::unsupported);
  const double nan = std::numeric_limits<double>::quiet_NaN(), negative = -1;
  std::string bad = good;
  bad.replace(12 + 80, 8, reinterpret_cast<const char*>(&nan), 8);
  EXPECT_NE(fails(bad, ErrorKind::bad_value).find("byte 92"), std::string::npos);
  bad.replace(12 + 80, 8, reinterpret_cast<const char*>(&negative), 8);
  const AnyBrdf brdf = AnyBrdf::make("merl,file=" + write("holes.binary", bad));
  ASSERT_EQ(brdf.notes().size(), 2u);
  EXPECT_NE(brdf.notes()[1].find("1 of 4374000"), std::string::npos);
}

}  // namespace
}  // namespace welkin::brdf
