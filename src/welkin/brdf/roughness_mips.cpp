#include "welkin/brdf/roughness_mips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/math/scalar.h"
#include "welkin/math/vec.h"

namespace welkin::brdf {
namespace {

/// What adds up over texels: slopes, their squares, α².
struct Moments {
  double x = 0, y = 0, squares = 0, alpha_squared = 0;

  void add(const Moments& other, double weight) {
    x += weight * other.x;
    y += weight * other.y;
    squares += weight * other.squares;
    alpha_squared += weight * other.alpha_squared;
  }
};

struct Grid {
  int width, height;
  std::vector<Moments> texels;

  Moments& at(int column, int row) {
    return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
  const Moments& at(int column, int row) const { return const_cast<Grid*>(this)->at(column, row); }
};

[[noreturn]] void bad_texel(const char* what, int x, int y) {
  throw Error(ErrorKind::bad_value,
              std::string(what) + " at texel " + std::to_string(x) + ", " + std::to_string(y));
}

Grid moments_of(ImageView<const float> normals, ImageView<const float> roughness,
                const RoughnessMipsOptions& options) {
  // The cosine of 3° above the surface's plane.
  constexpr double kLeastUp = 0.05;
  Grid grid{normals.width, normals.height, {}};
  grid.texels.resize(static_cast<std::size_t>(normals.width) * static_cast<std::size_t>(normals.height));
  const bool one = roughness.width == 1 && roughness.height == 1;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const float* value = normals.at(x, y);
      const double side = options.flip_green ? -options.normal_scale : options.normal_scale;
      const Vec3d n{options.normal_scale * (2.0 * value[0] - 1), side * (2.0 * value[1] - 1),
                    2.0 * value[2] - 1};
      const double size = length(n);
      if (!std::isfinite(size)) bad_texel("a normal that is not finite", x, y);
      if (size < 1e-6) bad_texel("a normal of length 0", x, y);
      const double up = std::max(n.z / size, kLeastUp);
      const double rough = *roughness.at(one ? 0 : x, one ? 0 : y);
      if (!(rough >= 0 && rough <= 1)) bad_texel("a roughness outside 0 … 1", x, y);
      Moments& at = grid.at(x, y);
      at.x = n.x / size / up;
      at.y = n.y / size / up;
      at.squares = at.x * at.x + at.y * at.y;
      at.alpha_squared = rough * rough * rough * rough;
    }
  }
  return grid;
}

/// Half as large, each texel the mean over the area that it covers: three texels across where a side is odd.
Grid halved(const Grid& from) {
  Grid to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.texels.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  const double across = 1.0 * from.width / to.width, down = 1.0 * from.height / to.height;
  const auto share = [](int i, double begin, double end) {
    return std::min(end, i + 1.0) - std::max(begin, 1.0 * i);
  };
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      for (int j = static_cast<int>(y * down); j < from.height && j < (y + 1) * down - 1e-9; ++j) {
        for (int i = static_cast<int>(x * across); i < from.width && i < (x + 1) * across - 1e-9; ++i) {
          const double area = share(i, x * across, (x + 1) * across) * share(j, y * down, (y + 1) * down);
          to.at(x, y).add(from.at(i, j), area / (across * down));
        }
      }
    }
  }
  return to;
}

Image roughness_of(const Grid& grid) {
  Image image(grid.width, grid.height, 1);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Moments& at = grid.at(x, y);
      // α²/2 is the variance along one axis; that of both is halved and doubled again.
      const double variance = std::max(0.0, at.squares - at.x * at.x - at.y * at.y);
      *image.at(x, y) = static_cast<float>(std::sqrt(std::sqrt(std::min(at.alpha_squared + variance, 1.0))));
    }
  }
  return image;
}

}  // namespace

std::vector<Image> roughness_mips(ImageView<const float> normals, ImageView<const float> roughness,
                                  const RoughnessMipsOptions& options) {
  require(normals.channels >= 3, "a normal map has three channels");
  require(roughness.channels >= 1, "a roughness map has a channel");
  require(normals.width >= 1 && normals.height >= 1, "a normal map has texels");
  require(options.normal_scale >= 0 && options.normal_scale <= 1e3, "the scale of normals is of 0 to 1000");
  require(options.levels >= 0 && options.levels <= 31, "levels are 0 to 31");
  const bool one = roughness.width == 1 && roughness.height == 1;
  if (!one && (roughness.width != normals.width || roughness.height != normals.height))
    throw Error(ErrorKind::mismatch, "the roughness map has " + std::to_string(roughness.width) + "×" +
                                         std::to_string(roughness.height) + " texels and the normal map " +
                                         std::to_string(normals.width) + "×" +
                                         std::to_string(normals.height));
  std::vector<Image> levels;
  Grid grid = moments_of(normals, roughness, options);
  for (;;) {
    levels.push_back(roughness_of(grid));
    if (grid.width == 1 && grid.height == 1) break;
    if (options.levels > 0 && static_cast<int>(levels.size()) == options.levels) break;
    grid = halved(grid);
  }
  return levels;
}

}  // namespace welkin::brdf
