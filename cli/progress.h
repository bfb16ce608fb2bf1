#pragma once

#include <string>
#include <vector>

#include "welkin/base/monitor.h"

namespace welkin::cli {

/// Prints on stderr. Errors of writing there are ignored.
void print_message(const std::string& text);

/// Prints what reading a file changed, guessed or left undone, once for each file; not when set_quiet says
/// so.
void print_warnings(const std::string& path, const std::vector<std::string>& warnings);
void set_quiet(bool quiet);
/// One warning, unless set_quiet says so.
void print_warning(const std::string& path, const std::string& warning);

enum class ProgressMode { automatic, always, never };

/// How progress_monitor shows itself; set once, by main.
void set_progress_mode(ProgressMode mode);

/// A bar on stderr for work that takes over a second, on a terminal or as `--progress` says.
Monitor progress_monitor(std::string what);

/// Ends the bar's line, if there is one.
void end_progress();

}  // namespace welkin::cli
