#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/assemble/piece.h"

/// The pictures that `welkin assemble` is given, each with settings of its own.
namespace welkin::cli {

/// A picture as it is asked for: `FILE[,KEY=VALUE]…`, or an object of a list.
struct PieceRequest {
  enum class Kind { panel, ball, backdrop };
  Kind kind = Kind::panel;
  std::string file;
  std::map<std::string, std::string> settings;
};

/// Of an option's value. Throws UsageError, naming the option.
PieceRequest parse_piece(std::string_view option, const std::string& text);

/// Of a JSON file: {"panels": [{"file": "left.png", "fov": 60, "yaw": 40}, …], "balls": […]}. Files are
/// beside it. Throws Error about the file.
std::vector<PieceRequest> read_piece_list(const std::string& path);

/// Throws UsageError for settings that there aren't or that aren't numbers, before any picture is read.
void check_piece(const PieceRequest& request);

/// A picture that was read.
struct ReadPiece {
  Piece piece;
  std::string note;  ///< what there is to tell of it
};

/// Opens and reads the picture. Throws Error.
ReadPiece read_piece(const PieceRequest& request);

}  // namespace welkin::cli
