#include "welkin/map_file/map_file.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/map_file/eyes.h"
#include "welkin/map_file/face_names.h"
#include "welkin/map_file/joining.h"
#include "welkin/map_file/map_file_job.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
using namespace map_file;

/// The names of a cube's faces; null where the path is one file's, or its charts are numbered.
const FaceNames* find_names(const fs::path& path, const ReadMapOptions& options) {
  if (!is_pattern_to_read(path)) return nullptr;
  if (options.shape && !parse_map_shape(*options.shape).parameterization.traits().cube_faces) return nullptr;
  try {
    return &find_face_names(path);
  } catch (const Error&) {
    // Without a shape these may be numbered charts, fewer than a cube has.
    std::error_code unknown;
    if (options.shape || !fs::exists(chart_path(path, "0"), unknown) ||
        fs::exists(chart_path(path, "px"), unknown))
      throw;
    return nullptr;
  }
}

/// Opens the file, or the first of the files of a pattern.
std::unique_ptr<io::Reader> open_first(const fs::path& path, const FaceNames* face_names,
                                       const ReadMapOptions& options) {
  if (!is_pattern_to_read(path)) return io::open(path, options.image);
  return io::open(chart_path(path, face_names == nullptr ? "0" : face_names->faces.front()), options.image);
}

}  // namespace

MapReader::MapReader(const fs::path& path, const ReadMapOptions& options)
    : path_(path),
      options_(options),
      face_names_(find_names(path, options)),
      reader_(open_first(path, face_names_, options)),
      info_(inspected(options)) {
  if (options.join_faces) join_faces();
}

MapReader::MapReader(std::span<const std::byte> bytes, const std::string& name, const ReadMapOptions& options)
    : path_(name), options_(options), reader_(io::open(bytes, name, options.image)) {
  require(!is_pattern(path_), "bytes in memory are one file: their name cannot have a %s");
  info_ = inspected(options);
  if (options.join_faces) join_faces();
}

MapFileInfo MapReader::inspected(const ReadMapOptions& options) const {
  MapFileInfo info = inspect(path_, reader_->info(), options);
  const bool native = face_names_ == nullptr || face_names_ == &known_face_names().front();
  if (native || !info.shape || !info.shape->parameterization.traits().cube_faces) return info;
  const std::string text = "the faces are called " + face_names_->text() + ": taken for +X −X +Y −Y +Z −Z";
  (face_names_->axes ? info.image.notes : info.image.warnings).push_back(text);
  return info;
}

std::vector<std::string> MapReader::file_names() const {
  const sphere::AnyParameterization& p = shape().parameterization;
  if (!p.traits().cube_faces || face_names_ == nullptr) return chart_names(p);
  return {face_names_->faces.begin(), face_names_->faces.end()};
}

void MapReader::inspect_with(ReadMapOptions options) {
  info_ = inspected(options);
  info_.image.warnings.insert(info_.image.warnings.end(), joining_.begin(), joining_.end());
  options_ = std::move(options);
}

void MapReader::set_faces(std::string faces) {
  ReadMapOptions changed = options_;
  changed.faces = std::move(faces);
  inspect_with(std::move(changed));
}

void MapReader::set_orientation(const Matrix3& orientation) {
  ReadMapOptions changed = options_;
  changed.orientation = orientation;
  inspect_with(std::move(changed));
}

void MapReader::set_level(int level) {
  ReadMapOptions changed = options_;
  changed.level = level;
  inspect_with(std::move(changed));
}

void MapReader::set_part(std::size_t part) {
  ReadMapOptions changed = options_;
  changed.part = part;
  inspect_with(std::move(changed));
}

namespace {

/// Whether a file leaves it to guesses how the faces of its cube lie.
bool leaves_faces_open(const MapFileInfo& info) {
  return info.shape && info.shape->parameterization.traits().cube_faces &&
         info.shape->layout.kind != LayoutKind::layers && attribute(info.image, kShapeKey).empty() &&
         !info.image.envmap;
}

/// `0.042`.
std::string step_text(double step) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", step);
  return text;
}

/// How sure a reading is: the steps across edges, of it and of others.
std::string sureness_of(const FaceReading& reading, const FaceEdges& as_they_lie) {
  return std::string(reading.is_unsure() ? "unsure: " : "") + "steps across edges of " +
         step_text(reading.step) + " stops, as they lie " + step_text(as_they_lie.across) + ", next best " +
         step_text(reading.next_step);
}

}  // namespace

void MapReader::join_faces() {
  if (!leaves_faces_open(info_) || options_.orientation || !options_.faces.empty()) return;
  const Joining joining = measure_joining(read(), shape().layout);
  ReadMapOptions changed = options_;
  if (joining.edges.join()) {
    // A picture of one colour joins in every way.
    if (options_.shape || joining.edges.across > 0 || joining.edges.beside > 0) return;
    joining_ = {"is taken for " + info_.shape->text() + ", " + info_.reason +
                ": nothing in it tells whether it is"};
    return inspect_with(std::move(changed));
  }
  if (joining.better) {
    changed.orientation = joining.better->orientation;
    changed.faces = joining.better->faces;
    joining_ = {std::string("its faces do not join in the native world") +
                (joining.better->ordered ? " in a usual order" : "") + ", but in " + joining.better->text() +
                ": read so (" + sureness_of(*joining.better, joining.edges) + ")"};
  } else if (options_.shape || shape().layout.kind == LayoutKind::files) {
    return;  // what was asked for, or is named as faces are, may be six pictures of their own
  } else {
    joining_ = {"its faces do not join (" + info_.shape->text() + ", " + info_.reason +
                "): name the parameterization, or the faces' order and turns"};
  }
  inspect_with(std::move(changed));
}

