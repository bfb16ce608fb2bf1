#pragma once

#include <string>

#include "command.h"
#include "welkin/image/image.h"

/// Pictures that are no maps.
namespace welkin::cli {

/// The first `most` channels of a file's first picture, as many as it has.
Image read_picture(const std::string& file, int most, io::Colour colour = io::Colour::automatic);

/// Writes R G B A; only R G B where it is opaque or the format has no alpha.
/// `note`, where there is one, goes into its metadata as what the frame was made from.
void write_picture(const std::string& file, const Image& picture, bool opaque, const WriteFlags& flags,
                   const std::string& note = {});

}  // namespace welkin::cli
