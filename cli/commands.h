#pragma once

#include "options.h"

/// The subcommands, each in the file of its name: declares its options on `app`, and its callback parses
/// them, calls the library and prints. A list of its own, so that another command costs the others no
/// compiling.
namespace welkin::cli {

void add_assemble(Command app);
void add_bake(Command app);
void add_convert(Command app);
void add_diff(Command app);
void add_importance(Command app);
void add_info(Command app);
void add_lights(Command app);
void add_list(Command app);
void add_lut(Command app);
void add_plot(Command app);
void add_render(Command app);
void add_project(Command app);
void add_roughness(Command app);
void add_sample(Command app);
void add_sh(Command app);
void add_synth(Command app);
void add_view(Command app);

}  // namespace welkin::cli
