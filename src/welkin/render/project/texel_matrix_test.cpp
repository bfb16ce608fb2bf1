#include "welkin/render/project/texel_matrix.h"

#include <gtest/gtest.h>

#include "welkin/measure/compare.h"
#include "welkin/prefilter/reference.h"
#include "welkin/render/render_cases.h"

namespace welkin::scene {
namespace {

// Small lights are the hardest: all of a texel's light by its own weight.
TEST(TexelMatrix, IsTheReference) {
  const auto p = sphere::AnyParameterization::make("octahedral");
  const Map source = welkin::render(synth::make("studio"), p, 32, 32);
  const PrefilterReference reference(source);
  for (const char* spec :
       {"lambert", "phong,exponent=50", "ggx,roughness=0.5", "ggx,roughness=0.3", "ggx,roughness=1"}) {
    const auto lobe = lobe::AnyLobe::make(spec);
    const auto matrix = TexelMatrix::make(p, {32, 32}, {8, 8}, lobe);
    ASSERT_TRUE(matrix) << spec;
    const Map level = matrix->apply(source);
    double squares = 0, errors = 0;
    std::vector<double> wanted(3);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Vec3d d = p.to_sphere(0, (x + 0.5) / 8, (y + 0.5) / 8);
        reference.evaluate(lobe, {&d, 1}, wanted);
        for (std::size_t c = 0; c < 3; ++c) {
          const double e = static_cast<double>(level.level.chart(0).at(x, y)[c]) - wanted[c];
          squares += wanted[c] * wanted[c];
          errors += e * e;
        }
      }
    }
    EXPECT_LT(std::sqrt(errors / squares), 1e-3) << spec;
  }
}

TEST(TexelMatrix, IsNotForWhatItCannotResolve) {
  const auto p = sphere::AnyParameterization::make("octahedral");
  const auto made = [&](ChartSize from, ChartSize to, const char* lobe) {
    return TexelMatrix::make(p, from, to, lobe::AnyLobe::make(lobe)).has_value();
  };
  EXPECT_FALSE(made({32, 32}, {32, 32}, "ggx,roughness=0.01"));
  EXPECT_FALSE(made({256, 256}, {16, 16}, "lambert"));
  EXPECT_FALSE(made({32, 32}, {32, 32}, "ggx,roughness=0"));
  EXPECT_TRUE(made({32, 32}, {32, 32}, "ggx,roughness=0.5"));
}

}  // namespace
}  // namespace welkin::scene
