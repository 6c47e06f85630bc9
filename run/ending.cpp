#include "run/run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>

namespace orb::run {
namespace {

/// A sensor that only the world or a client changes, and the line of a stimulus script that does.
struct Cause {
  spec::Variable variable;
  std::string_view line;
};

constexpr auto causes = std::to_array<Cause>({
    {spec::Variable::Dshake, "at 2s shake"},
    {spec::Variable::Cmdroll, "at 2s roll 90 128"},
    {spec::Variable::Cmdrgb, "at 2s rgb 255 0 0"},
    {spec::Variable::Accelone, "at 2s toss 500ms"},
    {spec::Variable::Pitch, "at 2s tilt 20 0"},
    {spec::Variable::Roll, "at 2s tilt 0 20"},
    {spec::Variable::Sbatt, "at 2s battery 6.9"},
});

bool reads(const compiler::Program& program, spec::Variable variable) {
  return std::any_of(program.nodes.begin(), program.nodes.end(), [&](const auto& node) {
    return node.kind == compiler::NodeKind::System &&
           node.what == static_cast<std::uint8_t>(variable);
  });
}

/// How a sentence about the ending begins.
std::string_view verb(Reason reason) {
  switch (reason) {
  case Reason::End:
  case Reason::Error: return "ended";
  case Reason::Abort: return "stopped";
  case Reason::TimeLimit: return "stopped by the time limit";
  case Reason::Sleep: return "fell asleep, ended";
  case Reason::Input: return "still waiting for input, ended";
  }
  return "";
}

} // namespace

std::string_view to_string(Reason reason) {
  switch (reason) {
  case Reason::End: return "end";
  case Reason::Error: return "error";
  case Reason::Abort: return "abort";
  case Reason::TimeLimit: return "time-limit";
  case Reason::Sleep: return "sleep";
  case Reason::Input: return "input";
  }
  return "";
}

std::string to_string(const Ending& ending) {
  const auto ms = ending.lasted / 1ms;
  return fmt::format("{} after {}.{:03} s of robot time, {} lines", verb(ending.reason), ms / 1000,
                     ms % 1000, ending.lines);
}

std::string hint(const Ending& ending, std::span<const Input> inputs) {
  const auto program = std::find_if(inputs.begin(), inputs.end(),
                                    [](const Input& input) { return input.program.has_value(); });
  if (program == inputs.end())
    return "";
  if (ending.reason == Reason::Input)
    return "give it numbers with `--input 20,22`, or from a script with `--stimulus`";
  if (ending.reason != Reason::TimeLimit)
    return "";
  const auto cause = std::find_if(causes.begin(), causes.end(), [&](const auto& candidate) {
    return reads(program->program->parsed, candidate.variable);
  });
  if (cause == causes.end())
    return "";
  return fmt::format("it reads `{}`, and nothing happened to the ball; a file with the line `{}`, "
                     "given as `--stimulus FILE`, changes that",
                     spec::info(cause->variable).word, cause->line);
}

} // namespace orb::run
