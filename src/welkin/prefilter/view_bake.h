#pragma once

#include <memory>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/view_lobe.h"
#include "welkin/map/view_chains.h"
#include "welkin/prefilter/bake.h"

/// @file
/// From a map to a stack: the map pre-filtered with a BRDF's lobe as it is seen from several angles
/// (docs/view-dependent-lobes.md).
namespace welkin {

/// What is baked.
struct ViewBakeOptions {
  /// What reflects. Of a chain, its roughness is each level's; a BRDF without roughness makes one level.
  brdf::AnyBrdf brdf = brdf::AnyBrdf::make("ggx");
  /// n·v of each chain, ascending, over 0 and at most 1.
  std::vector<double> view_cosines = default_view_cosines(16);
  /// About which axis a lobe is averaged.
  brdf::LobeAxis axis = brdf::LobeAxis::fitted;
  /// Size, levels, curve, target, and how to filter; `lobe` isn't used, and scale must be average. The
  /// default tolerance is 0.5 %: symmetric lobes are several per cent off in any case.
  BakeOptions bake = {.prefilter = {.tolerance = 5e-3}};
};

/// All of a stack that depends on sizes and the BRDF alone, kept for any number of maps; one analysis of a
/// map serves all angles and levels. Never changes; safe from many threads.
class WELKIN_API ViewBakePlan {
 public:
  /// For sources of this shape. Throws as BakePlan does, as brdf::average_lobe does, and Error (bad_request)
  /// for cosines that don't ascend in 0 … 1, or more than 256 of them.
  ViewBakePlan(const PrefilterShape& source, const ViewBakeOptions& options = {});

  /// The stack of a map, whose borders are filled. Throws as PrefilterPlan::run does.
  ViewChains run(const Map& source, const Monitor& monitor = {}) const;

  /// The lobe of a view and a level; valid as long as the plan.
  const lobe::AnyLobe& lobe_of(std::size_t view, std::size_t level) const;
  /// How many levels each chain has.
  std::size_t levels() const { return sizes_.size(); }
  /// What will be noted, the tables too; valid as long as the plan.
  const ViewNotes& notes() const { return notes_; }
  /// What there is to tell of the BRDF, in words: what was assumed of a measured one, where it reflects more
  /// than it gets.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Made;
  ViewBakePlan(const PrefilterShape& source, const ViewBakeOptions& options, Made made);

  std::vector<ChartSize> sizes_;
  ChainNotes chain_notes_;
  ViewNotes notes_;
  std::vector<std::string> warnings_;
  std::vector<std::size_t> index_;  ///< [view][level] → which of the plan's levels
  std::vector<PrefilterLevel> filtered_;
  std::shared_ptr<const PrefilterPlan> plan_;
};

/// Plans and runs once, without a channel A beside R G B. Throws as ViewBakePlan does.
WELKIN_API ViewChains bake_views(const Map& source, const ViewBakeOptions& options = {},
                                 const Monitor& monitor = {});

}  // namespace welkin
