#include "welkin/assemble/assemble.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "welkin/assemble/piece_texels.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

/// What a piece counts at least where it is mixed and nothing is behind it.
constexpr double kLeastFeather = 1e-6;

/// Of a layer's pieces at one texel.
struct Blend {
  double opacity = 0;                ///< the sum of all
  double weight = 0;                 ///< of the colours: alpha, times feather and fineness
  std::array<double, 3> light = {};  ///< the sum of colours by that weight, but for their own alpha
};

struct Texel {
  double opacity = 0;  ///< of what lies there so far, from behind
  std::array<double, 3> colour = {};
  double shown = 0;  ///< opacity without the backdrop
};

void lay_over(const Blend& layer, bool is_piece, Texel& texel) {
  if (!(layer.weight > 0)) return;
  const double opacity = std::min(layer.opacity, 1.0);
  for (std::size_t c = 0; c < 3; ++c)
    texel.colour[c] = opacity * layer.light[c] / layer.weight + (1 - opacity) * texel.colour[c];
  texel.opacity = opacity + (1 - opacity) * texel.opacity;
  if (is_piece) texel.shown = opacity + (1 - opacity) * texel.shown;
}

/// What is summed over texels, by solid angle.
struct Sums {
  double whole = 0, shown = 0;
  std::vector<double> shown_by;
};

class Assembler {
 public:
  Assembler(std::span<const Piece> pieces, const MapFrame& frame, const AssembleOptions& options)
      : pieces_(pieces), frame_(frame), options_(options), order_(pieces.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return pieces[a].layer < pieces[b].layer; });
    behind_ = options.fill.has_value();
    for (const Piece& piece : pieces) texels_.emplace_back(piece, frame);
  }

  Sums make(const Tile& tile, ImageView<float> out) const {
    std::vector<Texel> texels(static_cast<std::size_t>(tile.count()));
    std::vector<std::vector<double>> opacity(pieces_.size());
    for (std::size_t from = 0; from < order_.size();) {
      std::size_t to = from;
      while (to < order_.size() && layer(to) == layer(from)) ++to;
      const std::vector<Blend> blends = blend(tile, from, to, opacity);
      for (std::size_t i = 0; i < blends.size(); ++i)
        lay_over(blends[i], layer(from) != kBackdrop, texels[i]);
      from = to;
    }
    for (int i = 0; i < tile.count(); ++i) {
      const Texel& texel = texels[static_cast<std::size_t>(i)];
      float* to = out.at(i % tile.width, i / tile.width);
      for (std::size_t c = 0; c < 3; ++c) {
        const double behind =
            options_.fill ? (1 - texel.opacity) * static_cast<double>((*options_.fill)[c]) : 0;
        to[c] = static_cast<float>(texel.colour[c] + behind);
      }
      if (options_.alpha) to[3] = static_cast<float>(texel.opacity);
    }
    return sums(tile, texels, opacity);
  }

 private:
  int layer(std::size_t place) const { return pieces_[order_[place]].layer; }

  /// A piece that shows some of a tile.
  struct Shown {
    std::size_t piece;
    std::vector<float> colours;
    std::vector<double> feathers;
  };

  /// Of the pieces from … to of the order; `opacity` gets that of each piece that shows any of the tile.
  std::vector<Blend> blend(const Tile& tile, std::size_t from, std::size_t to,
                           std::vector<std::vector<double>>& opacity) const {
    const auto count = static_cast<std::size_t>(tile.count());
    std::vector<Shown> all;
    Shown next{0, std::vector<float>(4 * count), std::vector<double>(count)};
    for (std::size_t place = from; place < to; ++place) {
      next.piece = order_[place];
      if (!texels_[next.piece].make(tile, next.colours.data(), next.feathers.data())) continue;
      all.push_back(std::move(next));
      next = {0, std::vector<float>(4 * count), std::vector<double>(count)};
    }
    std::vector<Blend> blends(count);
    const bool fades = behind_ || from > 0, weighs = options_.by_fineness && all.size() > 1;
    for (const Shown& shown : all) {
      opacity[shown.piece].resize(count);
      const std::vector<double> finenesses =
          weighs ? texels_[shown.piece].fineness(tile) : std::vector<double>(count, 1.0);
      for (std::size_t i = 0; i < count; ++i) {
        const float* colour = &shown.colours[4 * i];
        const double alpha = static_cast<double>(colour[3]);
        if (!(alpha > 0)) continue;
        const double feather = fades ? shown.feathers[i] : std::max(shown.feathers[i], kLeastFeather);
        const double opaque = fades ? feather * alpha : alpha;
        const double fineness = finenesses[i];
        opacity[shown.piece][i] = opaque;
        blends[i].opacity += opaque;
        blends[i].weight += fineness * feather * alpha;
        for (std::size_t c = 0; c < 3; ++c)
          blends[i].light[c] += fineness * feather * static_cast<double>(colour[c]);
      }
    }
    return blends;
  }

  Sums sums(const Tile& tile, const std::vector<Texel>& texels,
            const std::vector<std::vector<double>>& opacity) const {
    Sums sums{0, 0, std::vector<double>(pieces_.size())};
    const auto& p = frame_.parameterization;
    for (int i = 0; i < tile.count(); ++i) {
      const double u = (tile.x + i % tile.width + 0.5) / frame_.size.width,
                   v = (tile.y + i / tile.width + 0.5) / frame_.size.height;
      if (!p.valid(tile.chart, u, v)) continue;
      const double area = p.solid_angle_density(tile.chart, u, v);
      sums.whole += area;
      sums.shown += area * texels[static_cast<std::size_t>(i)].shown;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        if (!opacity[k].empty())
          sums.shown_by[k] += area * std::min(opacity[k][static_cast<std::size_t>(i)], 1.0);
      }
    }
    return sums;
  }

  const std::span<const Piece> pieces_;
  const MapFrame& frame_;
  const AssembleOptions& options_;
  std::vector<std::size_t> order_;  ///< of the pieces, from behind
  bool behind_;                     ///< whether there is a fill
  std::vector<PieceTexels> texels_;
};

