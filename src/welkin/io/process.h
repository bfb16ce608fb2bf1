#pragma once

#include "welkin/base/export.h"

/// What a program asks of the system about itself. Implemented beside the files, in platform_posix.cpp: the
/// one file with code for one kind of system.
namespace welkin::io {

WELKIN_API bool standard_error_is_terminal();

/// Takes the places of standard streams that the caller closed, so that no file opened later is mistaken for
/// one. Writing to them still fails.
WELKIN_API void hold_standard_streams();

/// On Ctrl-C, hang-up and termination: unfinished outputs are removed and the process ends with 128 + signal.
/// A file over the caller's size limit becomes an error of writing.
WELKIN_API void remove_outputs_on_signals();

}  // namespace welkin::io
