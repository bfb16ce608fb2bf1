#pragma once

#include "welkin/base/export.h"

/// @file
/// What a program asks of the system about itself. Implemented beside the files, in platform_posix.cpp: the
/// one file with code for one kind of system.
namespace welkin::io {

/// Whether messages go to a terminal, where a progress bar makes sense.
WELKIN_API bool standard_error_is_terminal();

/// Reserves the descriptors of standard streams that the caller closed, so that no file opened later is
/// mistaken for one. Writing to them still fails. Call once, at the start of a program.
WELKIN_API void hold_standard_streams();

/// Installs signal handlers, which the library never does by itself: on Ctrl-C, hang-up and termination
/// unfinished outputs are removed and the process ends with 128 + signal. A file over the caller's size limit
/// becomes an error of writing. Call once, at the start of a program.
WELKIN_API void remove_outputs_on_signals();

}  // namespace welkin::io
