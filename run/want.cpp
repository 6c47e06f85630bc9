#include "run/want.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::run {
namespace {

namespace stimulus = vm::stimulus;

template <class... Kinds>
bool is_one_of(const vm::Stimulus& event) {
  return (std::holds_alternative<Kinds>(event) || ...);
}

/// A sensor that changes only by an outside event, and the line of a stimulus script that causes
/// it.
struct Sensor {
  spec::Variable variable;
  std::string_view what;
  std::string_view lack;
  std::string_view line;
  bool (*brings)(const vm::Stimulus&);
};

constexpr auto feels =
    is_one_of<vm::Wall, stimulus::Push, stimulus::Shake, stimulus::Toss, stimulus::Tilt>;

constexpr auto sensors = std::to_array<Sensor>({
    {spec::Variable::Dshake, "a shake", "nothing shakes this ball", "at 2s shake",
     is_one_of<stimulus::Shake>},
    {spec::Variable::Cmdroll, "a roll from the client", "no client drives this ball",
     "at 2s roll 90 128", is_one_of<stimulus::ClientRoll>},
    {spec::Variable::Cmdrgb, "a colour from the client", "no client sets a colour here",
     "at 2s rgb 255 0 0", is_one_of<stimulus::ClientColor>},
    {spec::Variable::Accelone, "an impact or a fall", "nothing shakes or throws this ball",
     "at 2s toss 500ms", feels},
    {spec::Variable::AccelX, "an impact", "nothing pushes this ball", "at 2s push 90 200", feels},
    {spec::Variable::AccelY, "an impact", "nothing pushes this ball", "at 2s push 0 200", feels},
    {spec::Variable::Pitch, "somebody to tilt it", "nothing tilts this ball", "at 2s tilt 20 0",
     is_one_of<stimulus::Tilt>},
    {spec::Variable::Roll, "somebody to tilt it", "nothing tilts this ball", "at 2s tilt 0 20",
     is_one_of<stimulus::Tilt>},
    {spec::Variable::Sbatt, "a change in the battery state", "its battery stays full",
     "at 2s battery 6.9", is_one_of<stimulus::Battery, stimulus::Charger>},
});

bool comes(const Options& options, bool (*brings)(const vm::Stimulus&)) {
  if (options.course != nullptr && !options.course->walls.empty() && brings(vm::Wall{}))
    return true;
  return std::any_of(options.stimuli.begin(), options.stimuli.end(),
                     [&](const auto& event) { return brings(event.stimulus); });
}

/// Returns the robot's line number at byte `offset`.
std::uint32_t line_at(const compiler::Program& program, std::uint32_t offset) {
  const auto line = std::find_if(program.lines.begin(), program.lines.end(),
                                 [&](const auto& one) { return offset < one.span.end; });
  return line == program.lines.end() ? 0 : line->number;
}

std::optional<Want> number(const Program& of, const Options& options) {
  const auto& program = of.parsed;
  if (!options.numbers.empty() || options.asks == Asks::Yes ||
      comes(options, is_one_of<stimulus::Number>))
    return std::nullopt;
  for (const auto& statement : program.statements) {
    if (statement.kind != spec::Statement::Input || statement.error ||
        program.as<compiler::InputView>(statement).milliseconds != nullptr)
      continue;
    const auto line = line_at(program, statement.span.begin);
    const auto lack = fmt::format("{} waits for a number", of.where(line));
    return Want{line, "a number", lack + "; add `--input 20`", lack, true, "input 20"};
  }
  return std::nullopt;
}

std::optional<Want> sensor(const Program& of, const Options& options) {
  const auto& program = of.parsed;
  for (const auto& node : program.nodes) {
    if (node.kind != compiler::NodeKind::System)
      continue;
    const auto read = std::find_if(sensors.begin(), sensors.end(), [&](const auto& candidate) {
      return node.what == static_cast<std::uint8_t>(candidate.variable);
    });
    if (read == sensors.end() || comes(options, read->brings))
      continue;
    const auto line = line_at(program, node.span.begin);
    const auto lack = fmt::format("{} reads `{}`, but {}", of.where(line),
                                  program.text_of(node.span), read->lack);
    constexpr std::string_view time = "at 2s ";
    return Want{line, read->what, fmt::format("{}; add `--stimulus \"{}\"`", lack, read->line),
                lack, false,      read->line.substr(time.size())};
  }
  return std::nullopt;
}

} // namespace

std::optional<Want> want(std::span<const Input> inputs, const Options& options) {
  const auto* input = first_with_program(inputs);
  if (input == nullptr)
    return std::nullopt;
  const auto& program = *input->program;
  auto found = number(program, options);
  return found ? found : sensor(program, options);
}

} // namespace orb::run
