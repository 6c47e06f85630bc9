// Describes a stopped run as names and values.

#include "debug/debugger.h"
#include "run/start.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace orb::debug {
namespace {

/// The letters that a program with line numbers uses.
std::vector<std::size_t> letters_in(const compiler::Program& program) {
  std::vector<std::size_t> found;
  for (const auto& node : program.nodes)
    if (node.kind == compiler::NodeKind::Letter)
      found.push_back(node.what);
  for (const auto& item : program.items)
    if (item.kind == compiler::ItemKind::Letter)
      found.push_back(item.value);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool uses_array(const compiler::Program& program) {
  return std::any_of(program.nodes.begin(), program.nodes.end(),
                     [](const auto& one) { return one.kind == compiler::NodeKind::Indexed; }) ||
         std::any_of(program.items.begin(), program.items.end(),
                     [](const auto& one) { return one.kind == compiler::ItemKind::Indexed; });
}

std::string name_of(std::size_t letter) {
  return std::string(1, spec::letter_name(letter));
}

} // namespace

std::vector<Variable> Debugger::variables() const {
  std::vector<Variable> all;
  const auto& machine = timeline_->ball().machine();
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return all;
  if (!input->program->compiled) {
    for (const auto letter : letters_in(input->program->parsed))
      all.push_back({name_of(letter), fmt::format("{}", machine.variable(letter)), "", letter});
    return all;
  }
  const auto& compiled = *input->program->compiled;
  const auto* line = program_line();
  if (line == nullptr)
    return all;
  for (std::size_t i = 0; i < letters; ++i)
    if (line->symbols[i] != structured::none)
      all.push_back(
          {std::string(compiled.program.name(compiled.names.symbols[line->symbols[i]].name)),
           fmt::format("{}", machine.variable(i)), name_of(i), i});
  std::sort(all.begin(), all.end(),
            [](const Variable& a, const Variable& b) { return a.name < b.name; });
  return all;
}

std::vector<std::string> Debugger::arrays() const {
  std::vector<std::string> all;
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return all;
  if (!input->program->compiled) {
    if (uses_array(input->program->parsed))
      all.emplace_back("Z");
    return all;
  }
  const auto& compiled = *input->program->compiled;
  for (const auto& symbol : compiled.names.symbols)
    if (symbol.kind == structured::SymbolKind::Array)
      all.emplace_back(compiled.program.name(symbol.name));
  return all;
}

std::vector<Variable> Debugger::elements(std::string_view array) const {
  std::vector<Variable> all;
  for (std::int32_t i = 1;; ++i) {
    const auto place = element_register(array, i);
    if (!place)
      return all;
    all.push_back({fmt::format("{}[{}]", array, i),
                   fmt::format("{}", timeline_->ball().machine().variable(*place)), "", place});
  }
}

std::vector<Variable> Debugger::sensors() const {
  std::vector<Variable> all;
  for (std::size_t i = 0; i < spec::variables.size(); ++i) {
    const auto& row = spec::variables[i];
    all.push_back({std::string(row.word),
                   fmt::format("{}", timeline_->sensor(static_cast<spec::Variable>(i))),
                   std::string(row.unit), std::nullopt});
  }
  return all;
}

std::vector<Variable> Debugger::ball() const {
  const auto& ball = timeline_->ball();
  const auto pose = ball.body().world_pose();
  const auto color = ball.led();
  std::vector<Variable> all;
  const auto add = [&](std::string name, std::string value, std::string unit) {
    all.push_back({std::move(name), std::move(value), std::move(unit), std::nullopt});
  };
  add("time", fmt::format("{:.3f}", std::chrono::duration<double>(timeline_->time()).count()), "s");
  add("place", fmt::format("{:.1f}, {:.1f}", pose.x_cm + 0.0, pose.y_cm + 0.0), "cm");
  add("heading", fmt::format("{:.0f}", pose.heading_deg), "deg");
  add("speed", fmt::format("{:.1f}", pose.speed_cm_s), "cm/s");
  add("target",
      ball.body().speed_setpoint() == 0
          ? "stand still"
          : fmt::format("heading {:.0f}, speed {}", ball.body().heading_setpoint_deg(),
                        ball.body().speed_setpoint()),
      "");
  add("distance", fmt::format("{:.1f}", ball.body().way_cm()), "cm");
  add("colour", fmt::format("#{:02X}{:02X}{:02X}", color.red, color.green, color.blue), "");
  add("battery", fmt::format("{:.2f}", ball.body().battery_v()), "V");
  add("client", ball.connected() ? "connected" : "none", "");
  add("asleep", ball.asleep() ? "yes" : "no", "");
  return all;
}

std::vector<Variable> Debugger::limits() const {
  const auto& machine = timeline_->ball().machine();
  const auto& core = machine.core();
  std::vector<Variable> all;
  const auto of = [&](std::string name, std::size_t used, std::int64_t most, std::string unit) {
    all.push_back(
        {std::move(name), fmt::format("{} of {}", used, most), std::move(unit), std::nullopt});
  };
  const auto loops = core.frames.loop == nullptr
                         ? 0
                         : static_cast<std::size_t>(core.frames.loop - core.frames.loops.data());
  all.push_back({"lines", fmt::format("{}", machine.lines()), "executed", std::nullopt});
  of("calls", core.frames.call_depth, spec::value_of(spec::Limit::GosubDepth), "open");
  of("loops", loops, spec::value_of(spec::Limit::ForDepth), "open");
  of("data", core.data_next, static_cast<std::int64_t>(core.data_count), "read");
  const auto area = timeline_->ball().basic_area();
  of("program", timeline_->ball().basic_text(area).size(),
     area == spec::Area::Ram ? static_cast<std::int64_t>(run::ball_options(options_).ram_bytes)
                             : spec::value_of(spec::Limit::FlashBytes),
     "bytes");
  for (std::size_t i = 1; i <= loops; ++i) {
    const auto& loop = core.frames.loops[i];
    const auto name = loop.variable < letters ? name_of(loop.variable) : std::string("Z");
    all.push_back({fmt::format("for {}", name), fmt::format("to {} step {}", loop.end, loop.step),
                   "", std::nullopt});
  }
  return all;
}

} // namespace orb::debug
