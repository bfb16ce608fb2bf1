#pragma once

#include <memory>
#include <vector>

#include "welkin/assemble/piece.h"
#include "welkin/filter/texel_maker.h"

/// A piece as the texels of a frame see it. Internal to the room.
namespace welkin {

/// Some texels of a frame: a rectangle of a chart, and where they lie in the world.
struct Tile {
  /// A side at most. Filter::automatic makes blocks of so many texels together.
  static constexpr int kSide = 24;

  int chart = 0, x = 0, y = 0, width = 0, height = 0;
  std::vector<Vec3d> directions;  ///< of the texels' centres, row by row
  Vec3d centre{0, 0, 1};          ///< of the tile
  double radius = 0;              ///< radians: no texel's centre is farther from the tile's
  double texel = 0;               ///< radians: no farther from a texel's centre does it reach

  int count() const { return width * height; }
};

/// The tiles of a frame, by number.
class Tiles {
 public:
  explicit Tiles(const MapFrame& frame);
  int count() const;
  Tile at(int number) const;

 private:
  const MapFrame frame_;
  const Matrix3 to_world_;
  int columns_, rows_;
};

class PieceTexels {
 public:
  /// The piece outlives this.
  PieceTexels(const Piece& piece, const MapFrame& frame);

  /// What the texels of a tile see of it: the means of its R G B A, gain applied, and of each its feather.
  /// Both have room for Tile::count() texels. False, and nothing is written, where it shows none of them.
  bool make(const Tile& tile, float* colours, double* feathers) const;

  /// How finely it is sampled along a direction of the world that it shows: texels per radian, squared,
  /// across where they are longest. Near the rim of a mirror ball that is few, though they are many per
  /// steradian.
  double fineness(const Vec3d& direction) const;
  /// The same of a tile's texels, as it changes slowly: every eighth, and linear between them.
  std::vector<double> fineness(const Tile& tile) const;

 private:
  /// Of a tile's texel: its feather, or −1 where nothing is seen of it.
  double feather_at(const Tile& tile, std::size_t texel) const;

  const Piece& piece_;
  std::unique_ptr<TexelMaker> maker_;
};

}  // namespace welkin
