#pragma once

#include <string>

namespace welkin::cli {

enum class ProgressMode { automatic, always, never };

/// How progress_monitor shows itself; set once, by main.
void set_progress_mode(ProgressMode mode);

/// On Ctrl-C, hang-up and termination: unfinished outputs are removed and the process ends with 128 + signal.
void remove_outputs_on_signals();

}  // namespace welkin::cli
