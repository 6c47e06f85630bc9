#include "cli/model/command.h"

#include "cli/model/help.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <utility>

namespace orb::cli {

Option Option::check(const Check& check) const {
  option_->check(check.problem, check.range);
  return *this;
}

Option Option::check(std::function<std::string(const std::string&)> problem) const {
  option_->check(std::move(problem));
  return *this;
}

Option Option::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::show_default() const {
  option_->capture_default_str();
  return *this;
}

Option Option::show_default(const std::string& value) const {
  option_->default_str(value);
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

Option Option::environment(const std::string& name) const {
  option_->envname(name);
  return *this;
}

Option Option::one_value_each() const {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::value_optional() const {
  option_->expected(0, 1);
  return *this;
}

Option Option::separated_by(char separator) const {
  option_->delimiter(separator);
  return *this;
}

bool Option::given() const {
  return option_->count() > 0;
}

std::optional<std::string> Option::set_default(const std::vector<std::string>& values) const {
  try {
    for (const auto& value : values)
      option_->add_result(value);
    option_->run_callback();
    option_->clear(); // back to "not given": a flag or the environment still overrides it
  } catch (const CLI::Error& error) {
    return error.what();
  }
  return std::nullopt;
}

Command Command::add_command(const std::string& name, const std::string& summary,
                             const std::string& examples) const {
  auto* command = app_->add_subcommand(name, summary);
  command->formatter(std::make_shared<HelpFormatter>(examples + "\n"));
  command->fallthrough(); // lets -q, -v and --color follow the command
  return Command(*command);
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value,
                           const std::string& summary) const {
  return Option(*app_->add_option(names, value, summary));
}

template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::int32_t>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::int32_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<int>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<std::uint16_t>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::uint32_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const std::string&, double&, const std::string&) const;

Option Command::add_option(const std::string& names, std::function<void(const std::string&)> take,
                           const std::string& summary) const {
  return Option(*app_->add_option_function<std::string>(names, take, summary));
}

Option Command::add_flag(const std::string& names, bool& value, const std::string& summary) const {
  return Option(*app_->add_flag(names, value, summary));
}

Option Command::add_flag(const std::string& names, int& count, const std::string& summary) const {
  return Option(*app_->add_flag(names, count, summary));
}

Option Command::add_flag(const std::string& names, std::optional<std::string>& value,
                         const std::string& summary) const {
  return Option(*app_->add_flag(names, value, summary));
}

Option Command::add_flag(const std::string& names, const std::string& summary) const {
  return Option(*app_->add_flag(names)->description(summary));
}

void Command::callback(std::function<void()> run) const {
  app_->callback(std::move(run));
}

void Command::any_words() const {
  app_->fallthrough(false)->prefix_command(); // otherwise orb itself would interpret them
}

void Command::footer(const std::string& text) const {
  app_->footer(text);
}

std::string Command::name() const {
  return app_->get_name();
}

std::vector<Command> Command::commands() const {
  std::vector<Command> all;
  for (auto* command : app_->get_subcommands([](const CLI::App*) { return true; }))
    all.emplace_back(*command);
  return all;
}

std::optional<Option> Command::find(const std::string& name) const {
  auto* option = app_->get_option_no_throw(name);
  return option == nullptr ? std::nullopt : std::optional(Option(*option));
}

std::vector<std::string> Command::option_names() const {
  std::vector<std::string> names;
  for (const auto* option : app_->get_options())
    for (const auto& name : option->get_lnames())
      names.push_back(name);
  return names;
}

} // namespace orb::cli
