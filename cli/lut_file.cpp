#include "lut_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command.h"
#include "welkin/brdf/table_text.h"
#include "welkin/io/output_file.h"

namespace welkin::cli {
namespace {

void write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  try {
    io::OutputFile file(path);
    file.write(bytes);
    file.commit();
  } catch (const Error& error) {
    throw in_file(path, error);
  }
}

/// The channels as files name them; where a format holds no two, a third of zeros.
std::vector<std::string> names_of_channels(int count, const io::Capabilities& format) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  const bool holds_two = format.channels == io::Channels::any || format.channels == io::Channels::rg_or_rgba;
  names.resize(static_cast<std::size_t>(count == 2 && !holds_two ? 3 : count));
  return names;
}

Image with_channels(const Image& table, int channels) {
  Image wide(table.width(), table.height(), channels);
  for (int y = 0; y < table.height(); ++y) {
    for (int x = 0; x < table.width(); ++x) std::copy_n(table.at(x, y), table.channels(), wide.at(x, y));
  }
  return wide;
}

/// Of values that the type holds; what it doesn't is counted as clipped.
double largest_difference(const Image& table, const Image& stored, io::PixelType type) {
  const bool integer = type != io::PixelType::half && type != io::PixelType::float32;
  double largest = 0;
  for (int y = 0; y < table.height(); ++y) {
    for (int x = 0; x < table.width(); ++x) {
      for (int c = 0; c < table.channels(); ++c) {
        const double value = table.at(x, y)[c];
        if (integer && (value < 0 || value > 1)) continue;
        largest = std::max(largest, std::fabs(value - stored.at(x, y)[c]));
      }
    }
  }
  return largest;
}

}  // namespace

bool is_c_header(const std::string& path) {
  return std::filesystem::path(path).extension() == ".h";
}

io::PixelType table_type(const std::string& path, const std::string& asked, const std::string& usual) {
  check_extension(path);
  const io::Capabilities& format = io::capabilities_for(path);
  if (asked.empty()) {
    if (usual.empty())
      return format.holds(io::PixelType::half) && format.texture ? io::PixelType::half : format.types.front();
    const io::PixelType type = io::pixel_type_from_name(usual);
    return format.holds(type)                  ? type
           : format.holds(io::PixelType::half) ? io::PixelType::half
                                               : format.types.front();
  }
  const io::PixelType type = parse_option("--type", [&] { return io::pixel_type_from_name(asked); });
  if (!format.holds(type)) throw UsageError("--type: " + format.title + " holds no " + asked + " pixels");
  return type;
}

StoredTable write_table(const std::string& path, const Image& table, io::PixelType type) {
  const io::Capabilities& format = io::capabilities_for(path);
  const std::vector<std::string> names = names_of_channels(table.channels(), format);
  const Image wide = with_channels(table, static_cast<int>(names.size()));
  io::WriteOptions options;
  options.type = type;
  options.colour = io::Colour::linear;
  const io::WritePart part{"", wide.view(), names};
  io::MemorySink sink;
  StoredTable stored;
  try {
    stored.report = io::write(sink, format.format, {&part, 1}, options);
  } catch (const Error& error) {
    throw in_file(path, error);
  }
  write_bytes(path, sink.bytes());

  io::ReadOptions as_stored;
  as_stored.colour = io::Colour::linear;
  const auto reader = io::open(sink.bytes(), path, as_stored);
  const io::PartInfo& info = reader->info().parts.front();
  std::vector<int> channels;
  for (int c = 0; c < table.channels(); ++c) channels.push_back(c);
  Image again(info.width, info.height, table.channels());
  reader->read(0, channels, again.view());
  stored.type = io::name_of(info.type);
  stored.error = largest_difference(table, again, info.type);
  return stored;
}

StoredTable write_c_header(const std::string& path, const Image& table, const std::string& about) {
  std::string name = std::filesystem::path(path).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "lut_");
  const std::string text = brdf::c_header(table.view(), name, about);
  write_bytes(path, std::as_bytes(std::span(text)));
  return {"float", 0, {}};
}

}  // namespace welkin::cli
