#pragma once

#include <memory>

#include "welkin/io/format.h"

namespace welkin::io {

/// The reader of a format, obeying what its file declares: pictures stand upright, colours are linear ones of
/// BT.709, or of their own primaries where ReadOptions::keep_primaries asks, and multiplied by their alpha
/// where that is read too. What can't be obeyed is a warning. The reader itself where nothing is to be done.
std::unique_ptr<Reader> interpret(std::unique_ptr<FormatReader> reader, const ReadOptions& options);

}  // namespace welkin::io
