#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>

#include "welkin/base/error.h"
#include "welkin/map/map_cases.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/sphere/convention.h"
#include "welkin/synth/render_synth.h"

/// Textures as a graphics card takes them, and as other programs make them.
namespace welkin {
namespace {

namespace fs = std::filesystem;
using cases::refusal;
using sphere::AnyParameterization;

class ChainTexture : public testing::Test {
 protected:
  ChainTexture()
      : folder_(fs::temp_directory_path() / ("welkin_chain_texture_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~ChainTexture() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  fs::path folder_;
};

/// The pictures of a file's level, decoded by the io room alone.
struct Pictures {
  std::vector<io::PartInfo> parts;
  std::vector<Image> images;
};

Pictures pictures_of_level(const fs::path& path, int level) {
  const auto reader = io::open(path);
  Pictures pictures;
  for (std::size_t i = 0; i < reader->info().parts.size(); ++i) {
    const io::PartInfo& part = reader->info().parts[i];
    if (part.level != level) continue;
    pictures.parts.push_back(part);
    Image& image = pictures.images.emplace_back(part.width, part.height, 3);
    const int channels[] = {0, 1, 2};
    reader->read(i, channels, image.view());
  }
  return pictures;
}

/// What a graphics card finds in a cube texture along (rx, ry, rz), by the nearest texel: OpenGL 4.6 core
/// profile, §8.13, table 8.19. Major axis, face, s_c, t_c and m_a; s = ½(s_c/|m_a| + 1), t likewise, and (0,
/// 0) is the first texel in memory.
const float* cube_texel(const Pictures& cube, const Vec3d& r) {
  const double ax = std::fabs(r.x), ay = std::fabs(r.y), az = std::fabs(r.z);
  int face = 0;
  double sc = 0, tc = 0, ma = 0;
  if (ax >= ay && ax >= az) {
    face = r.x > 0 ? 0 : 1;
    sc = r.x > 0 ? -r.z : r.z;
    tc = -r.y;
    ma = r.x;
  } else if (ay >= az) {
    face = r.y > 0 ? 2 : 3;
    sc = r.x;
    tc = r.y > 0 ? r.z : -r.z;
    ma = r.y;
  } else {
    face = r.z > 0 ? 4 : 5;
    sc = r.z > 0 ? r.x : -r.x;
    tc = -r.y;
    ma = r.z;
  }
  for (std::size_t i = 0; i < cube.parts.size(); ++i) {
    if (cube.parts[i].face != face) continue;
    const int size = cube.parts[i].width;
    const auto texel = [&](double c) {
      return std::min(size - 1, static_cast<int>(0.5 * (c / std::fabs(ma) + 1) * size));
    };
    return cube.images[i].at(texel(sc), texel(tc));
  }
  return nullptr;
}

std::vector<Vec3d> random_directions(int count) {
  std::mt19937 random(11);
  std::normal_distribution<double> along;
  std::vector<Vec3d> directions;
  for (int i = 0; i < count; ++i) {
    const Vec3d d{along(random), along(random), along(random)};
    directions.push_back(normalize(d));
  }
  return directions;
}

/// Those of the directions around which the function is even, as far as 0.024 radians.
std::vector<Vec3d> where_even(const synth::Radiance& radiance, const std::vector<Vec3d>& directions) {
  const auto is_even = [&](const Vec3d& d) {
    const Vec3d across = normalize(cross(d, std::fabs(d.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
    const Vec3d along = cross(d, across);
    for (int x = -6; x <= 6; ++x) {
      for (int y = -6; y <= 6; ++y) {
        if (radiance(normalize(d + (0.004 * x) * across + (0.004 * y) * along)) != radiance(d)) return false;
      }
    }
    return true;
  };
  std::vector<Vec3d> even;
  std::copy_if(directions.begin(), directions.end(), std::back_inserter(even), is_even);
  return even;
}

// A texel of a face of 128 lies within 0.0156·√½ radians of its centre, so the nearest one's is as near. The
// slope of `smooth` is below 0.6. The card has hard edges, but all of the texel is even where its
// surroundings are.
TEST_F(ChainTexture, LookingUpACubeTextureGivesTheRadianceAlongTheDirection) {
  const auto p = AnyParameterization::make("cube");
  const synth::Radiance card = synth::make("axes");
  const std::vector<Vec3d> directions = random_directions(2000), even = where_even(card, directions);
  std::set<std::array<float, 3>> colours;
  for (const Vec3d& d : even) colours.insert(card(d));
  EXPECT_GE(colours.size(), 6u);
  for (const Convention& convention : conventions()) {
    RenderOptions options;
    options.orientation = convention.lookup;
    options.samples = 2;
    write_map(file("card.ktx2"), render(card, p, 128, 128, options), default_layout(p, "card.ktx2"));
    Map smooth(p, 128, 128, 3);
    smooth.orientation = convention.lookup;
    cases::render(smooth, cases::smooth);
    write_map(file("smooth.ktx2"), smooth, default_layout(p, "smooth.ktx2"));
    const Pictures card_cube = pictures_of_level(file("card.ktx2"), 0),
                   smooth_cube = pictures_of_level(file("smooth.ktx2"), 0);
    ASSERT_EQ(card_cube.parts.size(), 6u);
    for (const Vec3d& d : directions) {
      EXPECT_NEAR(static_cast<double>(cube_texel(smooth_cube, convention.lookup * d)[0]), cases::smooth(d),
                  0.007)
          << convention.name;
    }
    for (const Vec3d& d : even) {
      const float* found = cube_texel(card_cube, convention.lookup * d);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[c], card(d)[static_cast<std::size_t>(c)], 1e-5) << convention.name;
      }
    }
  }
}

TEST_F(ChainTexture, EveryLevelOfACubeTextureIsLookedUpAlike) {
  Chain chain;
  for (int k = 0; k < 5; ++k) {
    Map& map = chain.levels.emplace_back(AnyParameterization::make("cube"), 64 >> k, 64 >> k, 3);
    cases::render(map, cases::smooth);
  }
  write_chain(file("chain.ktx2"), chain, default_layout(chain.levels[0].parameterization, "chain.ktx2", 5));
  for (int k = 0; k < 5; ++k) {
    const Pictures cube = pictures_of_level(file("chain.ktx2"), k);
    ASSERT_EQ(cube.parts.size(), 6u);
    for (const Vec3d& d : random_directions(500)) {
      EXPECT_NEAR(static_cast<double>(cube_texel(cube, d)[0]), cases::smooth(d), 0.011 * (1 << k)) << k;
    }
  }
}

TEST_F(ChainTexture, TexturesOfOtherProgramsAreKnownByTheirKind) {
  std::vector<Image> images;
  const auto parts_of = [&](int width, int height, int levels, int layers, int faces) {
    images.clear();
    std::vector<io::WritePart> parts;
    for (int level = 0; level < levels; ++level) {
      for (int i = 0; i < layers * faces; ++i) images.emplace_back(width >> level, height >> level, 4);
    }
    for (std::size_t i = 0; i < images.size(); ++i) {
      const int index = static_cast<int>(i), of_level = index % (layers * faces);
      images[i].at(0, 0)[0] = static_cast<float>(index);
      parts.push_back({"",
                       static_cast<const Image&>(images[i]).view(),
                       {"R", "G", "B", "A"},
                       index / (layers * faces),
                       of_level / faces,
                       of_level % faces});
    }
    return parts;
  };
  const auto expect_kind = [&](const std::string& shape, const std::string& reason, std::size_t levels) {
    const MapReader reader(file("other.ktx2"));
    ASSERT_TRUE(reader.info().shape);
    EXPECT_EQ(reader.info().shape->text(), shape);
    EXPECT_EQ(reader.info().reason, reason);
    EXPECT_EQ(reader.info().levels.size(), levels);
  };
  io::write(file("other.ktx2"), parts_of(8, 8, 3, 1, 6));
  expect_kind("cube:layers", "a cube texture", 3);
  io::write(file("other.ktx2"), parts_of(16, 8, 4, 1, 1));
  expect_kind("latlong", "guessed from the aspect 2:1", 4);
  io::write(file("other.ktx2"), parts_of(8, 6, 1, 1, 1));
  expect_kind("cube:hcross", "guessed from the aspect 4:3", 1);

  // Twelve layers are a map of twelve charts when it's said so, and one of them can be read alone.
  io::write(file("other.ktx2"), parts_of(8, 8, 2, 12, 1));
  EXPECT_FALSE(MapReader(file("other.ktx2")).info().shape);
  ReadMapOptions options;
  options.shape = "healpix";
  options.level = 1;
  Map map = read_map(file("other.ktx2"), options).map;
  EXPECT_EQ(*map.level.chart(11).at(0, 0), 12 + 11);
  options.shape = "octahedral";
  options.part = 5;
  map = read_map(file("other.ktx2"), options).map;
  EXPECT_EQ(*map.level.chart(0).at(0, 0), 12 + 5);

  // Of an array of cubes, `part` is the cube.
  io::write(file("other.ktx2"), parts_of(8, 8, 2, 3, 6));
  options = {};
  options.part = 2;
  options.level = 1;
  map = read_map(file("other.ktx2"), options).map;
  EXPECT_EQ(*map.level.chart(4).at(0, 0), 18 + 12 + 4);
  options.part = 3;
  EXPECT_NE(refusal([&] { read_map(file("other.ktx2"), options); }).find("no part 3 (parts are 0 to 2)"),
            std::string::npos);
}

}  // namespace
}  // namespace welkin
