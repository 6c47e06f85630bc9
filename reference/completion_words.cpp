#include "reference/completion_words.h"

#include "reference/knowledge.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace orb::reference {
namespace {

/// The options that may follow `command`: its own and the global ones.
std::vector<const Option*> options_of(const CommandLine& line, const Command* command) {
  std::vector<const Option*> options;
  if (command != nullptr)
    for (const auto& option : command->options)
      options.push_back(&option);
  for (const auto& option : line.orb.options)
    if (command == nullptr || !option.asks_for_help)
      options.push_back(&option);
  return options;
}

const Option* find_option(const CommandLine& line, const Command* command, std::string_view word) {
  for (const auto* option : options_of(line, command)) {
    for (const auto& name : option->long_names)
      if (word == "--" + name)
        return option;
    for (const auto& name : option->short_names)
      if (word == "-" + name)
        return option;
  }
  return nullptr;
}

const Command* find_command(const CommandLine& line, const std::string& name) {
  for (const auto& command : line.commands)
    if (command.name == name)
      return &command;
  return nullptr;
}

/// The position of the cursor: after which command, after which option, at which argument.
struct CursorContext {
  const Command* command = nullptr;
  const Option* wants_value = nullptr; ///< the previous word is this option
  std::size_t arguments = 0;           ///< arguments before it
  bool only_arguments = false;         ///< a `--` precedes it
  bool lost = false;                   ///< unknown command: nothing fits
};

CursorContext place_after(const CommandLine& line, std::span<const std::string> before) {
  CursorContext place;
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
      const auto* option = find_option(line, place.command, word);
      if (option != nullptr && option->kind != ValueKind::Nothing && !option->optional_value)
        place.wants_value = option;
      continue;
    }
    if (place.command == nullptr) {
      place.command = find_command(line, word);
      place.lost = place.command == nullptr;
    } else
      ++place.arguments;
    if (place.lost)
      break;
  }
  return place;
}

/// The argument for the next plain word; nothing if the command takes no more.
const Option* argument_at(const Command& command, std::size_t index) {
  for (const auto& option : command.options)
    if (!option.argument.empty()) {
      if (index < option.most)
        return &option;
      index -= option.most;
    }
  return nullptr;
}

/// Collects the candidates that begin with the typed text.
class Gatherer {
public:
  Gatherer(std::span<const Candidate> ports, std::string_view typed, std::string_view before)
      : ports_(ports), typed_(typed), before_(before) {}

  /// Shows only the first line of `summary`.
  void add(std::string_view word, std::string_view summary) {
    if (word.starts_with(typed_))
      found.candidates.push_back(
          {fmt::format("{}{}", before_, word), std::string(summary.substr(0, summary.find('\n')))});
  }

  void add_values(const Option& option) {
    switch (option.kind) {
    case ValueKind::Nothing:
    case ValueKind::Text: break;
    case ValueKind::Words:
      for (const auto& word : option.words)
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
    for (const auto& port : ports_)
      add(port.word, port.summary);
    add("rfcomm://", "rfcomm://AA:BB:CC:DD:EE:FF, a ball by its Bluetooth address");
    add("ble://", "ble://NAME or ble://ADDRESS, a robot over Bluetooth LE");
    add("serial://", "serial:///dev/NAME, a serial device");
    add("tcp://", "tcp://HOST:PORT, a ball that is served there");
    add("pty://", "pty:///PATH, a ball that is served there");
    add("replay://", "replay://FILE, a recording");
    found.files = true; // a port may be a bare path
  }

  /// Adds the entries of every section whose id contains `what`: `rules` matches both linters.
  void add_entries(std::string_view what) {
    for (const auto& section : knowledge())
      if (section.id.find(what) != std::string_view::npos &&
          (what != "commands" || section.id.find("macro") == std::string_view::npos))
        for (const auto& entry : section.entries)
          add(entry.name, entry.summary);
  }

  std::span<const Candidate> ports_;
  std::string_view typed_;
  std::string_view before_;
};

} // namespace

Completions complete(const CommandLine& line, std::span<const Candidate> ports,
                     std::span<const std::string> words) {
  const std::string typed = words.empty() ? std::string() : words.back();
  const auto place = place_after(line, words.empty() ? words : words.first(words.size() - 1));
  Gatherer gatherer(ports, typed, "");
  if (place.lost)
    return {};
  if (place.wants_value != nullptr) {
    gatherer.add_values(*place.wants_value);
    return gatherer.found;
  }
  if (!place.only_arguments && typed.starts_with("-")) {
    if (const auto equals = typed.find('='); equals != std::string::npos) {
      const auto* option = find_option(line, place.command, typed.substr(0, equals));
      Gatherer values(ports, std::string_view(typed).substr(equals + 1),
                      std::string_view(typed).substr(0, equals + 1));
      if (option != nullptr)
        values.add_values(*option);
      return values.found;
    }
    for (const auto* option : options_of(line, place.command))
      for (const auto& name : option->long_names)
        gatherer.add("--" + name, option->summary);
    return gatherer.found;
  }
  if (place.command == nullptr) {
    for (const auto& command : line.commands)
      gatherer.add(command.name, command.summary);
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

} // namespace orb::reference
