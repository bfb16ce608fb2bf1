#pragma once

#include "command.h"

namespace welkin::cli {

/// Adds `lobe` to `plot`.
void add_plot_lobe(CLI::App& plot);

}  // namespace welkin::cli
