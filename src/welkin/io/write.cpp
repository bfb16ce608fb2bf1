#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/encoded_light.h"
#include "welkin/io/format.h"
#include "welkin/io/output_file.h"
#include "welkin/io/part_rows.h"
#include "welkin/io/write_choices.h"

namespace welkin::io {
namespace {

const Format& format_named(std::string_view name) {
  for (const Format& format : formats()) {
    if (format.capabilities.format != name) continue;
    if (format.write == nullptr) throw Error(ErrorKind::unsupported, only_read(format.capabilities));
    return format;
  }
  return format_named(capabilities(name).format);  // throws
}

/// Throws for what the format can't hold of a picture.
void check_picture(const Format& chosen, const WritePart& part, const WriteOptions& options) {
  const Capabilities& format = chosen.capabilities;
  if (options.encoding) check_encoded(part, options, format);
  PixelType type = options.type.value_or(format.types.front());
  if (chosen.check != nullptr) {
    chosen.check(options);
  } else {
    type = pixel_type(options, format.types, format.title);
    compression(options, format.compressions, format.title);
  }
  checked_quality(options);
  const bool packed = is_packed(type);
  const bool two = format.channels == Channels::rg_or_rgba && !packed && is_red_green(part);
  if (format.channels != Channels::any && !two) {
    const Alpha alpha = format.channels != Channels::rgb && !packed ? Alpha::allowed : Alpha::none;
    channel_order(part, alpha, packed ? format.title + " of " + std::string(name_of(type)) : format.title);
  }
  check_sides(part, format.longest_side, format.title);
}

/// Throws Error (bad_request) for parts that break WritePart's contract, and what the format can't hold.
void check_parts(const Format& format, std::span<const WritePart> parts, const WriteOptions& options) {
  require(!parts.empty(), "there is no picture to write");
  if (!format.capabilities.pictures) only_part(parts, format.capabilities.title);
  for (const WritePart& part : parts) {
    require((part.image.data != nullptr || part.draw) && part.image.width > 0 && part.image.height > 0,
            "a picture to write has no pixels");
    require(part.image.channels > 0 && part.channels.size() == static_cast<std::size_t>(part.image.channels),
            "a picture to write has another number of channels than names for them");
    check_picture(format, part, options);
  }
}

/// Writes parts that have been checked; those that the format can't draw row by row are drawn before.
WriteReport write_parts(const Format& format, ByteSink& sink, std::vector<WritePart>& parts,
                        const WriteOptions& options) {
  std::vector<Image> drawn;
  if (!format.draws_rows || options.encoding) drawn = draw_parts(parts);
  if (!options.encoding) return format.write(sink, parts, options);
  std::vector<Image> encoded;
  WriteReport report;
  for (WritePart& part : parts) {
    encoded.push_back(encode_light(part, *options.encoding, report));
    part.image = encoded.back().view();
    part.channels = {"R", "G", "B", "A"};
  }
  WriteOptions as_bytes = options;
  as_bytes.type = PixelType::uint8;
  as_bytes.attributes[kEncodingKey] = options.encoding->text();
  return report + format.write(sink, parts, as_bytes);
}

/// Runs one step of writing a file; what goes wrong names the file.
template <class Step>
void for_file(const std::filesystem::path& path, const Step& step) {
  try {
    step();
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw in_file(path.string(), error);
  }
}

}  // namespace

WriteReport write(ByteSink& sink, std::string_view format, std::span<const WritePart> parts,
                  const WriteOptions& options) {
  const Format& chosen = format_named(format);
  check_parts(chosen, parts, options);
  std::vector<WritePart> own(parts.begin(), parts.end());
  return write_parts(chosen, sink, own, options);
}

WriteReport write_set(std::size_t count, const std::function<WriteFile(std::size_t)>& next,
                      const WriteOptions& options) {
  WriteReport total;
  std::vector<std::pair<std::filesystem::path, std::unique_ptr<OutputFile>>> written;
  for (std::size_t i = 0; i < count; ++i) {
    WriteFile file = next(i);
    for_file(file.path, [&] {
      const Format& format = format_named(capabilities_for(file.path).format);
      check_parts(format, file.parts, options);
      written.emplace_back(file.path, std::make_unique<OutputFile>(file.path));
      total = total + write_parts(format, *written.back().second, file.parts, options);
    });
  }
  for (const auto& each : written) {
    for_file(each.first, [&] { each.second->commit(); });
  }
  return total;
}

WriteReport write(const std::filesystem::path& path, std::span<const WritePart> parts,
                  const WriteOptions& options) {
  return write_set(
      1,
      [&](std::size_t) {
        return WriteFile{path, {parts.begin(), parts.end()}};
      },
      options);
}

void check_write(const std::filesystem::path& path, int width, int height,
                 const std::vector<std::string>& channels, const WriteOptions& options) {
  for_file(path, [&] {
    const WritePart part{"", {nullptr, width, height, static_cast<int>(channels.size()), 0}, channels, 0, 0,
                         0};
    check_picture(format_named(capabilities_for(path).format), part, options);
    const OutputFile unwritten(path);
  });
}

}  // namespace welkin::io
