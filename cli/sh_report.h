#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "welkin/harmonics/dering.h"
#include "welkin/harmonics/error_of.h"
#include "welkin/harmonics/zonal.h"

namespace welkin::cli {

/// What `sh` tells beside the coefficients.
struct ShReport {
  std::string of;                                  ///< that the error is of: `irradiance`, or a lobe
  harmonics::SphericalHarmonics radiance;          ///< whose linear part and zonal fit are told
  std::optional<harmonics::HarmonicsError> error;  ///< where there was a map
  double beyond = 0;  ///< the most that degrees which the error leaves out add to its RMSE
  std::optional<harmonics::Deringing> deringing;
};

nlohmann::ordered_json json_of(const ShReport& report);

/// The same in words, a few lines on stderr that begin with the name of the input.
void print(const std::string& in, const ShReport& report);

}  // namespace welkin::cli
