#include "welkin/map_file/face_names.h"

#include <algorithm>
#include <cctype>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin::map_file {
namespace {

namespace fs = std::filesystem;

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// `right` → `Right`, `posx` → `Posx`.
std::string capitalised(const std::string& text) {
  return upper(text.substr(0, 1)) + text.substr(1);
}

/// `posx` → `posX`, `positive_x` → `positive_X`.
std::string with_large_axis(const std::string& text) {
  return text.substr(0, text.size() - 1) + upper(text.substr(text.size() - 1));
}

std::vector<FaceNames> make_all() {
  std::vector<FaceNames> all;
  const auto add = [&](const FaceNames& names, auto change) {
    FaceNames changed = names;
    for (std::string& face : changed.faces) face = change(face);
    const bool known = std::any_of(all.begin(), all.end(),
                                   [&](const FaceNames& each) { return each.faces == changed.faces; });
    if (!known) all.push_back(changed);
  };
  const FaceNames sets[] = {
      {{"px", "nx", "py", "ny", "pz", "nz"}, true},
      {{"posx", "negx", "posy", "negy", "posz", "negz"}, true},
      {{"pos_x", "neg_x", "pos_y", "neg_y", "pos_z", "neg_z"}, true},
      {{"pos-x", "neg-x", "pos-y", "neg-y", "pos-z", "neg-z"}, true},
      {{"positive_x", "negative_x", "positive_y", "negative_y", "positive_z", "negative_z"}, true},
      {{"positive-x", "negative-x", "positive-y", "negative-y", "positive-z", "negative-z"}, true},
      {{"positivex", "negativex", "positivey", "negativey", "positivez", "negativez"}, true},
      {{"xpos", "xneg", "ypos", "yneg", "zpos", "zneg"}, true},
      {{"+x", "-x", "+y", "-y", "+z", "-z"}, true},
      {{"x+", "x-", "y+", "y-", "z+", "z-"}, true},
      {{"px", "mx", "py", "my", "pz", "mz"}, true},
      // As graphics libraries list them: three.js, Unity.
      {{"right", "left", "top", "bottom", "front", "back"}},
      {{"right", "left", "up", "down", "front", "back"}},
      {{"righttex", "lefttex", "uptex", "downtex", "fronttex", "backtex"}},
      {{"RightTex", "LeftTex", "UpTex", "DownTex", "FrontTex", "BackTex"}},
      {{"rt", "lf", "up", "dn", "fr", "bk"}},
      {{"r", "l", "u", "d", "f", "b"}},
      // Quake and its descendants: rt is straight ahead, what is to the right of it is ft (gl_warp.c,
      // st_to_vec and skytexorder).
      {{"ft", "bk", "up", "dn", "rt", "lf"}},
      {{"0", "1", "2", "3", "4", "5"}},
      {{"1", "2", "3", "4", "5", "6"}},
      {{"face0", "face1", "face2", "face3", "face4", "face5"}},
      {{"face1", "face2", "face3", "face4", "face5", "face6"}},
  };
  for (const FaceNames& names : sets) {
    add(names, [](const std::string& face) { return face; });
    if (names.axes) add(names, with_large_axis);
    add(names, capitalised);
    if (names.axes) add(names, [](const std::string& face) { return capitalised(with_large_axis(face)); });
    add(names, upper);
  }
  return all;
}

/// Also of a file about which the system says nothing: opening it will tell why.
bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::status(file, error).type() != fs::file_type::not_found;
}

/// How many of the six files exist.
long count_there(const fs::path& pattern, const FaceNames& names) {
  return std::count_if(names.faces.begin(), names.faces.end(),
                       [&](const std::string& face) { return is_there(chart_path(pattern, face)); });
}

}  // namespace

std::string FaceNames::text() const {
  return listed(faces);
}

const std::vector<FaceNames>& known_face_names() {
  static const std::vector<FaceNames> all = make_all();
  return all;
}

const FaceNames& find_face_names(const fs::path& pattern) {
  const FaceNames* fullest = nullptr;
  long most = 0;
  for (const FaceNames& names : known_face_names()) {
    const long count = count_there(pattern, names);
    if (count == 6) return names;
    if (count <= most) continue;
    most = count;
    fullest = &names;
  }
  if (fullest == nullptr) {
    const auto name = [&](const char* face) { return chart_path(pattern.filename(), face).string(); };
    throw Error(ErrorKind::not_found, pattern.string(),
                "none of " + name("px") + ", " + name("posx") + ", " + name("right") + ", " + name("0") +
                    "… exists, which %s could stand for");
  }
  std::string there, missing;
  for (const std::string& face : fullest->faces) {
    const fs::path file = chart_path(pattern, face);
    std::string& first = is_there(file) ? there : missing;
    if (first.empty()) first = file.string();
  }
  throw Error(ErrorKind::not_found, missing,
              "No such file or directory; of six faces, " + std::to_string(most) + " exist, as " +
                  fs::path(there).filename().string());
}

fs::path pattern_of_face(const fs::path& file) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  if (stem.find('%') != std::string::npos) return {};
  for (const FaceNames& names : known_face_names()) {
    for (const std::string& face : names.faces) {
      if (!stem.ends_with(face)) continue;
      const fs::path pattern =
          file.parent_path() / (stem.substr(0, stem.size() - face.size()) + "%s" + extension);
      if (count_there(pattern, names) == 6) return pattern;
    }
  }
  return {};
}

}  // namespace welkin::map_file
