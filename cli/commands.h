#pragma once

#include <CLI/CLI.hpp>

/// The subcommands, each in the file of its name: declares its options on `app`, and its callback parses
/// them, calls the library and prints. A list of its own, so that another command costs the others no
/// compiling.
namespace welkin::cli {

void add_assemble(CLI::App& app);
void add_bake(CLI::App& app);
void add_convert(CLI::App& app);
void add_diff(CLI::App& app);
void add_importance(CLI::App& app);
void add_info(CLI::App& app);
void add_lights(CLI::App& app);
void add_list(CLI::App& app);
void add_lut(CLI::App& app);
void add_plot(CLI::App& app);
void add_render(CLI::App& app);
void add_project(CLI::App& app);
void add_roughness(CLI::App& app);
void add_sample(CLI::App& app);
void add_sh(CLI::App& app);
void add_synth(CLI::App& app);
void add_view(CLI::App& app);

}  // namespace welkin::cli
