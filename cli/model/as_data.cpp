#include "cli/model/command_line.h"
#include "cli/model/help.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

namespace orb::cli {
namespace {

using reference::ValueKind;

struct Kind {
  std::string_view name; ///< of the argument, or of the option without dashes
  ValueKind kind;
};

// Arguments by their name in usage lines, options by their long name. Anything else is free text
// unless `one_of` checks it.
constexpr Kind kinds[] = {
    {"FILE", ValueKind::File},         {"MACRO", ValueKind::File},
    {"SOURCE", ValueKind::File},       {"HEX", ValueKind::File},
    {"FOLDER", ValueKind::File},       {"WORD", ValueKind::Known},
    {"SECTION", ValueKind::Section},   {"NAME", ValueKind::Packet},
    {"URL", ValueKind::Port},          {"RULE", ValueKind::Rule},
    {"out", ValueKind::File},          {"output", ValueKind::File},
    {"map", ValueKind::File},          {"stimulus", ValueKind::File},
    {"trace-out", ValueKind::File},    {"report", ValueKind::File},
    {"svg", ValueKind::File},          {"record", ValueKind::File},
    {"state", ValueKind::File},        {"log", ValueKind::File},
    {"pty", ValueKind::File},          {"port", ValueKind::Port},
    {"program", ValueKind::File},      {"deny", ValueKind::Rule},
    {"warn", ValueKind::Rule},         {"allow", ValueKind::Rule},
    {"firmware", ValueKind::Firmware},
};

std::vector<std::string> words_of(const CLI::Option& option) {
  // CLI11 cannot list the checks of an option, but its type name contains their descriptions.
  const auto shown = option.get_type_name();
  const auto open = shown.find('{');
  const auto close = shown.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open)
    return {};
  return CLI::detail::split(shown.substr(open + 1, close - open - 1), ',');
}

ValueKind value_kind(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0)
    return ValueKind::Nothing;
  if (!words_of(option).empty())
    return ValueKind::Words;
  auto names = option.get_lnames();
  if (option.get_positional())
    names.push_back(option.get_name(true));
  names.push_back(option.get_type_name());
  for (const auto& name : names)
    for (const auto& row : kinds)
      if (row.name == name)
        return row.kind;
  return ValueKind::Text;
}

/// The placeholder of a value in usage lines.
std::string placeholder(const CLI::Option& option, ValueKind kind) {
  if (option.get_positional())
    return option.get_name(true);
  switch (kind) {
  case ValueKind::Nothing: return {};
  case ValueKind::Words: return fmt::format("{}", fmt::join(words_of(option), "|"));
  case ValueKind::File: return "FILE";
  case ValueKind::Port: return "URL";
  case ValueKind::Rule: return "RULE";
  case ValueKind::Text:
  case ValueKind::Known:
  case ValueKind::Section:
  case ValueKind::Packet:
  case ValueKind::Firmware: break;
  }
  const auto type = option.get_type_name();
  return type.empty() || type.find(' ') != std::string::npos ? "VALUE"
                                                             : type.substr(0, type.find(':'));
}

reference::Option describe(const CLI::App& app, const CLI::Option& option) {
  reference::Option out;
  out.short_names = option.get_snames();
  out.long_names = option.get_lnames();
  if (option.get_positional())
    out.argument = option.get_name(true);
  out.summary = option.get_description();
  out.kind = value_kind(option);
  out.words = words_of(option);
  out.placeholder = placeholder(option, out.kind);
  out.default_value = option.get_default_str();
  out.environment = option.get_envname();
  out.most = static_cast<std::size_t>(option.get_items_expected_max());
  out.required = option.get_required();
  out.optional_value = option.get_items_expected_min() == 0 && out.kind != ValueKind::Nothing;
  out.asks_for_help = &option == app.get_help_ptr() || &option == app.get_version_ptr();
  return out;
}

std::string examples_of(const CLI::App& command) {
  const auto formatter = command.get_formatter();
  const auto* help = dynamic_cast<const HelpFormatter*>(formatter.get());
  return help == nullptr ? std::string() : help->examples();
}

reference::Command describe(const CLI::App& app) {
  const auto footer = app.get_footer();
  reference::Command out{
      app.get_name(), app.get_description(), footer.size() > 1 ? footer : "", examples_of(app), {}};
  for (const auto* option : app.get_options())
    out.options.push_back(describe(app, *option));
  return out;
}

} // namespace

reference::CommandLine as_data(const Command& root) {
  reference::CommandLine line{describe(root.app()), {}};
  for (const auto& command : root.commands())
    line.commands.push_back(describe(command.app()));
  return line;
}

} // namespace orb::cli
