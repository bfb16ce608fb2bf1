#pragma once

#include <array>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/render/probes/probe_grid.h"

/// @file
/// Probes as NVIDIA's RTXGI-DDGI (version 1.3) keeps them, for a volume that isn't traced any more. Source:
/// its SDK, `ProbeOctahedral.hlsl`, `ProbeIndexing.hlsl`, `ProbeBlendingCS.hlsl`, `Irradiance.hlsl`,
/// `DDGIVolume.cpp`, coordinate system `RTXGI_COORDINATE_SYSTEM_RIGHT`; Majercik, Guertin, Nowrouzezahrai &
/// McGuire 2019.
namespace welkin::scene {

/// From the world to our octahedral map: RTXGI's octahedron has +Z at its centre, +X on the right, +Y below.
WELKIN_API Matrix3 rtxgi_orientation();

/// What RTXGI loads: irradiance of 6×6 texels and distances of 14×14, a border of one texel, the cosine to
/// the 50th power, distances up to one and a half diagonals of a cell; no radiance.
WELKIN_API ProbeGridOptions rtxgi_options();

/// What probeIrradianceEncodingGamma is by default.
inline constexpr double kRtxgiGamma = 5;

/// A texture array, its slices one below the other.
struct RtxgiTexture {
  std::string name;                   ///< `irradiance`, `distance`, `data`
  std::vector<std::string> channels;  ///< R G B A, or R G
  int slices = 0;                     ///< planes of probes: counts[1], from the lowest on
  Image image;                        ///< `slices` pictures, each of counts[0] by counts[2] tiles
};

/// The volume's textures of a grid that was made with rtxgi_options, other sizes allowed: `irradiance`,
/// (E/2π)^(1/γ), A = 1; `distance`, half of the mean distance and half of the mean square; `data`, one texel
/// a probe, offset 0 and in A the state: 1, inactive, of probes inside bodies, else 0. Throws Error
/// (bad_request) for a grid of another orientation or border, without diffuse light or distances, or a γ
/// outside 1 … 100.
WELKIN_API std::vector<RtxgiTexture> rtxgi_textures(const ProbeGrid& grid, double gamma = kRtxgiGamma);

/// What DDGIVolumeDesc is to be given, as JSON: origin (the middle of the volume), probeSpacing, probeCounts,
/// numbers of texels, probeDistanceExponent, probeIrradianceEncodingGamma; and which file each texture is in.
WELKIN_API std::string rtxgi_json(const ProbeGrid& grid, const std::vector<std::string>& files,
                                  double gamma = kRtxgiGamma);

}  // namespace welkin::scene
