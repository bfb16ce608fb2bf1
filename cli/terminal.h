#pragma once

#include <string>

namespace welkin::cli {

/// Prints on stderr. A stderr that is closed or full is nobody's concern.
void tell(const std::string& text);

enum class ProgressMode { automatic, always, never };

/// How progress_monitor shows itself; set once, by main.
void set_progress_mode(ProgressMode mode);

/// Takes the places of standard streams that the caller closed, so that no file opened later is mistaken for one. Writing to
/// them still fails.
void hold_standard_streams();

/// On Ctrl-C, hang-up and termination: unfinished outputs are removed and the process ends with 128 + signal.
/// A file over the caller's size limit becomes an error of writing.
void remove_outputs_on_signals();

}  // namespace welkin::cli
