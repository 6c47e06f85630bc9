#include "testing/replay.h"

#include "base/duration.h"
#include "base/text/shell.h"
#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::testing {
namespace {

// More would make the command longer than the test it repeats.
constexpr std::size_t most_stimuli = 6;

/// Spells a file name so that neither a shell nor a command line takes it for an option.
std::string path_word(std::string_view path) {
  return shell_word(path.starts_with('-') ? "./" + std::string(path) : std::string(path));
}

/// Spells an option whose value may begin with a dash.
std::string option(std::string_view name, std::string_view value) {
  return fmt::format(" {}{}{}", name, value.starts_with('-') ? "=" : " ", shell_word(value));
}

std::string seconds(Duration t) {
  return time_text(std::chrono::ceil<std::chrono::milliseconds>(t).count());
}

std::string with_line(const run::LinePlace& place, const std::string& file, std::string_view text) {
  return fmt::format("{}:{}: {}", file, place.line, trim(text));
}

std::string line_of_source(const run::Input& input, const std::string& file, std::uint32_t line) {
  if (input.source->name() == file)
    return std::string(input.source->line(line));
  for (const auto& other : input.included)
    if (other->name() == file)
      return std::string(other->line(line));
  return {};
}

/// The course, the stimuli and the page, as options.
std::string world_options(const SuiteFile& file, const Test& test, const Prepared& program) {
  std::string options;
  if (file.file.course)
    options += " --course " +
               path_word(structured::resolve_path(file.source->name(), file.file.course->text));
  for (const auto& line : test.stimulus_lines)
    options += " --stimulus " + shell_word(line);
  return options +
         fmt::format(" --report {}", path_word(fmt::format("{}.html", stem(program.name))));
}

/// Seldom called: the playground loads it later.
[[gnu::noinline]] std::string javascript_command(const SuiteFile& file, const Test& test,
                                                 const Prepared& program, std::uint64_t seed) {
  std::string command = "npx orb-robot run " + path_word(program.name);
  if (test.bound != default_bound)
    command +=
        fmt::format(" --limit {}", std::chrono::ceil<std::chrono::seconds>(test.bound).count());
  if (seed != 1)
    command += fmt::format(" --seed {}", seed);
  return command + world_options(file, test, program);
}

} // namespace

std::string place_of(const Prepared& program, const Running& running) {
  if (running.line > 0) {
    const auto* input = run::first_with_program(program.inputs);
    if (input == nullptr)
      return {};
    const auto& lines = input->program->lines;
    const auto at = lines.places.find(static_cast<std::uint32_t>(running.line));
    if (at == lines.places.end())
      return {};
    const auto& file = lines.files[at->second.file];
    return with_line(at->second, file, line_of_source(*input, file, at->second.line));
  }
  if (running.command <= 0)
    return {};
  const auto index = static_cast<std::size_t>(running.command) - 1;
  for (const auto& input : program.inputs)
    for (const auto& macro : input.macros)
      if (macro.image.id == running.macro && index < macro.command_lines.size() &&
          macro.command_lines[index] != 0)
        return with_line({0, macro.command_lines[index], 1, {}}, input.source->name(),
                         input.source->line(macro.command_lines[index]));
  return {};
}

std::string replay_command(const Suite& suite, const Group& group, std::uint64_t seed,
                           bool rolls_out) {
  const auto& file = suite.files[group.file];
  const auto& test = suite.test_of(group);
  const auto& program = suite.programs[group.program];
  if (program.is_javascript())
    return javascript_command(file, test, program, seed);
  const auto ball = suite.ball ? option("--ball", suite.ball->name) : std::string();
  if (rolls_out || !group.room.empty() || test.stimulus_lines.size() > most_stimuli) {
    auto command = fmt::format("orb test {}{} --seeds {}..{}", path_word(file.source->name()),
                               option("--only", test.name.text), seed, seed) +
                   ball;
    return group.room.empty()
               ? fmt::format("{} --program {} --report report", command, path_word(program.name))
               : command + " --report report";
  }
  std::string command = "orb run " + path_word(program.name) + ball;
  if (!program.language.empty())
    command += " --lang " + program.language;
  for (const auto& with : file.file.with)
    command += " " + path_word(structured::resolve_path(file.source->name(), with.text));
  if (test.bound != default_bound)
    command += " --for " + seconds(test.bound);
  if (seed != 1)
    command += fmt::format(" --seed {}", seed);
  if (!file.file.target_word.empty())
    command += " --target " + file.file.target_word;
  if (file.file.target.area == spec::Area::Flash)
    command += " --area flash";
  if (file.file.firmware != spec::default_firmware)
    command += fmt::format(" --firmware {}", spec::info(file.file.firmware).name);
  return command + world_options(file, test, program);
}

} // namespace orb::testing
