#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/brdf/dfg.h"
#include "welkin/brdf/table_axis.h"
#include "welkin/image/image.h"

/// @file
/// Two-dimensional tables over n·v and roughness: the integrals of dfg.h as renderers read them.
namespace welkin::brdf {

/// Which coordinate, 0…1, stands for n·v.
enum class CosineScale {
  linear,  ///< u = n·v
  root,    ///< u = √n·v, finer at grazing angles
};

/// Which coordinate, 0…1, stands for the roughness.
enum class RoughnessScale {
  perceptual,  ///< v = roughness
  alpha,       ///< v = α = roughness²
};

/// What a channel holds.
enum class DfgChannel {
  scale,           ///< ∫ f (n·l) dω with F = 1 − Fc: what f0 is multiplied by
  bias,            ///< with F = Fc: what f90 is multiplied by
  one,             ///< with F = 1: scale + bias, the directional albedo E
  missing,         ///< 1 − E: what further scattering must add (Kulla & Conty 2017)
  cloth,           ///< Charlie's, ClothMasking::neubelt
  sheen,           ///< Charlie's, ClothMasking::charlie
  disney_diffuse,  ///< Disney's diffuse term less ½
  zero,            ///< 0
};

/// `scale`, `bias`, `one`, `missing`, `cloth`, `sheen`, `disney-diffuse`, `zero`.
WELKIN_API std::string_view name_of(DfgChannel channel);
/// The channel of that name. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API DfgChannel dfg_channel_from_name(std::string_view name);
/// Names of all of them.
WELKIN_API std::vector<std::string> dfg_channel_names();

/// `correlated`, `separable`, `schlick`, `approximate`.
WELKIN_API std::string_view name_of(GgxMasking masking);
/// The masking of that name. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API GgxMasking ggx_masking_from_name(std::string_view name);

/// A table's axes and contents. The top left texel is that of n·v and roughness nearest to 0.
struct WELKIN_API DfgTable {
  int width = 128;                                        ///< texels, 1…4096
  int height = 128;                                       ///< rows, 1…4096
  bool cosine_down = false;                               ///< n·v runs down and roughness right
  CosineScale cosine = CosineScale::linear;               ///< of n·v
  RoughnessScale roughness = RoughnessScale::perceptual;  ///< of the roughness
  TexelPlacement placement = TexelPlacement::centres;     ///< on both axes
  GgxMasking masking = GgxMasking::correlated;            ///< of scale, bias, one and missing
  std::vector<DfgChannel> channels = {DfgChannel::scale, DfgChannel::bias};  ///< one to four

  /// The n·v and the roughness that a texel stands for.
  /// @{
  double cosine_at(int x, int y) const;
  double roughness_at(int x, int y) const;
  /// @}
};

/// The largest side of a table.
inline constexpr int kLargestDfgSide = 4096;

/// One channel's value at one place, by the functions of dfg.h: the reference for make_dfg_table. Throws what
/// these throw.
WELKIN_API double dfg_value(DfgChannel channel, double nv, double roughness,
                            GgxMasking masking = GgxMasking::correlated);

/// The table, as float. Of each roughness, the integrals at the lowest n·v are found one by one, those above
/// by interpolation between Chebyshev's points. Error against dfg_value 1e-6, of cloth 1e-5: absolute, for
/// cloth and sheen relative above 1. The same on any number of threads. Throws Error (bad_request) for sizes
/// out of range and for no channels, or more than four; Cancelled, as the monitor asks.
WELKIN_API Image make_dfg_table(const DfgTable& table, const Monitor& monitor = {});

}  // namespace welkin::brdf
