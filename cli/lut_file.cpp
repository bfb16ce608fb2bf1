#include "lut_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command.h"
#include "welkin/brdf/table_text.h"
#include "welkin/io/output_file.h"
#include "welkin/lighting_set/encoded_files.h"

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
  try {
    const EncodedTable encoded = encode_table(table, io::capabilities_for(path).format, type);
    write_bytes(path, encoded.bytes);
    return {std::string(io::name_of(encoded.type)), encoded.error, encoded.report};
  } catch (const Error& error) {
    throw in_file(path, error);
  }
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
