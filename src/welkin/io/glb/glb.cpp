#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/io/format.h"
#include "welkin/io/glb/container.h"
#include "welkin/io/rgbd_face.h"
#include "welkin/io/texels/picture_set.h"

/// Image-based lights of glTF files: a cube with its first levels, each face a PNG of RGBD.
///
/// The extension has the faces of a right-handed world in OpenGL's order, each "flipped about its vertical
/// axis". As Babylon.js, which it comes from, looks them up in its default scene, they are a cube of the
/// world with x reversed: all faces flipped as it says, and +X and −X exchanged.
namespace welkin::io {
namespace glb {
namespace {

/// Row by row, the matrix that takes a direction of the scene to one of the cube: the inverse of the
/// rotation.
std::string look_up_of(const double (&q)[4]) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double rows[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
                          2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                          2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
  std::string text;
  for (int i = 0; i < 9; ++i) text += (i == 0 ? "" : " ") + number_text(i < 3 ? 0 - rows[i] : rows[i]);
  return text;
}

std::map<std::string, std::string> of_other_programs(const Light& light) {
  const std::size_t levels = light.images.size() / 6;
  std::string roughness;
  for (std::size_t level = 0; level < levels; ++level) {
    const double share = levels == 1 ? 0 : static_cast<double>(level) / static_cast<double>(levels - 1);
    roughness += (level == 0 ? "" : ",") + number_text(share);
  }
  return {{"welkin.parameterization", "cube:layers"},
          {"welkin.orientation", look_up_of(light.rotation)},
          {"welkin.convention", "babylon"},
          {"welkin.lobe", "ggx"},
          {"welkin.roughness", roughness}};
}

class GlbReader final : public FormatReader {
 public:
  explicit GlbReader(const Source& source) : source_(source), light_(parse_light(source)) {
    const auto width = static_cast<std::uint64_t>(light_.width);
    check_size(source_, width, width, 3);
    info_.format = "glb";
    info_.bytes = source.bytes.size();
    info_.colour = Colour::linear;
    const texels::TextureShape shape{light_.width, light_.width, static_cast<int>(light_.images.size() / 6),
                                     0, 6};
    texels::list_pictures(shape, {"R", "G", "B"}, PixelType::uint8, kRgbd.text(), info_);
    info_.attributes = light_.attributes;
    if (info_.attributes.empty()) {
      info_.attributes = of_other_programs(light_);
      info_.notes.push_back("looked up as in Babylon.js's default, left-handed scene");
    }
    if (light_.lights > 1)
      info_.notes.push_back("the first scene's of " + std::to_string(light_.lights) + " lights");
    info_.notes.push_back("with harmonics of its diffuse light, which are not read");
    if (light_.intensity != 1)
      info_.notes.push_back("multiplied by its intensity of " + number_text(light_.intensity));
  }

  void decode(std::size_t index, std::span<const int> channels, ImageView<float> out) override {
    read_face(light_.images[index], source_.name + ": " + info_.parts[index].name, source_, true, channels,
              out);
    if (light_.intensity == 1) return;
    for (int y = 0; y < out.height; ++y) {
      float* const row = out.row(y);
      for (int i = 0; i < out.width * out.channels; ++i) row[i] *= static_cast<float>(light_.intensity);
    }
  }

 private:
  Source source_;
  Light light_;
};

std::unique_ptr<FormatReader> open_glb(const Source& source) {
  return std::make_unique<GlbReader>(source);
}

void check_shape(const texels::TextureShape& shape) {
  const auto refuse = [](const std::string& cause) {
    throw Error(ErrorKind::unsupported, "the light of a .glb is " + cause);
  };
  if (shape.faces != 6 || shape.layers > 0) refuse("one cube texture, not pictures of another kind");
  if (!std::has_single_bit(static_cast<unsigned>(shape.width)) || shape.width > kLargestRgbdFace)
    refuse("of faces of a power of two up to " + std::to_string(kLargestRgbdFace) + ", not of " +
           std::to_string(shape.width));
}

WriteReport write_glb(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  constexpr std::size_t kNumbers = 27;
  if (options.irradiance.size() != kNumbers)
    throw Error(ErrorKind::unsupported,
                "a .glb holds harmonics of the diffuse light beside the levels of a chain, which are missing "
                "here: bake one");
  const texels::PictureSet pictures(parts);
  check_shape(pictures.shape());
  WriteReport report;
  const std::vector<std::vector<std::byte>> images = rgbd_pngs(pictures, report);
  file.write(file_of(pictures.shape().width, images, options.irradiance, options.attributes));
  return report;
}

}  // namespace
}  // namespace glb

Format glb_format() {
  return {rgbd_cube("glb", "glTF's image-based light (.glb)", "gltf"), glb::matches, glb::open_glb,
          glb::write_glb};
}

}  // namespace welkin::io
