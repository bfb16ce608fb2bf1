#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/io/env/manifest.h"
#include "welkin/io/format.h"
#include "welkin/io/rgbd_face.h"
#include "welkin/io/texels/picture_set.h"

/// Babylon.js environments: a cube with all its levels down to one texel, each face a PNG or WebP that holds
/// RGBD and lies upside down.
///
/// Source: Babylon.js, packages/dev/core/src/Misc/environmentTextureTools.ts, GetEnvInfo,
/// CreateEnvTextureAsync and UploadEnvLevelsAsync.
namespace welkin::io {
namespace env {
namespace {

bool matches(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kMagic && std::memcmp(bytes.data(), kMagic, sizeof kMagic) == 0;
}

/// What a file of another program holds: as Babylon.js's default, left-handed scene looks it up, filtered as
/// its own filter does, for α = 2^(level/scale)/width, level 0 not at all.
std::map<std::string, std::string> babylons_own(const Manifest& manifest) {
  std::string roughness = "0";
  for (int level = 1; level < manifest.levels; ++level) {
    const double alpha = std::exp2(level / manifest.lod_scale) / manifest.width;
    roughness += "," + number_text(std::sqrt(std::min(alpha, 1.0)));
  }
  return {{"welkin.parameterization", "cube:layers"},
          {"welkin.orientation", "-1 0 0 0 1 0 0 0 1"},
          {"welkin.convention", "babylon"},
          {"welkin.lobe", "ggx"},
          {"welkin.roughness", roughness}};
}

class EnvReader final : public FormatReader {
 public:
  explicit EnvReader(const Source& source) : source_(source), manifest_(parse_manifest(source)) {
    const auto width = static_cast<std::uint64_t>(manifest_.width);
    check_size(source_, width, width, 3);
    info_.format = "env";
    info_.bytes = source.bytes.size();
    info_.colour = Colour::linear;
    const texels::TextureShape shape{manifest_.width, manifest_.width, manifest_.levels, 0, 6};
    texels::list_pictures(shape, {"R", "G", "B"}, PixelType::uint8, kRgbd.text(), info_);
    info_.attributes = manifest_.attributes;
    if (info_.attributes.empty()) {
      info_.attributes = babylons_own(manifest_);
      info_.notes.push_back("looked up as in Babylon.js's default, left-handed scene");
    }
    if (manifest_.irradiance)
      info_.notes.push_back("with a polynomial of its diffuse light, which is not read");
  }

  void decode(std::size_t index, std::span<const int> channels, ImageView<float> out) override {
    const Extent& extent = manifest_.images[index];
    read_face(source_.bytes.subspan(extent.begin, extent.size), source_.name + ": " + info_.parts[index].name,
              source_, false, channels, out);
  }

 private:
  Source source_;
  Manifest manifest_;
};

std::unique_ptr<FormatReader> open_env(const Source& source) {
  return std::make_unique<EnvReader>(source);
}

void check_shape(const texels::TextureShape& shape) {
  const auto refuse = [](const std::string& cause) {
    throw Error(ErrorKind::unsupported, ".env holds " + cause);
  };
  if (shape.faces != 6 || shape.layers > 0) refuse("one cube texture, not pictures of another kind");
  const auto side = static_cast<unsigned>(shape.width);
  if (!std::has_single_bit(side) || shape.width > kLargestRgbdFace)
    refuse("faces of a power of two up to " + std::to_string(kLargestRgbdFace) + ", not of " +
           std::to_string(shape.width) + ": Babylon.js counts its levels by log2 of that");
  const int all = static_cast<int>(std::bit_width(side));
  if (shape.levels != all)
    refuse("all " + std::to_string(all) + " levels of faces of " + std::to_string(shape.width) + ", not " +
           std::to_string(shape.levels) + ": Babylon.js refuses any other number");
}

WriteReport write_env(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  require(options.irradiance.empty() || options.irradiance.size() == 27,
          "the polynomial of the irradiance has 27 numbers");
  const texels::PictureSet pictures(parts);
  check_shape(pictures.shape());
  WriteReport report;
  const std::vector<std::vector<std::byte>> images = rgbd_pngs(pictures, report);
  std::vector<std::uint64_t> sizes;
  for (const std::vector<std::byte>& image : images) sizes.push_back(image.size());
  file.write(std::as_bytes(std::span(kMagic)));
  const std::string text =
      manifest_text(pictures.shape().width, sizes, options.irradiance, options.attributes);
  file.write(text.c_str(), text.size() + 1);
  for (const std::vector<std::byte>& image : images) file.write(image);
  return report;
}

}  // namespace
}  // namespace env

Format env_format() {
  return {rgbd_cube("env", "Babylon.js's .env", "babylon"), env::matches, env::open_env, env::write_env};
}

}  // namespace welkin::io
