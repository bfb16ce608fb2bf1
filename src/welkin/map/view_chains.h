#pragma once

#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/chain.h"

/// @file
/// Maps pre-filtered for several angles of view: a chain for each, and the tables to look them up with
/// (docs/view-dependent-lobes.md).
namespace welkin {

/// Numbers for every pair of an angle of view and a level.
struct ViewTable {
  int levels = 0;              ///< numbers of one angle of view
  std::vector<double> values;  ///< [view][level]

  /// The number of a view and a level, both of which there are.
  double at(std::size_t view, std::size_t level) const {
    return values[view * static_cast<std::size_t>(levels) + level];
  }
  /// Number by number.
  friend bool operator==(const ViewTable&, const ViewTable&) = default;
};

/// What the chains of a stack are for, besides each chain's own notes.
struct ViewNotes {
  std::string brdf;  ///< as brdf::AnyBrdf::make takes it, the roughness of a chain left out
  std::string axis;  ///< about which lobes were averaged: `reflected` or `fitted`
  /// n·v of each chain, ascending, over 0 and at most 1.
  std::vector<double> view_cosines;
  /// Where to look a level up: this part of the angle from the reflected direction to the normal.
  ViewTable lift;
  /// What to multiply by: the share of light from all around that is reflected.
  ViewTable albedo;
  /// Note by note.
  friend bool operator==(const ViewNotes&, const ViewNotes&) = default;
};

/// A stack. Moved, not copied.
struct ViewChains {
  /// One for each angle of view, alike in all but their texels. At least one.
  std::vector<Chain> views;
  /// What they are for.
  ViewNotes notes;

  /// Throws Error (mismatch) where the members don't belong together: another number of chains than angles,
  /// of table entries than there are levels, chains that differ in shape, size, channels or levels, angles
  /// that don't ascend in 0 … 1, tables that aren't finite.
  WELKIN_API void check() const;
};

/// n·v of `count` ≥ 1 angles of view, such that √(n·v) goes up evenly, each in the middle of its step: ((k +
/// ½)/count)². As the layers of a texture, √(n·v) is the coordinate to look them up with.
WELKIN_API std::vector<double> default_view_cosines(int count);

/// Between which two angles of view n·v lies, and how far from the first to the second, in √(n·v).
struct ViewPosition {
  std::size_t below = 0;  ///< the first
  std::size_t above = 0;  ///< the second; the same before the first angle and beyond the last
  double part = 0;        ///< 0 … 1
};
/// `cosines` ascend; at least one.
WELKIN_API ViewPosition view_position(const std::vector<double>& cosines, double view_cosine);

}  // namespace welkin
