#pragma once

#include "command.h"

namespace welkin::cli {

/// Adds `cones` to `plot`.
void add_plot_cones(CLI::App& plot);
/// Adds `fresnel` to `plot`.
void add_plot_fresnel(CLI::App& plot);
/// Adds `lobe` to `plot`.
void add_plot_lobe(CLI::App& plot);

}  // namespace welkin::cli
