#pragma once

#include <string>

#include "command.h"
#include "welkin/harmonics/bases.h"

namespace welkin::cli {

/// Options of what `sh` writes: coefficients, or a map of them.
struct ShOutput {
  std::string out = "-", format, basis, convention, to = "latlong", size = "256";
  WriteFlags write;

  void add(Command command);
  /// Finds out before any work whether it can be written. Throws UsageError, Error.
  void check();
  bool is_text() const;
  bool is_stdout() const { return out == "-"; }
  const harmonics::Basis& chosen_basis() const {
    return harmonics::basis_from_name(basis);
  }  ///< after check()
  /// Harmonics of the native world. `report` is a member for JSON on standard output; may be empty.
  void write_harmonics(const harmonics::SphericalHarmonics& stored, const std::string& of,
                       const std::string& report) const;

 private:
  void write_text(const harmonics::SphericalHarmonics& stored, const std::string& of,
                  const std::string& report) const;
  void write_picture(const harmonics::SphericalHarmonics& stored) const;
};

}  // namespace welkin::cli
