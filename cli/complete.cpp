#include "cli/complete.h"

#include "cli/knowledge.h"
#include "cli/values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>

namespace orb::cli {
namespace {

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !is_hidden(*command); });
}

/// The options that fit after `command`: its own, and those of `app` that stand anywhere.
std::vector<const CLI::Option*> options_of(const CLI::App& app, const CLI::App* command) {
  std::vector<const CLI::Option*> options;
  if (command != nullptr)
    options = command->get_options();
  for (const auto* option : app.get_options())
    if (command == nullptr || (option != app.get_help_ptr() && option != app.get_version_ptr()))
      options.push_back(option);
  return options;
}

const CLI::Option* find_option(const CLI::App& app, const CLI::App* command,
                               std::string_view word) {
  for (const auto* option : options_of(app, command)) {
    for (const auto& name : option->get_lnames())
      if (word == "--" + name)
        return option;
    for (const auto& name : option->get_snames())
      if (word == "-" + name)
        return option;
  }
  return nullptr;
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  for (const auto* command : visible_commands(app))
    if (command->get_name() == name)
      return command;
  return nullptr;
}

/// Where the cursor is: behind which command, after which option, at which argument.
struct Place {
  const CLI::App* command = nullptr;
  const CLI::Option* wants_value = nullptr; ///< the word before is this option
  std::size_t arguments = 0;                ///< how many stand before
  bool only_arguments = false;              ///< a `--` stands before
  bool lost = false;                        ///< there is no such command: nothing fits
};

Place place_behind(const CLI::App& app, std::span<const std::string> before) {
  Place place;
  for (const auto& word : before) {
    if (place.wants_value != nullptr) {
      place.wants_value = nullptr;
      continue;
    }
    if (!place.only_arguments && word == "--") {
      place.only_arguments = true;
      continue;
    }
    if (!place.only_arguments && word.size() > 1 && word.front() == '-') {
      const auto* option = find_option(app, place.command, word);
      // An option whose value is optional takes it only behind `=`.
      if (option != nullptr && option->get_items_expected_min() > 0)
        place.wants_value = option;
      continue;
    }
    if (place.command == nullptr) {
      place.command = find_command(app, word);
      place.lost = place.command == nullptr;
    } else
      ++place.arguments;
    if (place.lost)
      break;
  }
  return place;
}

/// The argument that the next plain word is; nothing when the command takes no more.
const CLI::Option* argument_at(const CLI::App& command, std::size_t index) {
  for (const auto* option : command.get_options())
    if (option->get_positional()) {
      const auto most = static_cast<std::size_t>(option->get_items_expected_max());
      if (index < most)
        return option;
      index -= most;
    }
  return nullptr;
}

/// Gathers the candidates that begin with what is typed.
class Gatherer {
public:
  Gatherer(const Config& config, std::string_view typed, std::string_view before)
      : config_(config), typed_(typed), before_(before) {}

  /// `summary` may be long; its first line is shown.
  void add(std::string_view word, std::string_view summary) {
    if (word.starts_with(typed_))
      found.candidates.push_back(
          {fmt::format("{}{}", before_, word), std::string(summary.substr(0, summary.find('\n')))});
  }

  void add_values(const CLI::Option& option) {
    switch (value_kind(option)) {
    case ValueKind::Nothing:
    case ValueKind::Text: break;
    case ValueKind::Words:
      for (const auto& word : words_of(option))
        add(word, "");
      break;
    case ValueKind::File: found.files = true; break;
    case ValueKind::Port: add_ports(); break;
    case ValueKind::Rule: add_entries("rules"); break;
    case ValueKind::Packet: add_entries("commands"); break;
    case ValueKind::Firmware: add_entries("firmware"); break;
    case ValueKind::Known:
      for (const auto& section : knowledge())
        for (const auto& entry : section.entries)
          add(entry.name, entry.summary);
      break;
    case ValueKind::Section:
      for (const auto& section : knowledge())
        add(section.id, section.title);
      break;
    }
  }

  Completions found;

private:
  void add_ports() {
    add("sim:", "a virtual ball in this process");
    for (const auto& [name, url] : config_.balls)
      add("@" + name, url);
    std::error_code error;
    std::vector<std::string> devices;
    for (const auto& entry : std::filesystem::directory_iterator("/dev", error))
      if (entry.path().filename().string().starts_with("rfcomm"))
        devices.push_back(entry.path().string());
    std::sort(devices.begin(), devices.end());
    for (const auto& device : devices)
      add(device, "a bound Bluetooth ball");
    add("rfcomm://", "rfcomm://AA:BB:CC:DD:EE:FF, a ball by its Bluetooth address");
    add("serial://", "serial:///dev/NAME, a serial device");
    add("tcp://", "tcp://HOST:PORT, a served ball");
    add("pty://", "pty:///PATH, a served ball");
    add("replay://", "replay://FILE, a recording");
    found.files = true; // a bare path is a port too
  }

  /// The entries of every section whose id holds `what`: `rules` takes those of both linters.
  void add_entries(std::string_view what) {
    for (const auto& section : knowledge())
      if (section.id.find(what) != std::string_view::npos &&
          (what != "commands" || section.id.find("macro") == std::string_view::npos))
        for (const auto& entry : section.entries)
          add(entry.name, entry.summary);
  }

  const Config& config_;
  std::string_view typed_;
  std::string_view before_;
};

} // namespace

Completions complete(const CLI::App& app, const Config& config,
                     std::span<const std::string> words) {
  const std::string typed = words.empty() ? std::string() : words.back();
  const auto place = place_behind(app, words.empty() ? words : words.first(words.size() - 1));
  Gatherer gatherer(config, typed, "");
  if (place.lost)
    return {};
  if (place.wants_value != nullptr) {
    gatherer.add_values(*place.wants_value);
    return gatherer.found;
  }
  if (!place.only_arguments && typed.starts_with("-")) {
    if (const auto equals = typed.find('='); equals != std::string::npos) {
      const auto* option = find_option(app, place.command, typed.substr(0, equals));
      Gatherer values(config, std::string_view(typed).substr(equals + 1),
                      std::string_view(typed).substr(0, equals + 1));
      if (option != nullptr)
        values.add_values(*option);
      return values.found;
    }
    for (const auto* option : options_of(app, place.command))
      for (const auto& name : option->get_lnames())
        gatherer.add("--" + name, option->get_description());
    return gatherer.found;
  }
  if (place.command == nullptr) {
    for (const auto* command : visible_commands(app))
      gatherer.add(command->get_name(), command->get_description());
    return gatherer.found;
  }
  if (const auto* argument = argument_at(*place.command, place.arguments))
    gatherer.add_values(*argument);
  return gatherer.found;
}

std::string print(const Completions& completions) {
  std::string out;
  for (const auto& candidate : completions.candidates)
    out += candidate.summary.empty() ? candidate.word + "\n"
                                     : fmt::format("{}\t{}\n", candidate.word, candidate.summary);
  if (completions.files)
    out += ":files\n";
  return out;
}

} // namespace orb::cli
