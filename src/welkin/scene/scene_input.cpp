#include "welkin/scene/scene_input.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/io/output_file.h"

namespace welkin::scene {
namespace {

bool is_beside(const std::string& name) {
  if (name.empty() || name.find(':') != std::string::npos || name.find('\0') != std::string::npos)
    return false;
  const std::filesystem::path path(name);
  if (path.is_absolute() || path.has_root_path() || name[0] == '\\') return false;
  // Backslashes separate folders in files from Windows.
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t to = std::min(name.find_first_of("/\\", from), name.size());
    if (name.compare(from, to - from, "..") == 0) return false;
    from = to + 1;
  }
  return true;
}

}  // namespace

OpenBeside files_in(const std::filesystem::path& folder) {
  return [folder](const std::string& name) -> HeldBytes {
    if (!is_beside(name))
      throw Error(ErrorKind::unsupported, name,
                  "is not in the scene's folder; only files there or below are read");
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    auto file = std::make_shared<io::InputFile>(folder / slashes);
    return {file->bytes(), file};
  };
}

Error about(const std::string& scene, const Error& error) {
  return error.file().empty() ? in_file(scene, error) : Error(error.kind(), scene, error.what());
}

void warn(Scene& scene, const std::string& text) {
  if (std::find(scene.warnings.begin(), scene.warnings.end(), text) != scene.warnings.end()) return;
  constexpr std::size_t kMost = 100;
  if (scene.warnings.size() < kMost) scene.warnings.push_back(text);
  if (scene.warnings.size() == kMost) scene.warnings.emplace_back("and more like these");
}

Image decode_picture(std::span<const std::byte> bytes, const std::string& name, io::Colour colour,
                     std::uint64_t max_bytes) {
  const auto reader = io::open(bytes, name, {.colour = colour, .max_bytes = max_bytes});
  const io::PartInfo& part = reader->info().parts.at(0);
  const auto numbered = [&](const char* channel) {
    const auto at = std::find(part.channels.begin(), part.channels.end(), channel);
    return at == part.channels.end() ? -1 : static_cast<int>(at - part.channels.begin());
  };
  std::vector<int> colours{numbered("R"), numbered("G"), numbered("B")};
  if (std::find(colours.begin(), colours.end(), -1) != colours.end()) colours = {std::max(numbered("Y"), 0)};
  const int alpha = numbered("A"), channels = alpha >= 0 ? 4 : 3;
  const auto needed = static_cast<std::uint64_t>(part.width) * static_cast<std::uint64_t>(part.height) *
                      static_cast<std::uint64_t>(channels) * sizeof(float);
  if (needed > max_bytes)
    throw Error(ErrorKind::too_large, name,
                "a picture of " + std::to_string(part.width) + " × " + std::to_string(part.height) +
                    " is too large for a texture");
  // Read without alpha, colours aren't multiplied by it.
  Image read(part.width, part.height, static_cast<int>(colours.size()));
  reader->read(0, colours, read.view());
  Image coverage;
  if (alpha >= 0) {
    coverage = Image(part.width, part.height, 1);
    reader->read(0, std::vector<int>{alpha}, coverage.view());
  }
  Image image(part.width, part.height, channels);
  const auto sound = [](float value) { return std::isfinite(value) ? value : 0.0f; };
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const float* from = read.at(x, y);
      float* to = image.at(x, y);
      for (int i = 0; i < 3; ++i) to[i] = sound(from[colours.size() == 1 ? 0 : i]);
      if (alpha >= 0) to[3] = sound(*coverage.at(x, y));
    }
  }
  return image;
}

void mend_material(Scene& scene, Material& material) {
  bool clamped = false;
  const auto clamp = [&](float& value, float least, float most) {
    const float sound = std::isfinite(value) ? std::clamp(value, least, most) : least;
    clamped = clamped || sound != value;
    value = sound;
  };
  for (float* share : {&material.alpha, &material.metallic, &material.roughness, &material.clearcoat,
                       &material.clearcoat_roughness, &material.transmission, &material.anisotropy,
                       &material.sheen_roughness})
    clamp(*share, 0, 1);
  constexpr float kMost = 1e30f;
  for (auto* colour : {&material.base_color, &material.emission, &material.sheen_color})
    for (float& value : *colour) clamp(value, 0, kMost);
  clamp(material.ior, 1, 1000);
  for (float* any : {&material.normal_scale, &material.alpha_cutoff, &material.anisotropy_angle})
    clamp(*any, -kMost, kMost);
  for (const auto which : kPictureUses) {
    PictureUse& use = material.*which;
    for (float* any : {&use.offset[0], &use.offset[1], &use.scale[0], &use.scale[1], &use.angle})
      clamp(*any, -kMost, kMost);
  }
  if (clamped) warn(scene, "material '" + material.name + "' has numbers out of range, which were clamped");
}

}  // namespace welkin::scene
