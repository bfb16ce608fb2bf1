#include "welkin/io/rgbd_face.h"

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/encoded_light.h"
#include "welkin/io/interpret.h"
#include "welkin/io/png/png.h"

namespace welkin::io {
namespace {

void turn_over(ImageView<const float> from, ImageView<float> to) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.row(from.height - 1 - y), from.width * from.channels, to.row(y));
}

bool holds_faces(const std::string& format, bool plain) {
  return format == "png" || format == "webp" || (plain && format == "jpeg");
}

std::unique_ptr<FormatReader> open_face(std::span<const std::byte> bytes, const std::string& name,
                                        const ReadOptions& options, bool plain) {
  const auto format = std::find_if(formats().begin(), formats().end(), [&](const Format& each) {
    return holds_faces(each.capabilities.format, plain) && each.matches(bytes);
  });
  if (format == formats().end())
    throw Error(ErrorKind::damaged, name,
                plain ? "its image is neither PNG nor JPEG nor WebP" : "its image is neither PNG nor WebP");
  return format->open({bytes, name, options});
}

std::vector<std::byte> rgbd_png(const WritePart& part, WriteReport& report) {
  const Image encoded = encode_light(part, kRgbd, report);
  Image upside_down(encoded.width(), encoded.height(), 4);
  turn_over(encoded.view(), upside_down.view());
  WriteOptions options;
  options.type = PixelType::uint8;
  options.encoding = kRgbd;
  const WritePart picture{"", upside_down.view(), {"R", "G", "B", "A"}};
  MemorySink sink;
  write_png(sink, {&picture, 1}, options);
  return sink.take();
}

}  // namespace

Capabilities rgbd_cube(std::string format, std::string title, std::string irradiance) {
  return {.format = format,
          .title = std::move(title),
          .extensions = {format},
          .types = {PixelType::uint8},
          .compressions = {"zip"},
          .channels = Channels::rgb,
          .pictures = true,
          .levels = true,
          .texture = true,
          .lossless = false,
          .hdr = true,
          .attributes = true,
          .irradiance = std::move(irradiance),
          .longest_side = kLargestRgbdFace};
}

std::vector<std::vector<std::byte>> rgbd_pngs(const texels::PictureSet& cube, WriteReport& report) {
  std::vector<std::vector<std::byte>> images;
  for (int level = 0; level < cube.shape().levels; ++level) {
    for (int face = 0; face < 6; ++face) images.push_back(rgbd_png(cube.at(level, face), report));
  }
  return images;
}

void read_face(std::span<const std::byte> bytes, const std::string& name, const Source& file, bool plain,
               std::span<const int> channels, ImageView<float> out) {
  ReadOptions options;
  options.max_bytes = file.options.max_bytes;
  try {
    std::unique_ptr<FormatReader> opened = open_face(bytes, name, options, plain);
    std::unique_ptr<Reader> image;
    if (plain && opened->info().parts[0].channels.size() < 4) {
      image = interpret(std::move(opened), options);
    } else {
      options.encoding = kRgbd;
      image = decode_light(std::move(opened), options);
    }
    const PartInfo& stored = image->info().parts[0];
    if (stored.width != out.width || stored.height != out.height)
      throw Error(ErrorKind::damaged, "its image is " + std::to_string(stored.width) + "×" +
                                          std::to_string(stored.height) + ", not " +
                                          std::to_string(out.width) + "×" + std::to_string(out.height));
    Image upside_down(out.width, out.height, out.channels);
    image->read(0, channels, upside_down.view());
    turn_over(upside_down.view(), out);
  } catch (const Error& error) {
    throw error.file().empty() ? in_file(name, error) : error;
  }
}

}  // namespace welkin::io
