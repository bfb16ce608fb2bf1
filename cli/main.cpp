#include <fmt/core.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <new>

#include "command.h"
#include "commands.h"
#include "hints.h"
#include "progress.h"
#include "welkin/base/error.h"
#include "welkin/base/version.h"
#include "welkin/io/process.h"

namespace {

using namespace welkin;

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// What is wrong with words that the parser didn't expect: `unknown option '--szie'; did you mean '--size'?`
std::string explain_extras(const CLI::App& app, const std::string& what) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  std::vector<std::string> options;
  for (const CLI::App* each : {command, &app}) {
    for (const CLI::Option* option : each->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        if (std::count(options.begin(), options.end(), "--" + name) == 0) options.push_back("--" + name);
      }
    }
    if (command == &app) break;
  }
  const std::vector<std::string> commands = command_names(*command);
  for (const std::string& extra : app.remaining(true)) {
    if (extra.size() > 1 && extra.front() == '-')
      return unknown_name("option", extra.substr(0, extra.find('=')), options);
    if (!commands.empty()) return unknown_name("command", extra, commands);
  }
  return what;
}

int run(int argc, char** argv) {
  CLI::App app{"Environment maps: convert, bake, sample, measure.", "welkin"};
  app.set_version_flag("--version", "welkin " + std::string(version()));
  app.require_subcommand(1);
  app.fallthrough();
  int threads = 0;
  std::string progress = "auto";
  app.add_option("-j,--threads", threads, "Threads to use (0: one per core)")->check(CLI::Range(0, 1024));
  app.add_option("--progress", progress, "Progress bar: auto (on a terminal), always, never")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  bool quiet = false;
  app.add_flag("-q,--quiet", quiet, "No warnings on stderr of what reading changed, guessed or left undone");
  const cli::Command all(&app);
  cli::add_info(all);
  cli::add_convert(all);
  cli::add_bake(all);
  cli::add_view(all);
  cli::add_render(all);
  cli::add_roughness(all);
  cli::add_project(all);
  cli::add_sample(all);
  cli::add_importance(all);
  cli::add_diff(all);
  cli::add_assemble(all);
  cli::add_lights(all);
  cli::add_synth(all);
  cli::add_sh(all);
  cli::add_plot(all);
  cli::add_lut(all);
  cli::add_list(all);
  std::vector<std::string> topics;
  CLI::App* help = app.add_subcommand("help", "Help on a command");
  help->add_option("COMMAND", topics, "As `convert`, or `plot density`");
  app.footer("`welkin help COMMAND` says more. Documentation: docs/ in the source, README.md first.");

  std::unique_ptr<tbb::global_control> limit;
  app.parse_complete_callback([&] {
    if (threads > 0) {
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
    }
    cli::set_quiet(quiet);
    cli::set_progress_mode(progress == "always"  ? cli::ProgressMode::always
                           : progress == "never" ? cli::ProgressMode::never
                                                 : cli::ProgressMode::automatic);
  });

  const std::vector<std::string> commands = command_names(app);
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    throw cli::UsageError(unknown_name("command", argv[1], commands));
  }
  help->callback([&] {
    const CLI::App* command = &app;
    std::string before;
    for (const std::string& topic : topics) {
      const std::vector<std::string> names = command_names(*command);
      if (std::find(names.begin(), names.end(), topic) == names.end())
        throw cli::UsageError(unknown_name("command", topic, names));
      before += (before.empty() ? "" : " ") + command->get_name();
      command = command->get_subcommand(topic);
    }
    fmt::print("{}", command->help(before));
  });
  if (argc == 1) {
    fmt::print("{}", app.help());
    return 2;
  }
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    throw cli::UsageError(explain_extras(app, error.what()));
  }
}

constexpr const char* kNoOutput = "standard output: cannot be written";

/// Ends what was being shown before it says what went wrong.
int report(int status, const char* what) {
  cli::end_progress();
  std::fflush(stdout);
  constexpr std::size_t kLongest = 4096;
  cli::print_message(fmt::format("welkin: {}\n", cli::printable(what, kLongest)));
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  io::hold_standard_streams();
  io::remove_outputs_on_signals();
  try {
    const int status = run(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      return report(1, kNoOutput);
    }
    return status;
  } catch (const cli::UsageError& error) {
    return report(2, error.what());
  } catch (const std::bad_alloc&) {
    return report(1, "out of memory");
  } catch (const std::exception& error) {
    return report(1, std::ferror(stdout) != 0 ? kNoOutput : cli::with_option(error.what()).c_str());
  }
}
