#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <new>

#include "command.h"
#include "terminal.h"
#include "version.h"

namespace {

using namespace welkin;

/// `unexpected --szie; did you mean '--size'?`
std::string explain_extras(const CLI::App& app, const std::string& what) {
  const CLI::App* command = &app;
  for (const CLI::App* each : app.get_subcommands()) command = each;
  std::string message = what;
  for (const std::string& extra : command->remaining()) {
    if (extra.rfind("-", 0) != 0) continue;
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    return unknown_name("option", extra.substr(0, extra.find('=')), known);
  }
  return message;
}

int run(int argc, char** argv) {
  CLI::App app{"Environment maps: convert, sample, measure.", "welkin"};
  app.set_version_flag("--version", std::string("welkin ") + WELKIN_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  int threads = 0;
  std::string progress = "auto";
  app.add_option("-j,--threads", threads, "Threads to use (0: one per core)")->check(CLI::Range(0, 1024));
  app.add_option("--progress", progress, "Progress bar: auto (on a terminal), always, never")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  cli::add_info(app);
  cli::add_convert(app);
  cli::add_sample(app);
  cli::add_diff(app);
  cli::add_synth(app);
  cli::add_plot(app);
  cli::add_list(app);
  std::string topic;
  CLI::App* help = app.add_subcommand("help", "Help on a command");
  help->add_option("COMMAND", topic);
  app.footer("`welkin help COMMAND` tells more. Documentation: docs/ in the source, README.md first.");

  std::unique_ptr<tbb::global_control> limit;
  app.parse_complete_callback([&] {
    if (threads > 0) {
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
    }
    cli::set_progress_mode(progress == "always"  ? cli::ProgressMode::always
                           : progress == "never" ? cli::ProgressMode::never
                                                 : cli::ProgressMode::automatic);
  });

  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  const auto unknown_command = [&](const std::string& name) {
    fmt::print(stderr, "welkin: {}\n", unknown_name("command", name, commands));
    return 2;
  };
  if (argc > 1 && argv[1][0] != '-' && std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    return unknown_command(argv[1]);
  }
  help->callback([&] {
    if (topic.empty()) {
      fmt::print("{}", app.help());
    } else if (std::find(commands.begin(), commands.end(), topic) != commands.end()) {
      fmt::print("{}", app.get_subcommand(topic)->help());
    } else {
      throw cli::UsageError(unknown_name("command", topic, commands));
    }
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
  } catch (const CLI::ExtrasError& error) {
    fmt::print(stderr, "welkin: {}\n", explain_extras(app, error.what()));
    return 2;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "welkin: {}\n", error.what());
    return 2;
  }
}

}  // namespace

int main(int argc, char** argv) {
  cli::remove_outputs_on_signals();
  try {
    const int status = run(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      fmt::print(stderr, "welkin: standard output: cannot be written\n");
      return 1;
    }
    return status;
  } catch (const cli::UsageError& error) {
    cli::end_progress();
    fmt::print(stderr, "welkin: {}\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    cli::end_progress();
    fmt::print(stderr, "welkin: out of memory\n");
    return 1;
  } catch (const std::exception& error) {
    cli::end_progress();
    fmt::print(stderr, "welkin: {}\n", error.what());
    return 1;
  }
}
