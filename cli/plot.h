#pragma once

#include "command.h"

namespace welkin::cli {

/// Adds `fresnel` to `plot`.
void add_plot_fresnel(CLI::App& plot);
/// Adds `lobe` to `plot`.
void add_plot_lobe(CLI::App& plot);

}  // namespace welkin::cli
