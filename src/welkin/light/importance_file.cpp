#include "welkin/light/importance_file.h"

#include <cstdint>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/io/capabilities.h"
#include "welkin/io/image_file.h"
#include "welkin/io/output_file.h"

namespace welkin {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    constexpr const char* kDigits = "0123456789abcdef";
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') result += '\\';
    if (code < 0x20) {
      result += std::string("\\u00") + kDigits[code / 16] + kDigits[code % 16];
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// Channels of the table with a texel for each of the map's.
std::vector<std::string> channels_of(ImportanceMethod method) {
  if (method == ImportanceMethod::cdf) return {"cdf", "density"};
  return {"threshold", "alias_x", "alias_row", "density"};
}

/// A table that is written: with the names of the channels that its format can have.
struct Picture {
  std::vector<std::string> names;
  Image image;

  Picture(int width, int height, std::vector<std::string> channels, bool any_names)
      : names(std::move(channels)),
        image(width, height, any_names ? static_cast<int>(names.size()) : 4, PixelContents::zero) {
    if (!any_names) names = {"R", "G", "B", "A"};
  }
  io::WritePart part() const {
    io::WritePart part{};
    part.image = image.view();
    part.channels = names;
    return part;
  }
};

/// `row_step` is the row's probability as the file has it.
void fill_cdf_row(const ImportanceSampler& sampler, int row, double row_step,
                  const std::vector<double>& areas, float* out, int channels) {
  const std::vector<double> cdf = sampler.conditional_cdf(row);
  const double texels = static_cast<double>(sampler.frame().size.width) * sampler.frame().size.height;
  double before = 0;
  for (std::size_t x = 0; x < cdf.size(); ++x, out += channels) {
    out[0] = static_cast<float>(cdf[x]);
    const double probability = row_step * (static_cast<double>(out[0]) - before);
    before = static_cast<double>(out[0]);
    out[1] = areas[x] > 0 ? static_cast<float>(probability * texels / areas[x]) : 0.0f;
  }
}

void fill_alias_row(const ImportanceSampler& sampler, int row, const std::vector<double>& areas, float* out) {
  const ChartSize size = sampler.frame().size;
  const double texels = static_cast<double>(size.width) * size.height;
  const std::vector<ImportanceSampler::Alias> entries = sampler.alias_row(row);
  for (std::size_t x = 0; x < entries.size(); ++x, out += 4) {
    const auto width = static_cast<std::uint32_t>(size.width);
    out[0] = entries[x].threshold;
    out[1] = static_cast<float>(entries[x].alias % width);
    out[2] = static_cast<float>(entries[x].alias / width);
    const double probability = sampler.probability(row / size.height, static_cast<int>(x), row % size.height);
    out[3] = areas[x] > 0 ? static_cast<float>(probability * texels / areas[x]) : 0.0f;
  }
}

std::vector<Picture> pictures_of(const ImportanceSampler& sampler, bool any_names, const Monitor& monitor) {
  const MapFrame& frame = sampler.frame();
  const int rows = frame.parameterization.charts() * frame.size.height;
  const bool cdf = sampler.options().method == ImportanceMethod::cdf;
  std::vector<Picture> pictures;
  pictures.emplace_back(frame.size.width, rows, channels_of(sampler.options().method), any_names);
  if (cdf) {
    pictures.emplace_back(1, rows, std::vector<std::string>{"cdf"}, any_names);
    const std::vector<double> marginal = sampler.marginal_cdf();
    for (int row = 0; row < rows; ++row)
      *pictures[1].image.at(0, row) = static_cast<float>(marginal[static_cast<std::size_t>(row)]);
  }
  parallel_for(
      rows,
      [&](int row) {
        const std::vector<double> areas = sampler.valid_areas(row);
        if (!cdf) return fill_alias_row(sampler, row, areas, pictures[0].image.at(0, row));
        const double above = row == 0 ? 0 : static_cast<double>(*pictures[1].image.at(0, row - 1));
        fill_cdf_row(sampler, row, static_cast<double>(*pictures[1].image.at(0, row)) - above, areas,
                     pictures[0].image.at(0, row), pictures[0].image.channels());
      },
      monitor);
  return pictures;
}

}  // namespace

std::string importance_header(const ImportanceSampler& sampler, const std::vector<std::string>& pictures) {
  const MapFrame& frame = sampler.frame();
  const ImportanceOptions& options = sampler.options();
  const auto yes = [](bool value) { return value ? "true" : "false"; };
  const auto line = [](const char* key, const std::string& value) {
    return std::string("  \"") + key + "\": " + value + ",\n";
  };
  std::string matrix;
  for (const auto& row : frame.orientation.rows) {
    matrix += std::string(matrix.empty() ? "[" : ", [") + number_text(row[0]) + ", " + number_text(row[1]) +
              ", " + number_text(row[2]) + "]";
  }
  std::string channels, rows_picture;
  for (const std::string& each : channels_of(options.method))
    channels += (channels.empty() ? "" : ", ") + quoted(each);
  std::string text = "{\n";
  text += line("kind", quoted("importance sampling"));
  text += line("method", quoted(std::string(name_of(options.method))));
  text += line("look_up", quoted(std::string(name_of(options.look_up))));
  text += line("compensated", yes(options.compensate));
  text += line("uniform", yes(sampler.is_uniform()));
  text += line("parameterization", quoted(frame.parameterization.spec()));
  text += line("charts", std::to_string(frame.parameterization.charts()));
  text += line("width", std::to_string(frame.size.width));
  text += line("height", std::to_string(frame.size.height));
  text += line("orientation", "[" + matrix + "]");
  text += line("mean_luminance", number_text(sampler.mean_luminance()));
  text += line("integral", number_text(sampler.integral()));
  text += line("negative_texels", std::to_string(sampler.negative_texels()));
  text += "  \"tables\": [\n    {\"file\": " + quoted(pictures.at(0)) + ", \"channels\": [" + channels + "]}";
  if (options.method == ImportanceMethod::cdf)
    text += ",\n    {\"file\": " + quoted(pictures.at(1)) + ", \"channels\": [\"cdf\"]}";
  return text + "\n  ]\n}\n";
}

std::vector<std::filesystem::path> write_importance(const std::filesystem::path& path,
                                                    const ImportanceSampler& sampler,
                                                    const Monitor& monitor) {
  const io::Capabilities& format = io::capabilities_for(path);
  if (format.format != "exr" && format.format != "ktx2") {
    throw Error(
        ErrorKind::unsupported, path.string(),
        "importance sampling tables are written as EXR or KTX2, which hold 32-bit floats as they are");
  }
  std::vector<std::filesystem::path> paths{path};
  if (sampler.options().method == ImportanceMethod::cdf) {
    std::filesystem::path rows = path;
    rows.replace_filename(path.stem().string() + "_rows" + path.extension().string());
    paths.push_back(rows);
  }
  std::vector<std::string> names;
  for (const std::filesystem::path& each : paths) names.push_back(each.filename().string());
  const std::string header = importance_header(sampler, names);
  std::filesystem::path header_path = path;
  header_path.replace_extension(".json");

  const std::vector<Picture> pictures = pictures_of(sampler, format.channels == io::Channels::any, monitor);
  io::WriteOptions options;
  options.type = io::PixelType::float32;
  options.colour = io::Colour::linear;
  try {
    io::OutputFile header_file(header_path);
    header_file.write(header.data(), header.size());
    io::write_set(
        paths.size(),
        [&](std::size_t i) {
          return io::WriteFile{paths[i], {pictures[i].part()}};
        },
        options);
    header_file.commit();
  } catch (const Error& error) {
    throw error.file().empty() ? in_file(header_path.string(), error) : error;
  }
  paths.push_back(header_path);
  return paths;
}

}  // namespace welkin