void check(const Piece& piece) {
  piece.map.check();
  require(piece.map.channels() == 4, "a piece has channels R G B A");
  require(piece.feather >= 0 && piece.feather <= kPi, "a piece's feather is 0 to π radians");
  require(piece.gain > 0 && std::isfinite(piece.gain), "a piece's gain is a positive number");
}

}  // namespace

Assembly assemble(std::span<const Piece> pieces, const MapFrame& frame, const AssembleOptions& options) {
  require(!pieces.empty(), "a world is assembled of at least one piece");
  require(is_orthonormal(frame.orientation), "a world is turned by a rotation or a reflection");
  for (const Piece& piece : pieces) check(piece);
  require(!options.fill || !options.alpha, "a map with alpha has no fill");
  for (const float value : options.fill.value_or(std::array<float, 3>{}))
    require(std::isfinite(value), "the fill is finite");
  Assembly made{Map(frame.parameterization, frame.size.width, frame.size.height, options.alpha ? 4 : 3), 0,
                std::vector<double>(pieces.size())};
  made.map.orientation = frame.orientation;
  const Assembler assembler(pieces, frame, options);
  const Tiles tiles(frame);
  std::vector<Sums> sums(static_cast<std::size_t>(tiles.count()));
  parallel_for(
      tiles.count(),
      [&](int number) {
        const Tile tile = tiles.at(number);
        sums[static_cast<std::size_t>(number)] = assembler.make(
            tile, made.map.level.chart(tile.chart).part(tile.x, tile.y, tile.width, tile.height));
      },
      options.monitor);
  double whole = 0;
  for (const Sums& each : sums) {
    whole += each.whole;
    made.shown += each.shown;
    for (std::size_t k = 0; k < pieces.size(); ++k) made.shown_by[k] += each.shown_by[k];
  }
  made.shown /= whole;
  for (double& shown : made.shown_by) shown /= whole;
  fill_borders(made.map);
  return made;
}

}  // namespace welkin
