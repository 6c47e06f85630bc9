#include "cli/values.h"

#include "base/suggest.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string_view>
#include <utility>

namespace orb::cli {
namespace {

/// The check of `one_of` marks itself by this name, so that `words_of` finds it again.
constexpr auto mark = "one of";

struct Kind {
  std::string_view name; ///< of the argument, or of the option without dashes
  ValueKind kind;
};

// Arguments by their name in usage lines, options by their long name. What is not here is free
// text unless it is checked by `one_of`.
constexpr Kind kinds[] = {
    {"FILE", ValueKind::File},       {"MACRO", ValueKind::File},
    {"SOURCE", ValueKind::File},     {"HEX", ValueKind::File},
    {"FOLDER", ValueKind::File},     {"WORD", ValueKind::Known},
    {"SECTION", ValueKind::Section}, {"NAME", ValueKind::Packet},
    {"URL", ValueKind::Port},        {"RULE", ValueKind::Rule},
    {"out", ValueKind::File},        {"output", ValueKind::File},
    {"map", ValueKind::File},        {"stimulus", ValueKind::File},
    {"trace-out", ValueKind::File},  {"report", ValueKind::File},
    {"svg", ValueKind::File},        {"record", ValueKind::File},
    {"state", ValueKind::File},      {"log", ValueKind::File},
    {"pty", ValueKind::File},        {"port", ValueKind::Port},
    {"deny", ValueKind::Rule},       {"warn", ValueKind::Rule},
    {"allow", ValueKind::Rule},      {"firmware", ValueKind::Firmware},
};

} // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  const auto list = fmt::format("{{{}}}", fmt::join(words, ","));
  auto known = std::make_shared<const std::vector<std::string>>(std::move(words));
  auto check = [known](std::string& value) -> std::string {
    if (std::find(known->begin(), known->end(), value) != known->end())
      return {};
    const std::vector<std::string_view> views(known->begin(), known->end());
    const auto meant = closest(value, views);
    return fmt::format("`{}` is not one of {}{}", value, fmt::join(*known, ", "),
                       meant ? fmt::format("; did you mean `{}`?", *meant) : "");
  };
  return CLI::Validator(std::move(check), list, mark);
}

std::vector<std::string> words_of(const CLI::Option& option) {
  // CLI11 has no way to list the checks of an option: its type name shows their descriptions.
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

std::string placeholder(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0)
    return {};
  if (option.get_positional())
    return option.get_name(true);
  switch (value_kind(option)) {
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

bool is_hidden(const CLI::App& command) {
  return command.get_group().empty();
}

} // namespace orb::cli
