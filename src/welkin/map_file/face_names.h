#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// What other tools call the six files of a cube's faces.
namespace welkin::map_file {

/// A set of names, one of which stands in the place of a pattern's `%s`.
struct FaceNames {
  std::array<std::string, 6> faces;  ///< of +X −X +Y −Y +Z −Z
  bool axes = false;                 ///< they name the axes; of others it is a convention which face is which

  /// `right left top bottom front back`.
  std::string text() const;
};

/// All sets, in the order in which they are tried; the first is px nx py ny pz nz.
const std::vector<FaceNames>& known_face_names();

/// The first set of which the pattern's six files exist. Throws Error (not_found) where no set is complete:
/// about the first file that is missing of the fullest set, or about the pattern where there is no file at
/// all.
const FaceNames& find_face_names(const std::filesystem::path& pattern);

/// `sky_%s.png` for `sky_posx.png` where the other five of its set exist too; else empty.
std::filesystem::path pattern_of_face(const std::filesystem::path& file);

}  // namespace welkin::map_file
