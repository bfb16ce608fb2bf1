#include "welkin/harmonics/coefficients_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/base/number_text.h"
#include "welkin/harmonics/coefficients_file.h"

namespace welkin::harmonics {
namespace {

std::size_t channels_of(const BasisCoefficients& k) {
  return k.channel_names.size();
}
std::size_t rows_of(const BasisCoefficients& k) {
  return k.values.size() / channels_of(k);
}

/// Degree and order of a row.
struct Place {
  explicit Place(std::size_t row) {
    while (count_of(l) <= static_cast<int>(row)) ++l;
    m = static_cast<int>(row) - index_of(l, 0);
  }
  int l = 0, m = 0;
};

std::string row_name(const BasisCoefficients& k, std::size_t row) {
  const Basis& basis = basis_from_name(k.basis);
  if (!basis.rows.empty()) return basis.rows[row];
  const Place place(row);
  std::string name = "L";
  return name.append(std::to_string(place.l)).append(",").append(std::to_string(place.m));
}

/// The numbers of a row, `separator` between.
std::string numbers(const BasisCoefficients& k, std::size_t row, const std::string& separator,
                    const std::string& suffix = "") {
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < channels_of(k); ++c)
    parts.push_back(number_text(k.values[row * channels_of(k) + c]) + suffix);
  return listed(parts, separator);
}

std::string json_text(const CoefficientsFile& file) {
  const BasisCoefficients& k = file.coefficients;
  std::vector<std::string> names;
  for (const std::string& name : k.channel_names)
    names.push_back(std::string("\"").append(name).append("\""));
  std::string text = "{\n  \"order\": " + std::to_string(k.degree) + ",\n  \"basis\": \"" + k.basis +
                     "\",\n  \"of\": \"" + file.of + "\",\n  \"convention\": \"" + file.convention +
                     "\",\n  \"channels\": [" + listed(names, ", ") + "],\n  \"coefficients\": [\n";
  for (std::size_t row = 0; row < rows_of(k); ++row)
    text += "    [" + numbers(k, row, ", ") + (row + 1 < rows_of(k) ? "],\n" : "]\n");
  return text + "  ]\n}\n";
}

std::string csv_text(const CoefficientsFile& file) {
  const BasisCoefficients& k = file.coefficients;
  // A lobe's spec has commas of its own, and stands last.
  std::string text = "# order " + std::to_string(k.degree) + ", basis " + k.basis + ", convention " +
                     file.convention + ", of " + file.of + "\n";
  const bool places = basis_from_name(k.basis).rows.empty();
  text += std::string(places ? "l,m," : "name,") + listed(k.channel_names, ",") + "\n";
  for (std::size_t row = 0; row < rows_of(k); ++row) {
    const Place place(row);
    text += (places ? std::to_string(place.l) + "," + std::to_string(place.m) : row_name(k, row)) + "," +
            numbers(k, row, ",") + "\n";
  }
  return text;
}

/// A C literal: with a point or an exponent, and `f`.
std::string float_text(double value) {
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), static_cast<float>(value)).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::string c_header_text(const CoefficientsFile& file) {
  const BasisCoefficients& k = file.coefficients;
  const Basis& basis = basis_from_name(k.basis);
  std::string text = "/* Spherical harmonics of " + file.of + ", order " + std::to_string(k.degree) +
                     ", basis " + k.basis + ", convention " + file.convention + ".\n * " + basis.description +
                     " */\n#pragma once\n\n#define SH_ORDER " + std::to_string(k.degree) +
                     "\n\nstatic const float kSh[" + std::to_string(rows_of(k)) + "][" +
                     std::to_string(channels_of(k)) + "] = {\n";
  const auto row_of = [](const double* values, std::size_t count) {
    std::vector<std::string> parts;
    for (std::size_t c = 0; c < count; ++c) parts.push_back(float_text(values[c]));
    return "    {" + listed(parts, ", ") + "},";
  };
  for (std::size_t row = 0; row < rows_of(k); ++row)
    text += row_of(&k.values[row * channels_of(k)], channels_of(k)) + " /* " + row_name(k, row) + " */\n";
  text += "};\n";
  if ((k.basis != "unity" && k.basis != "unreal") || channels_of(k) != 3) return text;
  const std::vector<double> packed = packed_constants(k);
  constexpr const char* kNames[] = {"SHAr", "SHAg", "SHAb", "SHBr", "SHBg", "SHBb", "SHC"};
  text += "\nstatic const float kShPacked[7][4] = {\n";
  for (std::size_t i = 0; i < 7; ++i) text += row_of(&packed[4 * i], 4) + " /* " + kNames[i] + " */\n";
  return text + "};\n";
}

std::string fixed_text(double value) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 15).ptr;
  std::string text(buffer.data(), end);
  return text.size() < 18 ? std::string(18 - text.size(), ' ') + text : text;
}

std::string filament_text(const CoefficientsFile& file) {
  const BasisCoefficients& k = file.coefficients;
  require(k.basis == "filament", "Filament's text is of the basis filament");
  require(channels_of(k) == 3, "Filament's text has three channels");
  std::string text;
  for (std::size_t row = 0; row < rows_of(k); ++row) {
    const double* value = &k.values[row * 3];
    text += "(" + fixed_text(value[0]) + ", " + fixed_text(value[1]) + ", " + fixed_text(value[2]) +
            "); // " + row_name(k, row) + ", irradiance, pre-scaled base\n";
  }
  return text;
}

struct Extension {
  const char* name;
  CoefficientsFormat format;
};
constexpr Extension kExtensions[] = {{"json", CoefficientsFormat::json},
                                     {"csv", CoefficientsFormat::csv},
                                     {"h", CoefficientsFormat::c_header},
                                     {"txt", CoefficientsFormat::filament},
                                     {"filament", CoefficientsFormat::filament}};

}  // namespace

CoefficientsFormat coefficients_format(std::string_view name) {
  std::vector<std::string> names;
  for (const Extension& each : kExtensions) {
    if (each.name == name) return each.format;
    names.emplace_back(each.name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("format of coefficients", name, names));
}

bool is_coefficients_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot != std::string_view::npos &&
         std::any_of(std::begin(kExtensions), std::end(kExtensions),
                     [&](const Extension& each) { return path.substr(dot + 1) == each.name; });
}

std::string coefficients_text(const CoefficientsFile& file, CoefficientsFormat format) {
  switch (format) {
    case CoefficientsFormat::csv:
      return csv_text(file);
    case CoefficientsFormat::c_header:
      return c_header_text(file);
    case CoefficientsFormat::filament:
      return filament_text(file);
    default:
      return json_text(file);
  }
}

}  // namespace welkin::harmonics
