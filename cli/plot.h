#pragma once

#include "command.h"

namespace welkin::cli {

/// Adds `cones` to `plot`.
void add_plot_cones(Command plot);
/// Adds `fresnel` to `plot`.
void add_plot_fresnel(Command plot);
/// Adds `lobe` to `plot`.
void add_plot_lobe(Command plot);

}  // namespace welkin::cli
