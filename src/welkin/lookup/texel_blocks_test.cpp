#include "welkin/lookup/texel_blocks.h"

#include <gtest/gtest.h>

#include <set>

#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"

namespace welkin::test {
namespace {

TEST(TexelBlocks, HoldEveryTexelOfAStripWhereverItLies) {
  std::mt19937 random(3);
  std::normal_distribution<double> along;
  for (const std::string& spec : cases::names_and_windows()) {
    const Map map = cases::make_map(spec, 40);
    const TexelBlocks blocks(map.parameterization, map.level);
    for (const auto& strip : {std::pair{0.05, 0.05}, {0.8, 0.1}, {3.2, 0.02}, {4.0, 4.0}}) {
      const double reach = strip.first, across = strip.second;
      for (int k = 0; k < 6; ++k) {
        const Vec3d d = k < 2 ? Vec3d{0, k == 0 ? 1.0 : -1.0, 0}
                              : normalize(Vec3d{along(random), along(random), along(random)});
        const Vec3d pole = normalize(cross(d, Vec3d{along(random), along(random), along(random)}));
        const auto narrow = [](const Vec3d& v) {
          return Vec3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        std::set<std::tuple<int, int, int>> found;
        blocks.for_each({narrow(d), narrow(pole), static_cast<float>(reach), static_cast<float>(across)},
                        [&](const TexelBlocks::Block& block) {
                          for (int y = 0; y < block.height; ++y) {
                            for (int x = 0; x < block.width; ++x) {
                              EXPECT_TRUE(found.insert({block.chart, block.x + x, block.y + y}).second);
                            }
                          }
                        });
        std::size_t within = 0;
        cases::for_each_valid_texel(map, [&](int chart, int x, int y) {
          const Vec3d texel = cases::direction_at(map, chart, x, y);
          if (angle_between(texel, d) > reach || std::fabs(std::asin(dot(texel, pole))) > across) return;
          ++within;
          EXPECT_TRUE(found.contains({chart, x, y})) << spec << " " << chart << " " << x << " " << y;
        });
        const std::size_t all = static_cast<std::size_t>(map.charts() * map.width() * map.height());
        if (reach < 0.1) {
          EXPECT_LT(found.size(), all / 2 + 64) << spec << ": a few blocks, not all";
        }
        EXPECT_LE(within, found.size());
      }
    }
  }
}

}  // namespace
}  // namespace welkin::test
