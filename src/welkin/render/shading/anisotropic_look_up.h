#pragma once

#include <span>
#include <vector>

#include "welkin/render/path/ggx_lobe.h"
#include "welkin/render/shading/shading_look_ups.h"

/// Anisotropic GGX lobes by look-ups in a chain that is filtered with isotropic ones.
namespace welkin::scene {

/// One look-up of several.
struct LobeTap {
  Vec3d direction;   ///< in the world, of unit length
  double roughness;  ///< of the isotropic lobe
  double weight;     ///< of all: 1
};

/// The facets of a surface's lobe, along its grain and across; those of mirrors have a least width.
GgxFacets lobe_facets(const Surface& at);

/// The lobe as isotropic ones, of its smaller α, along its longer axis: at slopes t = α sinh u for even steps
/// of u, so that they lie as close to each other in the tails, where each is wider, as in the middle. Each
/// has its part of the facets, which is sech² u/2, weighted by what these show of the light (masking, and how
/// the viewer sees them). 1 … kMostLobeTaps of them; appended.
void append_lobe_taps(const Surface& at, std::vector<LobeTap>& taps);
inline constexpr int kMostLobeTaps = 48;

/// Radiance over the lobes of those surfaces that are anisotropic; others' is left as it is.
void look_up_anisotropic(const Worlds& worlds, std::span<const Surface> surfaces, std::span<Rgb> radiance);

}  // namespace welkin::scene
