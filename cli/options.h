#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The command line's words. CLI11 reads them; options.cpp alone (and main.cpp) includes its headers, which
/// cost every file ten seconds to compile.
namespace welkin::cli {

/// An option of a command, or a word of it that stands without one (a positional).
class Option {
 public:
  Option() = default;
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  /// Shows the variable's present value in the help.
  Option& show_default();
  /// What stands for the value in the help: `N`.
  Option& placeholder(const std::string& name);
  /// All that the help says between the names and the description: `TEXT [95, normal]`.
  Option& help_value(const std::string& text);
  /// Whether the option takes several words at once: `--specs A B C`.
  Option& several_words(bool several);

  Option& within(int lowest, int highest);
  Option& within(double lowest, double highest);
  Option& positive();
  /// A finite number of at least `minimum`.
  Option& finite(double minimum = -std::numeric_limits<double>::max());
  Option& one_of(const std::vector<std::string>& values);
  /// Calls `problem` with each value: what is wrong with it, or nothing.
  Option& check(std::function<std::string(const std::string&)> problem);

  /// How many times it was given.
  std::size_t count() const;
  bool given() const { return count() > 0; }
  /// `--size`, or for a positional `IN`.
  std::string name() const;
  /// Without their dashes.
  std::vector<std::string> long_names() const;
  bool positional() const;
  /// Whether it takes no value.
  bool flag() const;
  /// As they were written.
  std::vector<std::string> values() const;

 private:
  CLI::Option* option_ = nullptr;
};

/// A command, or a command of a command: a handle, as good as its copies.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  /// `names` are as `-j,--threads`, or as `IN` for a positional. `T` is one that options.cpp has an instance
  /// for.
  template <class T>
  Option add_option(const std::string& names, T& value, const std::string& description);
  Option add_flag(const std::string& names, bool& value, const std::string& description);
  /// One that may have a value, `--verify=5`, which is `fallback` where it has none.
  template <class T>
  Option add_flag(const std::string& names, T& value, const std::string& description);
  Command add_command(const std::string& name, const std::string& description);
  void require_command();
  /// Called when the command was given, after all options are parsed.
  void callback(std::function<void()> run);

  std::string name() const;
  std::vector<Option> options() const;
  /// Throws std::exception where there is none of this name.
  Option option(const std::string& name) const;

 private:
  CLI::App* app_;
};

}  // namespace welkin::cli
