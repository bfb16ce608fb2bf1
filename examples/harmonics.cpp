// Prints a map's irradiance as nine coefficients for three.js, nowhere negative: harmonics MAP
#include <welkin/harmonics/bases.h>
#include <welkin/harmonics/dering.h>
#include <welkin/harmonics/project.h>
#include <welkin/harmonics/zonal.h>
#include <welkin/map_file/map_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  namespace harmonics = welkin::harmonics;
  if (argc != 2) return std::fprintf(stderr, "usage: harmonics MAP\n"), 2;
  const welkin::Map map = welkin::read_map(argv[1]).map;
  const harmonics::Deringing light =
      harmonics::dering(harmonics::project(map, 2), harmonics::irradiance_factors(2));

  const harmonics::Basis& basis = harmonics::basis_from_name("three.js");
  const harmonics::BasisCoefficients coefficients =
      harmonics::to_basis(light.harmonics, basis, harmonics::world_of(basis));
  const std::size_t channels = coefficients.channel_names.size();
  for (std::size_t row = 0; row < basis.rows.size(); ++row) {
    std::printf("%-5s", basis.rows[row].c_str());
    for (std::size_t c = 0; c < channels; ++c) std::printf(" %.6g", coefficients.values[row * channels + c]);
    std::printf("\n");
  }
  std::printf("ringing removed: %.3g %% of irradiance\n", 100 * light.change);
} catch (const std::exception& error) {
  std::fprintf(stderr, "harmonics: %s\n", error.what());
  return 1;
}
