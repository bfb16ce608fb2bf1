#include "welkin/map_file/kept_convention.h"

#include <gtest/gtest.h>

#include "welkin/map_file/map_file_job.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

AnyParameterization named(const char* name) {
  return AnyParameterization::make(name);
}

/// What is known of an EXR of that parameterization written in that convention, named in it or not.
MapFileInfo written(const char* parameterization, const char* convention, bool names_it) {
  Map map(named(parameterization), 8, 8, 3);
  map.orientation = orientation_for(convention_from_name(convention), map.parameterization);
  WriteMapOptions options;
  if (names_it) options.convention = convention;
  io::MemorySink sink;
  write_map(sink, "exr", map, options);
  return MapReader(sink.bytes(), "map.exr").info();
}

/// A convention that a file names holds for every parameterization.
TEST(KeptConvention, FollowsItsName) {
  for (const Convention& each : conventions()) {
    for (const char* from : {"latlong", "cube", "angular"}) {
      const MapFileInfo info = written(from, each.name.c_str(), true);
      for (const char* to : {"latlong", "cube", "octahedral", "angular", "sphere"}) {
        const auto kept = kept_convention(info, named(to));
        if (each.name == "native") {
          EXPECT_FALSE(kept);
          continue;
        }
        ASSERT_TRUE(kept) << each.name << from << to;
        EXPECT_EQ(kept->name, each.name);
        EXPECT_EQ(kept->orientation, orientation_for(each, named(to))) << each.name << from << to;
      }
    }
  }
}

/// Without a name, the same kind of parameterization keeps its orientation, and another one where all that
/// have it agree.
TEST(KeptConvention, IsFoundByTheOrientation) {
  const MapFileInfo info = written("cube", "unity", false);
  const auto kept = kept_convention(info, named("octahedral"));
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->orientation, info.orientation);
  EXPECT_FALSE(kept_convention(info, named("latlong")));  // three.js and Unity differ there
  EXPECT_TRUE(declares_convention(info));
  const auto unreal = kept_convention(written("cube", "unreal", false), named("latlong"));
  ASSERT_TRUE(unreal);
  EXPECT_EQ(unreal->name, "unreal");
}

TEST(KeptConvention, IsNoneOfOtherOrientations) {
  EXPECT_FALSE(declares_convention(written("cube", "filament", false)));
  MapFileInfo info = written("cube", "three.js", true);
  info.orientation = rotation_from_yaw_pitch_roll(10, 0, 0);  // read in another way
  EXPECT_FALSE(kept_convention(info, named("cube")));
  // A name that contradicts the orientation, and one that is none.
  info = written("cube", "three.js", true);
  for (const char* name : {"unreal", "blendr"}) {
    info.image.attributes[map_file::kConventionKey] = name;
    const auto kept = kept_convention(info, named("cube"));
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->name, "three.js");
  }
}

}  // namespace
}  // namespace welkin
