#include "welkin/io/colour/code_points.h"

#include <string>

namespace welkin::io {
namespace {

constexpr int kBt709 = 1, kUnspecified = 2;

void declare_transfer(int transfer, Declared& declared, FileInfo& info) {
  const auto curve = [&](Curve curve, double gamma = 1) {
    info.colour = Colour::linear;
    declared.curve = curve;
    declared.gamma = gamma;
  };
  const auto srgb = [&](const char* meaning) {
    info.colour = Colour::srgb;
    declared.curve = Curve::none;
    declared.gamma = 1;
    if (meaning == nullptr) return;
    info.warnings.push_back("its transfer function is number " + std::to_string(transfer) +
                            " of ITU-T H.273 (" + meaning + "), which is not undone; sRGB is assumed");
  };
  switch (transfer) {
    // 11 and 12 go on below 0 and above 1, where an unsigned value isn't; within they are BT.709's. 14 and 15
    // are BT.709's in ten and twelve bits.
    case 1:
    case 6:
    case 11:
    case 12:
    case 14:
    case 15:
      return curve(Curve::bt709);
    case 4:
      return curve(Curve::gamma, 2.2);
    case 5:
      return curve(Curve::gamma, 2.8);
    case 7:
      return srgb("SMPTE 240M");
    case 8:
      return curve(Curve::none);
    case 9:
      return srgb("logarithmic, 100:1");
    case 10:
      return srgb("logarithmic, 316:1");
    case kUnspecified:
    case 13:
      return srgb(nullptr);
    case 16:
      return curve(Curve::pq);
    case 17:
      // SMPTE ST 428-1 without its 52.37/48, so that the largest value is 1.
      return curve(Curve::gamma, 2.6);
    case 18:
      return curve(Curve::hlg);
    default:
      return srgb("reserved");
  }
}

}  // namespace

std::optional<Chromaticities> chromaticities_of(int primaries) {
  constexpr double kC[2] = {0.310, 0.316}, kD65[2] = {0.3127, 0.3290};
  switch (primaries) {
    case kBt709:
      return {{{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, {kD65[0], kD65[1]}}};
    case 4:  // BT.470 system M, NTSC of 1953
      return {{{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {kC[0], kC[1]}}};
    case 5:  // BT.470 system B, G; BT.601 of 625 lines
      return {{{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {kD65[0], kD65[1]}}};
    case 6:  // SMPTE 170M; BT.601 of 525 lines
    case 7:  // SMPTE 240M
      return {{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {kD65[0], kD65[1]}}};
    case 8:  // film, by Wratten's filters 25, 58 and 47
      return {{{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, {kC[0], kC[1]}}};
    case 9:  // BT.2020, BT.2100
      return {{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {kD65[0], kD65[1]}}};
    case 10:  // SMPTE ST 428-1: CIE XYZ
      return {{{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}};
    case 11:  // SMPTE RP 431-2: P3 of cinemas
      return {{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}};
    case 12:  // SMPTE EG 432-1: P3 of displays
      return {{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {kD65[0], kD65[1]}}};
    case 22:  // EBU Tech 3213-E
      return {{{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, {kD65[0], kD65[1]}}};
    default:
      return {};
  }
}

void declare_code_points(int primaries, int transfer, Declared& declared, FileInfo& info) {
  declare_transfer(transfer, declared, info);
  declared.primaries = primaries == kBt709 ? std::nullopt : chromaticities_of(primaries);
  if (primaries != kBt709 && primaries != kUnspecified && !declared.primaries) {
    info.warnings.push_back("its colour primaries are number " + std::to_string(primaries) +
                            " of ITU-T H.273 (reserved); BT.709's are assumed");
  }
}

}  // namespace welkin::io
