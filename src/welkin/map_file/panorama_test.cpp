#include "welkin/map_file/panorama.h"

#include <gtest/gtest.h>

#include <utility>

#include "welkin/base/error.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin::map_file {
namespace {

using io::Panorama;
using io::Stereo;
using sphere::AnyParameterization;

/// A file of one picture that says that.
io::FileInfo file_of(int width, int height, const Panorama& panorama) {
  io::FileInfo file;
  file.format = "jpeg";
  io::PartInfo part;
  part.width = width;
  part.height = height;
  part.channels = {"R", "G", "B"};
  file.parts.push_back(part);
  file.panorama = panorama;
  return file;
}

/// The world's direction at a position of a file's picture.
Vec3d direction_at(const MapFileInfo& info, double u, double v) {
  return transpose(info.orientation) * info.shape->parameterization.to_sphere(0, u, v);
}

/// Degrees clockwise from north, which is +Z, and above the horizon.
Vec3d toward(double heading, double elevation) {
  const double h = heading * kPi / 180, e = elevation * kPi / 180;
  return {-std::sin(h) * std::cos(e), std::sin(e), std::cos(h) * std::cos(e)};
}

TEST(PanoramaTest, ACropIsThatPartOfTheWholeTexelByTexel) {
  // 128×64 texels at (64, 32) of 256×128.
  const Panorama crop{"equirectangular", 256, 128, 128, 64, 64, 32};
  const MapFileInfo info = inspect("crop.jpg", file_of(128, 64, crop), {});
  EXPECT_EQ(info.shape->text(), "latlong,left=-90,right=90,top=45,bottom=-45");
  EXPECT_EQ(info.chart.width, 128);
  EXPECT_EQ(info.chart.height, 64);
  EXPECT_TRUE(info.image.warnings.empty());
  const auto whole = AnyParameterization::make("latlong");
  for (const int x : {0, 5, 127}) {
    for (const int y : {0, 9, 63}) {
      const Vec3d here = direction_at(info, (x + 0.5) / 128, (y + 0.5) / 64);
      EXPECT_LT(length(here - whole.to_sphere(0, (64 + x + 0.5) / 256, (32 + y + 0.5) / 128)), 1e-14);
    }
  }
}

TEST(PanoramaTest, CropsOfAnyAspectAreObeyed) {
  // 3:2, which a strip of cube faces has, too.
  const Panorama crop{"equirectangular", 400, 200, 96, 64, 10, 20};
  const MapFileInfo info = inspect("crop.jpg", file_of(96, 64, crop), {});
  EXPECT_EQ(info.shape->text(), "latlong,left=-171,right=-84.6,top=72,bottom=14.4");
  // The same picture, half as large.
  EXPECT_TRUE(inspect("crop.jpg", file_of(48, 32, crop), {}).image.warnings.empty());
  EXPECT_EQ(inspect("crop.jpg", file_of(48, 32, crop), {}).shape->text(), info.shape->text());
  // Squeezed: obeyed, and told.
  const MapFileInfo squeezed = inspect("crop.jpg", file_of(64, 64, crop), {});
  EXPECT_EQ(squeezed.shape->text(), info.shape->text());
  EXPECT_EQ(squeezed.image.warnings.size(), 1U);
}

TEST(PanoramaTest, WhatIsNotSaidIsAllOfIt) {
  EXPECT_EQ(inspect("a", file_of(200, 100, {"equirectangular"}), {}).shape->text(), "latlong");
  EXPECT_EQ(inspect("a", file_of(200, 100, {"Equirectangular", 200}), {}).shape->text(), "latlong");
  EXPECT_EQ(inspect("a", file_of(200, 50, {"", 200, 100, 0, 50, 0, 0}), {}).shape->text(),
            "latlong,bottom=0");
  // Without sizes, an aspect that no full lat-long has is told.
  const MapFileInfo odd = inspect("a", file_of(100, 100, {"equirectangular"}), {});
  EXPECT_EQ(odd.shape->text(), "latlong");
  EXPECT_EQ(odd.image.warnings.size(), 1U);
}

TEST(PanoramaTest, SizesThatContradictEachOtherAreTold) {
  const Panorama bad[] = {{"equirectangular", 256, 128, 300, 64, 0, 0},
                          {"equirectangular", 256, 128, 128, 64, 0, 65},
                          {"equirectangular", 256, 128, 128, 64, -1, 0},
                          {"equirectangular", -256, 128, 128, 64, 0, 0},
                          {"equirectangular", 256, 128, 128, 64, 2147483647, 2147483647},
                          {"equirectangular", 0, 0, 128, 64, 2, 2}};
  for (const Panorama& panorama : bad) {
    const MapFileInfo info = inspect("a", file_of(128, 64, panorama), {});
    EXPECT_EQ(info.shape->text(), "latlong");
    EXPECT_EQ(info.image.warnings.size(), 1U);
  }
  const MapFileInfo tiny = inspect("a", file_of(128, 64, {"equirectangular", 1 << 20, 1 << 19, 8, 4}), {});
  EXPECT_EQ(tiny.image.warnings.size(), 1U);
}

TEST(PanoramaTest, CylindersAndOtherProjections) {
  const int high = 1000;  // ±1 radius at 2π·500
  const Panorama cylinder{"cylindrical", 3142, 0, 3142, high, 0, -500};
  const MapFileInfo info = inspect("a", file_of(3142, high, cylinder), {});
  EXPECT_EQ(info.shape->parameterization.name(), "cylinder");
  EXPECT_NEAR(info.shape->parameterization.parameters()[0].value, 90, 0.01);
  const MapFileInfo off = inspect("a", file_of(3142, high, {"cylindrical", 3142, 0, 3142, high, 0, 0}), {});
  EXPECT_EQ(off.image.warnings.size(), 1U);
  const MapFileInfo other = inspect("a", file_of(200, 100, {"fisheye"}), {});
  EXPECT_EQ(other.image.warnings.size(), 1U);
  EXPECT_EQ(other.reason, "guessed from the aspect 2:1");
}

TEST(PanoramaTest, ThePoseTurnsTheWorld) {
  Panorama pose{"equirectangular", 256, 128};
  pose.heading = 90;
  MapFileInfo info = inspect("a", file_of(256, 128, pose), {});
  EXPECT_LT(length(direction_at(info, 0.5, 0.5) - toward(90, 0)), 1e-12);
  EXPECT_LT(length(direction_at(info, 0.75, 0.5) - toward(180, 0)), 1e-12);
  pose.pitch = 20;
  info = inspect("a", file_of(256, 128, pose), {});
  EXPECT_LT(length(direction_at(info, 0.5, 0.5) - toward(90, 20)), 1e-12);
  EXPECT_LT(length(direction_at(info, 0.5, 0) - toward(270, 70)), 1e-12);
  // The horizon turns counterclockwise: what is to the right of the centre lies below it.
  pose.pitch = 0;
  pose.roll = 10;
  info = inspect("a", file_of(256, 128, pose), {});
  EXPECT_LT(length(direction_at(info, 0.5, 0.5) - toward(90, 0)), 1e-12);
  EXPECT_LT(length(direction_at(info, 0.75, 0.5) - toward(180, -10)), 1e-12);
  EXPECT_TRUE(info.image.warnings.empty());
  EXPECT_EQ(info.image.notes.size(), 1U);
}

TEST(PanoramaTest, WhatIsAskedBeatsTheFileAndIsTold) {
  Panorama crop{"equirectangular", 256, 128, 128, 64, 64, 32};
  crop.heading = 30;
  ReadMapOptions options;
  options.shape = "latlong";
  const MapFileInfo asked = inspect("a", file_of(128, 64, crop), options);
  EXPECT_EQ(asked.shape->text(), "latlong");
  ASSERT_EQ(asked.image.warnings.size(), 1U);
  EXPECT_NE(asked.image.warnings[0].find("latlong,left=-90,right=90,top=45,bottom=-45"), std::string::npos);
  // The same in other words needs no warning.
  options.shape = "latlong,left=-90,right=90,bottom=-45,top=45";
  EXPECT_TRUE(inspect("a", file_of(128, 64, crop), options).image.warnings.empty());
  options.orientation = Matrix3{};
  const MapFileInfo turned = inspect("a", file_of(128, 64, crop), options);
  EXPECT_EQ(turned.orientation, Matrix3{});
  EXPECT_EQ(turned.image.warnings.size(), 1U);
  // No camera took a cube.
  options = {};
  options.shape = "cube:hstrip";
  const MapFileInfo cube = inspect("a", file_of(384, 64, crop), options);
  EXPECT_EQ(cube.orientation, Matrix3{});
}

TEST(PanoramaTest, StereoOfTheFileIsObeyed) {
  Panorama both{"equirectangular"};
  both.stereo = Stereo::top_bottom;
  const MapFileInfo left = inspect("a", file_of(256, 256, both), {});
  EXPECT_EQ(left.shape->text(), "latlong");
  EXPECT_EQ(left.chart.height, 128);
  EXPECT_EQ(left.eye, Eye::left);
  EXPECT_EQ(left.image.warnings.size(), 1U);
  ReadMapOptions options;
  options.eye = Eye::right;
  const MapFileInfo right = inspect("a", file_of(256, 256, both), options);
  EXPECT_EQ(right.eye, Eye::right);
  EXPECT_TRUE(right.image.warnings.empty());
  // Sizes of the whole picture, both eyes together.
  const Panorama sizes{"equirectangular", 256, 256, 256, 256, 0, 0, 0, 0, 0, Stereo::top_bottom};
  options.eye = Eye::left;
  EXPECT_TRUE(inspect("a", file_of(256, 256, sizes), options).image.warnings.empty());
  EXPECT_EQ(inspect("a", file_of(256, 256, sizes), options).shape->text(), "latlong");
  both.stereo = Stereo::mono;
  EXPECT_THROW(inspect("a", file_of(256, 256, both), options), Error);
  both.stereo = Stereo::left_right;
  EXPECT_THROW(inspect("a", file_of(257, 256, both), options), Error);
}

/// What is written, read again, is the same map.
TEST(PanoramaTest, WindowsBecomeMetadataAndComeBack) {
  const Matrix3 tilted = rotation_from_yaw_pitch_roll(30, -50, 120);
  for (const auto& [spec, width] : {std::pair("latlong", 40),
                                    {"latlong,left=-90,right=90,top=45,bottom=-45", 40},
                                    {"vr180", 40},
                                    {"sky-latlong", 40},
                                    {"latlong,left=90,right=270", 40},
                                    {"latlong,left=100,right=280,top=10,bottom=-70", 54},
                                    {"latlong,left=0,right=360", 40},
                                    {"latlong,left=170,right=171,top=30,bottom=29", 40}}) {
    for (const Matrix3& orientation : {Matrix3{}, tilted, rotation_from_yaw_pitch_roll(0, -90, 40)}) {
      const auto p = AnyParameterization::make(spec);
      const ChartSize size{width, static_cast<int>(std::lround(width / p.aspect()))};
      const std::optional<Panorama> panorama = panorama_of(MapFrame(p, size, orientation));
      ASSERT_TRUE(panorama) << spec;
      EXPECT_LE(panorama->crop_left + panorama->crop_width, panorama->full_width) << spec;
      const MapFileInfo back = inspect("a", file_of(size.width, size.height, *panorama), {});
      EXPECT_TRUE(back.image.warnings.empty()) << spec << ": " << back.image.warnings[0];
      for (const double u : {0.0, 0.3, 1.0}) {
        for (const double v : {0.1, 0.6}) {
          const Vec3d expected = transpose(orientation) * p.to_sphere(0, u, v);
          EXPECT_LT(length(direction_at(back, u, v) - expected), 1e-7) << spec;
        }
      }
    }
  }
}

TEST(PanoramaTest, OthersHaveNoSuchMetadata) {
  for (const char* spec :
       {"cube", "angular", "equal-area", "mercator", "cylinder", "octahedral", "openexr-latlong"})
    EXPECT_FALSE(panorama_of(MapFrame(AnyParameterization::make(spec), {64, 32}))) << spec;
  // No whole number of texels across the full panorama; a mirrored world.
  EXPECT_FALSE(panorama_of(MapFrame(AnyParameterization::make("latlong,left=-50,right=50"), {64, 32})));
  EXPECT_FALSE(panorama_of(MapFrame(AnyParameterization::make("latlong"), {64, 32},
                                    Matrix3{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}})));
}

}  // namespace
}  // namespace welkin::map_file
