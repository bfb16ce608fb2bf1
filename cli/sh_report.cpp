#include "sh_report.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "progress.h"

namespace welkin::cli {
namespace {

using harmonics::Extremum;
using nlohmann::ordered_json;

/// Fits of more degrees take long.
constexpr int kZonalDegree = 8;

ordered_json json_of(const Vec3d& d) {
  return {d.x, d.y, d.z};
}

/// The channel with the least value, as a share of its mean.
std::size_t least_of(const harmonics::HarmonicsError& error) {
  return static_cast<std::size_t>(
      std::min_element(error.minima.begin(), error.minima.end(),
                       [](const Extremum& a, const Extremum& b) { return a.value < b.value; }) -
      error.minima.begin());
}

}  // namespace

ordered_json json_of(const ShReport& report) {
  ordered_json result{{"of", report.of}};
  if (report.error) {
    result["relative_rmse"] = report.error->relative_rmse;
    result["relative_rmse_beyond"] = report.beyond;
    for (const Extremum& least : report.error->minima) result["minima"].push_back(least.value);
    result["minimum"] = report.error->minima[least_of(*report.error)].value;
    result["minimum_direction"] = json_of(report.error->minima[least_of(*report.error)].direction);
    result["means"] = report.error->means;
  }
  if (report.deringing)
    result["deringing"] = {{"change", report.deringing->change}, {"factors", report.deringing->factors}};
  const harmonics::LinearPart linear = linear_part(harmonics::luminance_of(report.radiance), 0);
  result["linear"] = {
      {"direction", json_of(linear.direction)}, {"ratio", linear.ratio}, {"mean", linear.mean}};
  if (report.radiance.degree() <= kZonalDegree) {
    const harmonics::ZonalFit fit = fit_zonal(report.radiance, report.radiance.degree());
    ordered_json rows = ordered_json::array();
    const auto channels = static_cast<std::ptrdiff_t>(report.radiance.channels());
    for (auto row = fit.coefficients.begin(); row != fit.coefficients.end(); row += channels)
      rows.push_back(std::vector<double>(row, row + channels));
    result["zonal"] = {{"axis", json_of(fit.axis)}, {"coefficients", rows}, {"error", fit.error}};
  }
  return result;
}

void print(const std::string& in, const ShReport& report) {
  std::string text;
  if (report.error) {
    const std::size_t c = least_of(*report.error);
    const Extremum& least = report.error->minima[c];
    // Their squares add up: less than this changes what is told by less than a fiftieth.
    const std::string beyond =
        report.beyond > 0.2 * report.error->relative_rmse
            ? fmt::format(" and of higher degrees at most {:.2g} %", 100 * report.beyond)
            : "";
    text += fmt::format(
        "welkin: {}: {}: relative RMSE {:.4g} %{}, least value {:.4g} ({}, mean {:.4g}) along "
        "{:.3f},{:.3f},{:.3f}\n",
        in, report.of, 100 * report.error->relative_rmse, beyond, least.value,
        report.radiance.channel_names[c], report.error->means[c], least.direction.x, least.direction.y,
        least.direction.z);
  }
  if (report.deringing && report.deringing->change > 0) {
    text += fmt::format("welkin: {}: deringing changes it by {:.4g} %, factors of the degrees", in,
                        100 * report.deringing->change);
    for (std::size_t c = 0; c < report.deringing->factors.size(); ++c) {
      const std::vector<double>& factors = report.deringing->factors[c];
      text += fmt::format("{} {} {:.3f}", c == 0 ? ":" : ";", report.radiance.channel_names[c],
                          fmt::join(factors.begin(),
                                    factors.begin() + std::min<std::ptrdiff_t>(
                                                          9, static_cast<std::ptrdiff_t>(factors.size())),
                                    " "));
    }
    text += "\n";
  }
  print_message(text);
}

}  // namespace welkin::cli