void MapReader::check_faces() {
  if (!leaves_faces_open(info_)) return;
  const Joining joining = measure_joining(read(), shape().layout);
  if (joining.edges.join() || !joining.better) return;
  joining_ = {"its faces do not join as they are read; they would in " + joining.better->text() + " (" +
              sureness_of(*joining.better, joining.edges) + ")"};
  inspect_with(options_);
}

MapFileInfo inspect_picture(ChartSize size, const std::vector<std::string>& channels, const std::string& name,
                            const ReadMapOptions& options) {
  require(size.width > 0 && size.height > 0 && !channels.empty(), "a picture has texels and channels");
  require(!is_pattern(name), "one picture has one name, without a %s");
  io::FileInfo file;
  file.parts.push_back(
      {.name = {}, .width = size.width, .height = size.height, .channels = channels, .compression = "none"});
  return inspect(name, file, options);
}

LoadedMap read_map(const fs::path& path, const ReadMapOptions& options) {
  MapReader reader(path, options);
  return {reader.read(), reader.info()};
}

LoadedMap read_map(std::span<const std::byte> bytes, const std::string& name, const ReadMapOptions& options) {
  MapReader reader(bytes, name, options);
  return {reader.read(), reader.info()};
}

const MapShape& MapReader::shape() const {
  if (info_.shape) return *info_.shape;
  const io::PartInfo& part = info_.image.parts[info_.picture];
  const fs::path six = part.width == part.height ? pattern_of_face(path_) : fs::path();
  throw Error(ErrorKind::bad_request, path_.string(),
              "cannot tell which parameterization " + std::to_string(part.width) + "×" +
                  std::to_string(part.height) + " is" +
                  (six.empty() ? "" : ": it may be one of six faces, which " + six.string() + " reads"));
}

Map MapReader::read() {
  const std::string name = path_.string();
  const MapFileInfo& info = info_;
  const ReadMapOptions& options = options_;
  const Layout& layout = shape().layout;
  const auto& p = shape().parameterization;
  const std::vector<std::size_t> pictures = pictures_of(info.image, options.level);
  const Selection selection = select(name, info.image, options, &layout);
  const std::size_t first = selection.first;
  const io::PartInfo& part = info.image.parts[pictures[first]];
  const std::vector<int>& channels = selection.channels.channels;
  const int count = static_cast<int>(channels.size());
  Map map(p, info.chart.width, info.chart.height, count);
  map.orientation = info.orientation;
  map.channel_names = selection.channels.names;
  const int border = info.border;
  const auto plain = [border](const LayoutCell& cell) {
    return !cell.mirrored && cell.quarter_turns == 0 && border == 0;
  };
  const auto inner = [border](ImageView<const float> picture) {
    return picture.part(border, border, picture.width - 2 * border, picture.height - 2 * border);
  };
  /// One picture holds one chart: straight into the map where it is neither turned nor mirrored.
  const auto read_chart = [&](io::Reader& from, std::size_t index, const LayoutCell& cell,
                              const std::string& file) {
    const io::PartInfo& other = from.info().parts.at(index);
    if (other.width - 2 * border != info.chart.width || other.height - 2 * border != info.chart.height) {
      throw Error(ErrorKind::mismatch, file,
                  "is " + std::to_string(other.width) + "×" + std::to_string(other.height) +
                      ", but the first face is " + std::to_string(info.chart.width) + "×" +
                      std::to_string(info.chart.height));
    }
    const std::vector<int> own = channels_like(selection.channels, part, file, from.info(), index);
    if (plain(cell)) return from.read(index, own, map.level.chart(cell.chart));
    Image picture(other.width, other.height, count);
    from.read(index, own, picture.view());
    copy_from_cell(cell, inner(picture.view()), map.level.chart(cell.chart));
  };
  switch (layout.kind) {
    case LayoutKind::files: {
      const std::vector<std::string> names = file_names();
      for (std::size_t i = 0; i < layout.cells.size(); ++i) {
        const fs::path file = chart_path(path_, names[i]);
        const auto reader = io::open(file, options.image);
        const std::vector<std::size_t> own = pictures_of(reader->info(), options.level);
        if (first >= own.size())
          throw Error(ErrorKind::mismatch, file.string(), "has fewer pictures than the first face");
        read_chart(*reader, own[first], layout.cells[i], file.string());
      }
      break;
    }
    case LayoutKind::layers:
      for (std::size_t i = 0; i < layout.cells.size(); ++i) {
        read_chart(*reader_, pictures[first + i], layout.cells[i], name);
      }
      break;
    case LayoutKind::picture:
      if (layout.cells.size() == 1 && plain(layout.cells[0]) && info.stereo == io::Stereo::mono) {
        reader_->read(pictures[first], channels, map.level.chart(0));
        break;
      }
      {
        Image picture(part.width, part.height, count);
        reader_->read(pictures[first], channels, picture.view());
        const ImageView<const float> seen = eye_of<const float>(info.stereo, info.eye, picture.view());
        for (const LayoutCell& cell : layout.cells) {
          copy_from_cell(cell, inner(cell_of<const float>(layout, cell, seen)), map.level.chart(cell.chart));
        }
      }
  }
  fill_borders(map, RimTexels::measured);
  return map;
}

Map MapReader::read(int level) {
  const int before = options_.level;
  set_level(level);
  Map map = read();
  set_level(before);
  return map;
}

}  // namespace welkin
