#include "welkin/lighting_set/set_folder.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "welkin/base/error.h"
#include "welkin/io/output_file.h"
#include "welkin/lighting_set/manifest.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

/// Manifests of larger files are somebody else's.
constexpr std::uintmax_t kLargestManifest = 64u << 20;

/// The names that the folder's manifest lists, its own among them; none where there is no manifest of a set.
std::vector<std::string> listed_files(const fs::path& folder) {
  std::error_code ignored;
  const fs::path path = folder / kManifestName;
  if (!fs::is_regular_file(path, ignored) || fs::file_size(path, ignored) > kLargestManifest) return {};
  const io::InputFile file(path);
  const char* first = reinterpret_cast<const char*>(file.bytes().data());
  const auto manifest = nlohmann::json::parse(first, first + file.bytes().size(), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("welkin") || !manifest.contains("files")) return {};
  std::vector<std::string> names{kManifestName, "index.html"};
  for (const auto& each : manifest["files"]) {
    if (each.is_object() && each.contains("file") && each["file"].is_string()) names.push_back(each["file"]);
  }
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) > 0;
}

/// A folder that goes again unless it is kept.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& path) : path_(path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return;
    if (fs::exists(path, error))
      throw Error(ErrorKind::bad_request, path.string(), "is a file: a set needs a folder of its own");
    made_ = fs::create_directory(path, error);
    if (made_ || !error) return;
    const bool missing = error == std::errc::no_such_file_or_directory;
    const bool denied = error == std::errc::permission_denied || error == std::errc::read_only_file_system;
    throw Error(missing  ? ErrorKind::not_found
                : denied ? ErrorKind::denied
                         : ErrorKind::system,
                path.string(), "the folder can't be made: " + error.message());
  }
  ~NewFolder() {
    std::error_code ignored;
    if (made_) fs::remove(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  void keep() { made_ = false; }

 private:
  fs::path path_;
  bool made_ = false;
};

void check_names(const fs::path& folder, const std::vector<std::string>& names) {
  const std::vector<std::string> ours = listed_files(folder);
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!has(ours, name) && fs::exists(folder / name, ignored))
      throw Error(ErrorKind::bad_request, (folder / name).string(),
                  "is there already, and no set's manifest lists it: choose another folder, or move it away");
  }
}

}  // namespace

void check_set_folder(const fs::path& folder, const std::vector<std::string>& names) {
  const NewFolder made(folder);
  check_names(folder, names);
  const fs::path path = folder / kManifestName;
  try {
    const io::OutputFile unwritten(path);
  } catch (const Error& error) {
    throw in_file(path.string(), error);
  }
}

std::vector<std::string> write_set_folder(const fs::path& folder, std::span<const FolderFile> files) {
  NewFolder made(folder);
  std::vector<std::string> names;
  for (const FolderFile& file : files) names.push_back(file.name);
  check_names(folder, names);
  std::vector<std::string> left;
  for (const std::string& name : listed_files(folder)) {
    std::error_code ignored;
    if (!has(names, name) && fs::exists(folder / name, ignored)) left.push_back(name);
  }
  std::vector<std::unique_ptr<io::OutputFile>> outputs;
  const auto in_turn = [&](const auto& act) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      try {
        act(i);
      } catch (const Error& error) {
        throw in_file((folder / files[i].name).string(), error);
      }
    }
  };
  in_turn([&](std::size_t i) {
    outputs.push_back(std::make_unique<io::OutputFile>(folder / files[i].name));
    outputs.back()->write(files[i].bytes);
  });
  in_turn([&](std::size_t i) { outputs[i]->commit(); });
  made.keep();
  return left;
}

}  // namespace welkin
