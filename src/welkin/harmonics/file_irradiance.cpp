#include "welkin/harmonics/file_irradiance.h"

#include <algorithm>
#include <iterator>

#include "welkin/base/error.h"
#include "welkin/harmonics/bases.h"
#include "welkin/harmonics/project.h"
#include "welkin/harmonics/zonal.h"

namespace welkin::harmonics {

std::vector<double> file_irradiance(const Map& map, std::string_view basis, const Matrix3& look_up,
                                    const lobe::AnyLobe& lobe) {
  constexpr int kDegree = 2;
  std::vector<double> factors = lobe_factors(lobe, kDegree);
  for (double& factor : factors) {
    // A lobe without a degree leaves nothing of it to bring back.
    factor = factor > 1e-3 ? 1 / factor : 0;
  }
  const SphericalHarmonics light = convolved(project(map, kDegree), factors);
  const BasisCoefficients stored = to_basis(light, basis_from_name(basis), look_up);
  const std::vector<std::string>& names = stored.channel_names;
  std::vector<std::size_t> order;
  for (const char* name : {"R", "G", "B"}) {
    auto found = std::find(names.begin(), names.end(), name);
    if (names.size() == 1) found = names.begin();
    if (found == names.end())
      throw Error(ErrorKind::unsupported,
                  "the diffuse light of such a file is of R, G and B, which the map lacks");
    order.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  std::vector<double> polynomial;
  for (std::size_t row = 0; row < stored.values.size() / names.size(); ++row) {
    for (const std::size_t channel : order) polynomial.push_back(stored.values[row * names.size() + channel]);
  }
  return polynomial;
}

}  // namespace welkin::harmonics
