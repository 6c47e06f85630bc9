#include "cli/run_hints.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::cli {
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

} // namespace

std::string run_hint(std::string_view reason, const compiler::Program& program) {
  if (reason == "input")
    return "give it numbers with `--input 20,22`, or from a script with `--stimulus`";
  if (reason != "time-limit")
    return "";
  const auto cause = std::find_if(causes.begin(), causes.end(), [&](const auto& candidate) {
    return reads(program, candidate.variable);
  });
  if (cause == causes.end())
    return "";
  return fmt::format("it reads `{}`, and nothing happened to the ball; a file with the line `{}`, "
                     "given as `--stimulus FILE`, changes that",
                     spec::info(cause->variable).word, cause->line);
}

} // namespace orb::cli
