// The tables of the robots, and of the newer robots' packets.

#include "reference/sections.h"
#include "spec/robots.h"

#include <bit>
#include <fmt/format.h>
#include <limits>

namespace orb::reference {
namespace {

std::string_view v2_type_name(spec::V2Type type) {
  switch (type) {
  case spec::V2Type::U8: return "u8";
  case spec::V2Type::U16: return "u16";
  case spec::V2Type::U32: return "u32";
  case spec::V2Type::S16: return "s16";
  case spec::V2Type::F32: return "f32";
  case spec::V2Type::Text: return "text";
  case spec::V2Type::Data: return "bytes";
  }
  return "";
}

template <class Fields>
std::string fields_of(const Fields& fields, spec::V2Command command) {
  std::string out;
  for (const spec::V2Field& field : fields) {
    if (field.command != command)
      continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", v2_type_name(field.type), field.name);
    if (field.least < field.most && field.type != spec::V2Type::Text &&
        field.type != spec::V2Type::Data)
      out += fmt::format(" {} to {}", field.least, field.most);
  }
  return out.empty() ? "none" : out;
}

std::string robots_with(const spec::V2CommandInfo& command) {
  if (command.robots == spec::v2_set::All)
    return "all";
  std::string out;
  for (const auto& robot : spec::robots)
    if (robot.packets == spec::Packets::V2 && spec::knows(robot, command))
      out += fmt::format("{}{}", out.empty() ? "" : ", ", robot.title);
  return out;
}

/// `lamps 0 to 2 and 4 to 6`
std::string lamps_of(std::uint32_t mask) {
  std::string out;
  for (int lamp = 0; lamp < std::numeric_limits<std::uint32_t>::digits; ++lamp) {
    if ((mask >> lamp & 1U) == 0)
      continue;
    const int first = lamp;
    while (lamp + 1 < std::numeric_limits<std::uint32_t>::digits && (mask >> (lamp + 1) & 1U) != 0)
      ++lamp;
    out += out.empty() ? "" : " and ";
    out += first == lamp ? std::to_string(first) : fmt::format("{} to {}", first, lamp);
  }
  return out.empty() ? "none" : (std::has_single_bit(mask) ? "lamp " : "lamps ") + out;
}

/// What program words set and read on a packets v2 robot.
void add_words(Entry& entry, const spec::RobotInfo& row) {
  const bool matrix = spec::knows(row, spec::info(spec::V2Command::MatrixPixel));
  entry.facts.emplace_back("`RGB` and `LEDC`",
                           lamps_of(row.body) + (matrix ? ", and the matrix" : ""));
  entry.facts.emplace_back("`backLED`", std::popcount(row.aiming) > 1
                                            ? "the blue of " + lamps_of(row.aiming)
                                            : lamps_of(row.aiming));
  const auto battery = spec::battery(row.robot);
  entry.facts.emplace_back("battery", fmt::format("low at {} V, critical at {} V, full at {} V",
                                                  battery.low, battery.critical, battery.charged));
  if (const auto wakes = spec::wakes_in(row.robot); wakes.count() > 0)
    entry.facts.emplace_back("just woken",
                             fmt::format("drops what moves it for {} ms", wakes.count()));
}

/// The program words without effect on the robot.
std::string lacks_of(spec::Robot robot) {
  std::string out;
  for (const auto& row : spec::robot_lacks)
    if (row.robot == robot)
      out += fmt::format("{}`{}` ({})", out.empty() ? "" : ", ", row.word, row.why);
  return out;
}

} // namespace

Section robots_section() {
  Section section{"robots", "Robots", "robot", {}};
  for (const auto& row : spec::robots) {
    const auto& ble = spec::info(row.ble);
    const auto driving = spec::driving(row.robot);
    Entry entry;
    entry.name = row.name;
    entry.aliases = {std::string(row.title)};
    entry.summary =
        fmt::format("{}, packets {}", row.title, row.packets == spec::Packets::V1 ? "v1" : "v2");
    entry.facts.emplace_back("name over Bluetooth LE", row.robot == spec::Robot::Sphero
                                                           ? "none"
                                                           : fmt::format("{}…", ble.prefix));
    entry.facts.emplace_back("a command each", fmt::format("at least {} ms", row.interval.count()));
    entry.facts.emplace_back("processors", row.targets == spec::Targets::Both ? "2" : "1");
    entry.facts.emplace_back("speed 60", fmt::format("{:.0f} cm/s", spec::speed_cm_s(driving, 60)));
    entry.facts.emplace_back("speed 255",
                             fmt::format("{:.0f} cm/s", spec::speed_cm_s(driving, 255)));
    if (row.packets == spec::Packets::V2)
      add_words(entry, row);
    if (const auto lacks = lacks_of(row.robot); !lacks.empty())
      entry.facts.emplace_back("does not have", lacks);
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section robot_commands_section() {
  Section section{"robot-commands", "Commands of the newer robots", "v2 packet command", {}};
  for (const auto& row : spec::v2_commands) {
    Entry entry;
    entry.name = row.name;
    entry.aliases = {fmt::format("v2 {:02X}h {:02X}h", row.did(), row.cid())};
    entry.summary = row.summary;
    entry.facts.emplace_back("ids", fmt::format("{:02X}h {:02X}h", row.did(), row.cid()));
    entry.facts.emplace_back("operands", fields_of(spec::v2_operands, row.command));
    entry.facts.emplace_back("answer", fields_of(spec::v2_answers, row.command));
    entry.facts.emplace_back("robots", robots_with(row));
    if (row.processor != spec::V2Processor::Any)
      entry.facts.emplace_back("of two processors", row.processor == spec::V2Processor::Primary
                                                        ? "the first"
                                                        : "the second");
    if (!row.example.empty())
      entry.facts.emplace_back("example",
                               fmt::format("`orb encode --v2 {} {}`", row.name, row.example));
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
