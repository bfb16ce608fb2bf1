#include "welkin/harmonics/bases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/sphere/convention.h"

namespace welkin::harmonics {
namespace {

/// Nine coefficients of nine.
using Rows = std::array<std::array<double, 9>, 9>;

/// Factors of the polynomials 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y² in Y_lm.
std::array<double, 9> polynomial_factors() {
  const double one = std::sqrt(3 / (4 * kPi)), two = std::sqrt(15 / (4 * kPi));
  return {std::sqrt(1 / (4 * kPi)), one, one, one, two, two, std::sqrt(5 / (16 * kPi)), two, two / 2};
}

int degree_of(std::size_t index) {
  return index == 0 ? 0 : index < 4 ? 1 : 2;
}

/// A_l/π of an index.
double cosine(std::size_t index) {
  static const std::vector<double> factors = irradiance_factors(2);
  return factors[static_cast<std::size_t>(degree_of(index))] / kPi;
}

/// −1 of odd m, in bases with the sign (−1)^m.
double sign(std::size_t index) {
  return index == 1 || index == 3 || index == 5 || index == 7 ? -1 : 1;
}

template <class Factor>
Rows diagonal(const Factor& factor, const std::array<std::size_t, 9>& order = {0, 1, 2, 3, 4, 5, 6, 7, 8}) {
  Rows rows{};
  for (std::size_t row = 0; row < 9; ++row) rows[row][order[row]] = factor(order[row]);
  return rows;
}

/// E/π as a polynomial that is evaluated without constants.
double folded(std::size_t index) {
  return cosine(index) * polynomial_factors()[index];
}

/// x, y, z, xx, yy, zz, yz, zx, xy of the polynomial of radiance (A_l/π)² L_lm: the renderer divides by
/// neither, but makes harmonics of it by A_l/π again.
Rows babylon_rows() {
  Rows rows{};
  const auto k = [](std::size_t index) { return cosine(index) * folded(index); };
  rows[0][3] = k(3);
  rows[1][1] = k(1);
  rows[2][2] = k(2);
  for (const std::size_t row : {3u, 4u, 5u}) {
    rows[row][0] = k(0);
    rows[row][6] = row == 5 ? 2 * k(6) : -k(6);
  }
  rows[3][8] = k(8);
  rows[4][8] = -k(8);
  rows[6][5] = k(5);
  rows[7][7] = k(7);
  rows[8][4] = k(4);
  return rows;
}

struct Entry {
  Basis basis;
  Rows rows;
};

const std::vector<std::string> kPlain{"L00", "L1-1", "L10", "L11", "L2-2", "L2-1", "L20", "L21", "L22"};

std::vector<Entry> make_entries() {
  const auto signed_irradiance = [](std::size_t index) { return kPi * cosine(index) * sign(index); };
  return {
      {{"orthonormal",
        "L_lm of radiance, all signs +, any degree",
        "native",
        kMaxDegree,
        {},
        "docs/harmonics.md"},
       {}},
      {{"filament", "E/π as a polynomial, pre-scaled: IndirectLight::Builder::irradiance, cmgen's text",
        "native", 2, kPlain,
        "google/filament, libs/ibl/src/CubemapSH.cpp, computeIrradianceSH3Bands; IndirectLight.h"},
       diagonal(folded)},
      {{"three.js", "L_lm of radiance, all signs +: LightProbe, SphericalHarmonics3", "native", 2, kPlain,
        "mrdoob/three.js, src/math/SphericalHarmonics3.js, getIrradianceAt"},
       diagonal([](std::size_t) { return 1.0; })},
      {{"unity", "E/π as a polynomial: SphericalHarmonicsL2", "unity", 2, kPlain,
        "Unity-Technologies/Graphics, SphericalHarmonics.cs, PackCoefficients; EntityLighting.hlsl, "
        "SampleSH9"},
       diagonal(folded)},
      {{"unreal",
        "L_lm of radiance with the sign (−1)^m: FSHVectorRGB3::V",
        "unreal",
        2,
        {"V0", "V1", "V2", "V3", "V4", "V5", "V6", "V7", "V8"},
        "EpicGames/UnrealEngine, SceneRendering.cpp, SetupSkyIrradianceEnvironmentMapConstants; "
        "ReflectionEnvironmentShared.ush, GetSkySHDiffuse"},
       diagonal(sign)},
      {{"babylon",
        "SphericalPolynomial, for left-handed scenes: (A_l/π)² L_lm as a polynomial",
        "unity",
        2,
        {"x", "y", "z", "xx", "yy", "zz", "yz", "zx", "xy"},
        "BabylonJS/Babylon.js, packages/dev/core/src/Maths/sphericalPolynomial.ts, FromHarmonics, "
        "FromPolynomial"},
       babylon_rows()},
      {{"playcanvas",
        "E/π as a polynomial, in another order: ambientSH",
        "native",
        2,
        {"1", "x", "y", "z", "xz", "zy", "yx", "3zz-1", "xx-yy"},
        "playcanvas/engine, src/scene/shader-lib/glsl/chunks/lit/frag/ambient.js"},
       diagonal(folded, {0, 3, 1, 2, 7, 5, 4, 6, 8})},
      {{"gltf", "E_lm of irradiance with the sign (−1)^m: EXT_lights_image_based", "native", 2, kPlain,
        "KhronosGroup/glTF, extensions/2.0/Vendor/EXT_lights_image_based/README.md, which leaves the signs "
        "open; "
        "BabylonJS/Babylon.js, packages/dev/core/src/Maths/sphericalPolynomial.ts, SphericalHarmonics"},
       diagonal(signed_irradiance)},
  };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = make_entries();
  return all;
}

const Entry& entry_of(std::string_view name) {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) {
    if (entry.basis.name == name) return entry;
    names.push_back(entry.basis.name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("basis", name, names));
}

/// The inverse, by Gauss and Jordan.
Rows inverse(Rows m) {
  Rows result{};
  for (std::size_t i = 0; i < 9; ++i) result[i][i] = 1;
  for (std::size_t column = 0; column < 9; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column; row < 9; ++row) {
      if (std::fabs(m[row][column]) > std::fabs(m[pivot][column])) pivot = row;
    }
    std::swap(m[pivot], m[column]);
    std::swap(result[pivot], result[column]);
    const double scale = 1 / m[column][column];
    for (std::size_t k = 0; k < 9; ++k) {
      m[column][k] *= scale;
      result[column][k] *= scale;
    }
    for (std::size_t row = 0; row < 9; ++row) {
      const double factor = m[row][column];
      if (row == column || factor == 0) continue;
      for (std::size_t k = 0; k < 9; ++k) {
        m[row][k] -= factor * m[column][k];
        result[row][k] -= factor * result[column][k];
      }
    }
  }
  return result;
}

std::vector<double> multiply(const Rows& rows, std::span<const double> values, std::size_t channels) {
  std::vector<double> result(9 * channels);
  for (std::size_t row = 0; row < 9; ++row) {
    for (std::size_t k = 0; k < 9; ++k) {
      if (rows[row][k] == 0) continue;
      for (std::size_t c = 0; c < channels; ++c)
        result[row * channels + c] += rows[row][k] * values[k * channels + c];
    }
  }
  return result;
}

}  // namespace

