// What the tables know of the JavaScript API of Sphero Edu.

#include "reference/sections.h"
#include "spec/edu.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace orb::reference {
namespace {

using spec::EduPresence;
using spec::EduType;

std::string robots_of(spec::V2Robots robots) {
  if (robots == spec::edu_set::All)
    return "all";
  std::string out;
  for (const auto& row : spec::robots)
    if ((robots & spec::only(row.robot)) != 0)
      out += fmt::format("{}{}", out.empty() ? "" : ", ", row.title);
  return out;
}

bool has_range(const spec::EduOperand& operand) {
  switch (operand.type) {
  case EduType::Number:
  case EduType::Whole:
  case EduType::ColorOrNumber:
  case EduType::Point:
  case EduType::List: return operand.least < operand.most;
  case EduType::Bool:
  case EduType::Text:
  case EduType::Color:
  case EduType::Event:
  case EduType::Function:
  case EduType::Condition:
  case EduType::Picture:
  case EduType::Any: return false;
  }
  return false;
}

/// `speed -255 to 255, duration 0 to 999999 s`
std::string call_values(spec::EduCall call) {
  std::string out;
  for (const auto& operand : spec::edu_operands) {
    if (operand.call != call)
      continue;
    out += fmt::format("{}`{}` {}", out.empty() ? "" : "; ", operand.name,
                       spec::edu_types[static_cast<std::size_t>(operand.type)]);
    if (has_range(operand))
      out += fmt::format(" {} to {}", operand.least, operand.most);
    if (!operand.unit.empty())
      out += fmt::format(" {}", operand.unit);
    if (operand.presence != EduPresence::Required)
      out += operand.presence == EduPresence::Optional ? " (optional)" : " (any number of them)";
  }
  return out.empty() ? "none" : out;
}

std::string_view time_of(spec::EduKind kind) {
  switch (kind) {
  case spec::EduKind::Awaited: return "until it is done: `await` it";
  case spec::EduKind::AtOnce:
  case spec::EduKind::Reads:
  case spec::EduKind::Flow: return "none";
  }
  return "";
}

} // namespace

Section edu_calls_section() {
  Section section{"edu-calls", "Calls of Sphero Edu", "call of Sphero Edu", {}};
  section.overview =
      "The JavaScript functions that programs of Sphero Edu call. "
      "[docs/using/edu.md](../using/edu.md) has programs, and how orb checks and runs them.\n";
  for (const auto& row : spec::edu_calls) {
    Entry entry;
    entry.name = fmt::format("{}()", row.name);
    // Words that other languages have, too, mean those.
    if (std::any_of(row.name.begin(), row.name.end(),
                    [](unsigned char c) { return std::isupper(c) != 0; }))
      entry.aliases = {std::string(row.name)};
    entry.summary = row.summary;
    entry.facts.emplace_back("group", spec::edu_groups[static_cast<std::size_t>(row.group)]);
    entry.facts.emplace_back("values", call_values(row.call));
    if (row.gives != spec::EduGives::Nothing)
      entry.facts.emplace_back("gives", spec::edu_gives[static_cast<std::size_t>(row.gives)]);
    entry.facts.emplace_back("takes time", time_of(row.kind));
    entry.facts.emplace_back("robots", robots_of(row.robots));
    entry.facts.emplace_back("example", fmt::format("`{}`", row.example));
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section edu_events_section() {
  Section section{"edu-events", "Events of Sphero Edu", "event of Sphero Edu", {}};
  for (const auto& row : spec::edu_events) {
    Entry entry;
    entry.name = row.name;
    entry.summary = row.summary;
    if (row.says != spec::EduGives::Nothing)
      entry.facts.emplace_back("tells its function",
                               spec::edu_gives[static_cast<std::size_t>(row.says)]);
    if (row.condition == spec::EduCondition::Nothing)
      entry.facts.emplace_back("example",
                               fmt::format("`registerEvent(EventType.{0}, {0});`", row.name));
    else
      entry.facts.emplace_back(
          "example",
          fmt::format("`registerEventCondition(EventType.{0}, {0}, {1});`", row.name,
                      row.condition == spec::EduCondition::Number ? "100"
                                                                  : "value => value > 500"));
    entry.facts.emplace_back("robots", robots_of(row.robots));
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
