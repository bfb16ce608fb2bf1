#include "options.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <utility>

#include "command.h"

namespace welkin::cli {

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::placeholder(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::help_value(const std::string& text) {
  option_->option_text(text);
  return *this;
}

Option& Option::several_words(bool several) {
  option_->allow_extra_args(several);
  return *this;
}

Option& Option::within(int lowest, int highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}

Option& Option::within(double lowest, double highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

Option& Option::finite(double minimum) {
  return check([minimum](const std::string& text) -> std::string {
    const std::optional<double> value = finite_number(text);
    if (!value) return "'" + text + "' is not a number";
    return *value < minimum ? fmt::format("{} is below {}", text, minimum) : "";
  });
}

Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Option& Option::check(std::function<std::string(const std::string&)> problem) {
  option_->check(std::move(problem), "");
  return *this;
}

std::size_t Option::count() const {
  return option_->count();
}
std::string Option::name() const {
  return option_->get_name();
}
std::vector<std::string> Option::long_names() const {
  return option_->get_lnames();
}
bool Option::positional() const {
  return option_->get_positional();
}
bool Option::flag() const {
  return option_->get_items_expected_max() == 0;
}
std::vector<std::string> Option::values() const {
  return option_->results();
}

template <class T>
Option Command::add_option(const std::string& names, T& value, const std::string& description) {
  return Option(app_->add_option(names, value, description));
}

Option Command::add_flag(const std::string& names, bool& value, const std::string& description) {
  return Option(app_->add_flag(names, value, description));
}

template <class T>
Option Command::add_flag(const std::string& names, T& value, const std::string& description) {
  return Option(app_->add_flag(names, value, description));
}

Command Command::add_command(const std::string& name, const std::string& description) {
  return Command(app_->add_subcommand(name, description));
}

void Command::require_command() {
  app_->require_subcommand(1);
}
void Command::callback(std::function<void()> run) {
  app_->callback(std::move(run));
}
std::string Command::name() const {
  return app_->get_name();
}

std::vector<Option> Command::options() const {
  std::vector<Option> all;
  for (CLI::Option* option : app_->get_options({})) all.emplace_back(option);
  return all;
}

Option Command::option(const std::string& name) const {
  return Option(app_->get_option(name));
}

template Option Command::add_option(const std::string&, int&, const std::string&);
template Option Command::add_option(const std::string&, double&, const std::string&);
template Option Command::add_option(const std::string&, std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::add_flag(const std::string&, std::string&, const std::string&);

}  // namespace welkin::cli