const std::vector<Basis>& bases() {
  static const std::vector<Basis> all = [] {
    std::vector<Basis> list;
    for (const Entry& entry : entries()) list.push_back(entry.basis);
    return list;
  }();
  return all;
}

const Basis& basis_from_name(std::string_view name) {
  return entry_of(name).basis;
}

Matrix3 world_of(const Basis& basis) {
  return convention_from_name(basis.convention).lookup;
}

BasisCoefficients to_basis(const SphericalHarmonics& radiance, const Basis& basis, const Matrix3& world) {
  const Entry& entry = entry_of(basis.name);
  SphericalHarmonics turned = rotated(radiance, world);
  BasisCoefficients result{basis.name, turned.degree(), turned.channel_names, {}};
  if (entry.basis.rows.empty()) {
    result.values.assign(turned.values().begin(), turned.values().end());
    return result;
  }
  result.degree = entry.basis.degree;
  turned = with_degree(turned, result.degree);
  result.values = multiply(entry.rows, turned.values(), static_cast<std::size_t>(turned.channels()));
  return result;
}

SphericalHarmonics from_basis(const BasisCoefficients& coefficients, const Matrix3& world) {
  const Entry& entry = entry_of(coefficients.basis);
  const bool any = entry.basis.rows.empty();
  SphericalHarmonics result(any ? coefficients.degree : entry.basis.degree,
                            static_cast<int>(coefficients.channel_names.size()));
  result.channel_names = coefficients.channel_names;
  if (coefficients.values.size() != result.values().size())
    throw Error(ErrorKind::mismatch, "basis " + entry.basis.name + " has " + std::to_string(result.count()) +
                                         " coefficients of " + std::to_string(result.channels()) +
                                         (result.channels() == 1 ? " channel" : " channels") + ", not " +
                                         std::to_string(coefficients.values.size()) + " numbers");
  const std::vector<double> values =
      any ? coefficients.values
          : multiply(inverse(entry.rows), coefficients.values, static_cast<std::size_t>(result.channels()));
  std::copy(values.begin(), values.end(), result.values().begin());
  return rotated(result, transpose(world));
}

std::vector<double> packed_constants(const BasisCoefficients& coefficients) {
  const bool unreal = coefficients.basis == "unreal";
  require(unreal || coefficients.basis == "unity", "only unity and unreal pack their coefficients");
  require(coefficients.channel_names.size() == 3 && coefficients.values.size() == 27,
          "nine coefficients of three channels are packed");
  std::vector<double> packed;
  const auto value = [&](std::size_t index, std::size_t c) {
    const double factor = unreal ? sign(index) * folded(index) : 1;
    return factor * coefficients.values[index * 3 + c];
  };
  for (std::size_t c = 0; c < 3; ++c)
    packed.insert(packed.end(), {value(3, c), value(1, c), value(2, c), value(0, c) - value(6, c)});
  for (std::size_t c = 0; c < 3; ++c)
    packed.insert(packed.end(), {value(4, c), value(5, c), 3 * value(6, c), value(7, c)});
  packed.insert(packed.end(), {value(8, 0), value(8, 1), value(8, 2), 1});
  return packed;
}

}  // namespace welkin::harmonics
