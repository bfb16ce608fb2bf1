#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "welkin/base/export.h"

/// @file
/// What a program asks of the system about itself. Implemented beside the files, in platform_posix.cpp: the
/// one file with code for one kind of system.
namespace welkin::io {

/// Whether messages go to a terminal, where a progress bar makes sense.
WELKIN_API bool standard_error_is_terminal();

/// Whether results go to a terminal, which a file's bytes would garble.
WELKIN_API bool standard_output_is_terminal();

/// Makes standard input a file: the path that is returned stands for it, and an InputFile of it reads from
/// where it stands to its end. There is no more to read afterwards. At most once, before other threads.
WELKIN_API std::filesystem::path take_standard_input();

/// Makes standard output a file of that format: the path that is returned stands for it, and what an
/// OutputFile of it has received goes there when it is committed. All else that is printed to standard output
/// goes to standard error from now on. At most once, before other threads. Throws Error (system) where the
/// system refuses.
WELKIN_API std::filesystem::path take_standard_output(std::string_view extension);

/// The next bytes of standard input, as they come; fewer than asked for only at its end. From one thread at a
/// time. Throws Error (system).
WELKIN_API std::size_t read_standard_input(std::span<std::byte> bytes);

/// Passes bytes on to standard output at once, as a stream. At the first call, all else that is printed there
/// goes to standard error from then on. From one thread at a time. Throws Error (system): a program behind a
/// pipe that has closed it is one.
WELKIN_API void write_standard_output(std::span<const std::byte> bytes);

/// Reserves the descriptors of standard streams that the caller closed, so that no file opened later is
/// mistaken for one. Writing to them still fails. Call once, at the start of a program.
WELKIN_API void hold_standard_streams();

/// Installs signal handlers, which the library never does by itself: on Ctrl-C, hang-up and termination
/// unfinished outputs are removed and the process ends with 128 + signal. A file over the caller's size limit
/// becomes an error of writing. Call once, at the start of a program.
WELKIN_API void remove_outputs_on_signals();

}  // namespace welkin::io
