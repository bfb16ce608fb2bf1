#pragma once

#include <functional>
#include <string>

#include "welkin/map_file/map_file.h"

/// Pictures of two eyes in one. Internal to map files.
namespace welkin::map_file {

/// Size of one eye's picture. Throws Error (mismatch) where they can't be equal halves.
ChartSize eye_size(io::Stereo stereo, int width, int height);

/// The picture of the eye.
template <class T>
ImageView<T> eye_of(io::Stereo stereo, Eye eye, ImageView<T> picture) {
  const ChartSize size = eye_size(stereo, picture.width, picture.height);
  const int index = eye == Eye::left ? 0 : 1;
  return picture.part(stereo == io::Stereo::left_right ? index * size.width : 0,
                      stereo == io::Stereo::top_bottom ? index * size.height : 0, size.width, size.height);
}

bool two_eyes(io::Stereo stereo);

/// `one above the other`, `beside each other`.
std::string where_of(io::Stereo stereo);

/// How two eyes' pictures of this aspect lie in a picture of that size; not_said where they can't.
io::Stereo stereo_from_aspect(int width, int height, double aspect);

/// Finds out how two eyes' pictures lie in the file's, of that size, and which is read; `aspect` is that of
/// one eye's. Throws Error (bad_request), without the file, where that cannot be told.
void choose_eye(ChartSize picture, const ReadMapOptions& options, const std::function<double()>& aspect,
                MapFileInfo& info);

}  // namespace welkin::map_file
