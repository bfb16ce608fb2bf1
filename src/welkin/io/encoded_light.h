#pragma once

#include "welkin/io/format.h"

/// Pictures of 8 bits whose R G B A are radiance in a LightEncoding. Internal to io.
namespace welkin::io {

/// Text metadata that names the encoding, in files of ours.
inline constexpr const char* kEncodingKey = "welkin.encoding";

/// The reader's pictures decoded, where ReadOptions::encoding or the file's metadata name an encoding: R G B,
/// linear. Throws Error (mismatch) for an encoding that was asked for and pictures without four channels of
/// 8 bits; one that the metadata name is ignored there, with a warning.
std::unique_ptr<FormatReader> decode_light(std::unique_ptr<FormatReader> reader, const ReadOptions& options);

/// Throws Error for a picture, or for options, that can't be written so: (unsupported) formats other than
/// PNG, other types than 8 bits, channels other than R G B or Y.
void check_encoded(const WritePart& part, const WriteOptions& options, const Capabilities& format);

/// An encoded picture: floats of R G B A, each a whole number over 255. Y becomes R, G and B.
Image encode_light(const WritePart& part, const LightEncoding& encoding, WriteReport& report);

}  // namespace welkin::io
