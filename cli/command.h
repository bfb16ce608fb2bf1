#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"
#include "progress.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/image_file.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/map_file/map_file.h"

/// What the subcommands share. Each is one file with one add_… function: it declares its options, and its
/// callback parses them, calls the library and prints.
namespace welkin::cli {

/// A request that makes no sense, found before any work: exit status 2.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& cause) : Error(ErrorKind::bad_request, cause) {}
};

/// parse(), with any Error it throws turned into a UsageError that names the option.
template <class Parse>
auto parse_option(std::string_view option, const Parse& parse) {
  try {
    return parse();
  } catch (const Error& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

/// Text of a file or a pipe for the terminal: control characters become `?`, and a text of over `longest`
/// bytes is cut.
std::string printable(std::string text, std::size_t longest = 200);
/// Of warnings, which may name all faces of a cube.
inline constexpr std::size_t kLongestWarning = 400;

/// A finite number that is all of `text`, but for blanks before it.
std::optional<double> finite_number(const std::string& text);

/// `1,2.5,-3`: numbers separated by commas. Throws UsageError, naming the option.
std::vector<double> parse_numbers(std::string_view option, const std::string& text);

/// Size of a chart from `N` (its width; the height follows from the aspect, at least 1) or `WxH`.
ChartSize parse_chart_size(std::string_view option, const std::string& text,
                           const sphere::AnyParameterization& parameterization);

/// `yaw,pitch,roll` in degrees, `w,x,y,z` (quaternion) or nine numbers (matrix, row by row; orthonormal).
Matrix3 parse_rotation(std::string_view option, const std::string& text);

/// Options of every command that reads a map.
struct ReadFlags {
  int border = 0;
  std::string from, faces, convention, colour = "auto", primaries = "convert", channels, layer;
  std::string eye, stereo, encoding;
  std::optional<int> part;
  std::optional<int> level;
  bool pixels = true;  ///< whether opening may read some, to find out how faces join
  bool warn = true;    ///< on stderr of what the files' readers warn of

  void add(Command command);
  /// `--level`, for commands that read one level of a file with several.
  void add_level(Command command, const std::string& description);
  /// Throws UsageError.
  ReadMapOptions parse() const;
  /// The file opened, with the faces and the convention applied to the file's own parameterization, at the
  /// level.
  MapReader open(const std::string& path) const;
  /// The same, also where it is unknown which parameterization the file has.
  MapReader open_unknown(const std::string& path) const;
  LoadedMap read(const std::string& path) const;
};

/// Options of every command that writes a map.
struct WriteFlags {
  std::string faces, type, colour = "auto", compression;
  std::string quality, encoding;
  int border = 0;

  void add(Command command);
  /// Throws UsageError.
  WriteMapOptions parse() const;
};

/// `--format`, for commands that write to standard output where OUT is `-`.
void add_format(Command command, std::string& format);
/// The path to write to: `out`, or where that is `-` the standard output as a file of this format. Throws
/// UsageError for `-` without a format or to a terminal, and for a file with one.
std::string output_path(const std::string& out, const std::string& format);
/// The path to read from: `in`, or where that is `-` the standard input.
std::string input_path(const std::string& in);

/// UsageError for a name whose extension is that of no format which is written.
void check_extension(const std::string& path);
/// The basis of the diffuse light that a file of this name holds beside its levels; else empty.
std::string irradiance_of(const std::string& path);
/// The shape of a map in a file of this convention, as far as it differs: said on stderr. Of no convention,
/// says where one is expected.
void fit_to_convention(const std::string& path, const std::string& convention, MapShape& shape);
/// Finds out before any work whether `path` can be written in this shape: UsageError for a name that doesn't
/// fit (extension, `%s`, faces), Error for a folder that doesn't take the file.
void check_output(const std::string& path, const MapShape& shape, const WriteFlags& flags = {});
/// The same of the size: UsageError where the layout turns charts that aren't square, or the border is wider
/// than one.
void check_output_size(ChartSize size, const MapShape& shape, const WriteFlags& flags);

/// The same of the levels.
void check_output_levels(const std::string& path, const MapShape& shape, ChartSize size, int levels,
                         const WriteFlags& flags);

/// The file's levels: 1 also where the shape is unknown.
int levels_of(const MapFileInfo& info);

/// Makes the map's channels those that the file can hold (fit_channels), and says so on stderr unless `told`.
void fit_channels_to(Map& map, const std::string& path, const WriteMapOptions& options, bool told = false);

/// Warns on stderr of values that a format could not hold.
void report_losses(const std::string& path, const io::WriteReport& report);

}  // namespace welkin::cli
