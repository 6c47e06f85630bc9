#include "structured/relay.h"

#include "compiler/image.h"
#include "compiler/parse.h"
#include "compiler/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace orb::structured {
namespace {

namespace robot = compiler::rules;

/// The rules whose findings say something about the source, in words that fit it.
bool is_told(const Rule* rule) {
  for (const auto* told :
       {&robot::ValueOutOfRange, &robot::DivisionByZero, &robot::UnknownFlags, &robot::MissingGo,
        &robot::ReadPastData, &robot::ClearedByReading, &robot::DataReplaced, &robot::BusyLoop,
        &robot::IndexRange, &robot::NonprintingByte})
    if (rule == told)
      return true;
  return false;
}

class Relay {
public:
  Relay(Compiled& compiled, const compiler::Target& target)
      : compiled_(compiled), target_(target), plain_(compiler::parse(compiled.robot.text)) {}

  void run() {
    const auto image = compiler::build_image(plain_, compiler::Packing::Packed);
    compiled_.image_bytes = image.bytes.size();
    for (const auto& found : compiler::lint(plain_, target_))
      if (is_told(found.rule))
        tell(found);
    check_size(image);
  }

private:
  std::size_t line_at(std::uint32_t offset) const {
    const auto& lines = compiled_.robot.lines;
    const auto next =
        std::upper_bound(lines.begin(), lines.end(), offset,
                         [](std::uint32_t at, const RobotLine& line) { return at < line.offset; });
    return static_cast<std::size_t>(next - lines.begin()) - 1;
  }

  void tell(const Diagnostic& found) {
    auto& program = compiled_.program;
    const auto& line = compiled_.robot.lines[line_at(found.span.begin)];
    const auto span = program.statements[line.statement].span;
    const bool said = std::any_of(
        program.diagnostics.begin(), program.diagnostics.end(), [&](const Diagnostic& other) {
          return other.span.begin >= span.begin && other.span.end <= span.end &&
                 (other.rule == found.rule || other.severity == Severity::Error);
        });
    if (said)
      return;
    Diagnostic told = finding(*found.rule, span, found.message, found.help);
    told.severity = found.severity;
    if (found.rule == &robot::BusyLoop)
      told.message = "the loop runs for ever and never waits";
    if (found.rule == &robot::IndexRange)
      told.message = "the index lies outside of the array";
    program.diagnostics.push_back(std::move(told));
  }

  void check_size(const compiler::Image& image) {
    const auto size = static_cast<std::int32_t>(image.bytes.size());
    const auto room = compiler::area_bytes(target_);
    const bool in_ram = target_.area == compiler::Area::Ram;
    const auto oldest = spec::value_of(spec::Limit::RamBytesUntil146);
    if (size <= room && (!in_ram || target_.ram_bytes || size <= oldest))
      return;
    const auto limit = static_cast<std::uint32_t>(size > room ? room : oldest);
    std::size_t first = 0;
    while (first + 1 < image.lines.size() &&
           image.lines[first].offset + image.lines[first].size < limit)
      ++first;
    auto& program = compiled_.program;
    const auto span = program.statements[compiled_.robot.lines[first].statement].span;
    if (size > room)
      program.diagnostics.push_back(
          finding(robot::ProgramTooLarge, span,
                  fmt::format("the program takes {} bytes, {} more than the {} of the {} area",
                              size, size - room, room, in_ram ? "RAM" : "flash"),
                  parts(image)));
    else
      program.diagnostics.push_back(
          finding(robot::LargerThanOldRam, span,
                  fmt::format("the program takes {} bytes; older robots have {}", size, oldest),
                  "give `--ram 4096` if yours has more"));
  }

  /// The largest parts of the program, in bytes.
  std::string parts(const compiler::Image& image) const {
    std::map<std::uint32_t, std::uint32_t> bytes;
    for (std::size_t i = 0; i < image.lines.size(); ++i)
      bytes[compiled_.robot.lines[i].routine] += image.lines[i].size;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted;
    for (const auto& [routine, size] : bytes)
      sorted.push_back({size, routine});
    std::sort(sorted.rbegin(), sorted.rend());
    constexpr std::size_t most = 3;
    std::string text = "the largest parts:";
    for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
      const auto [size, routine] = sorted[i];
      const auto symbol = compiled_.names.routines[routine].symbol;
      text += fmt::format(
          "{} {} {} bytes", i == 0 ? "" : ",",
          symbol == none
              ? "the main program"
              : fmt::format("`{}`", compiled_.program.name(compiled_.names.symbols[symbol].name)),
          size);
    }
    return text;
  }

  Compiled& compiled_;
  const compiler::Target& target_;
  compiler::Program plain_;
};

} // namespace

void relay_findings(Compiled& compiled, const compiler::Target& target) {
  Relay(compiled, target).run();
}

void report_too_large(Compiled& compiled, const compiler::Target& target) {
  const auto room = compiler::area_bytes(target);
  compiled.program.diagnostics.push_back(
      finding(robot::ProgramTooLarge, compiled.program.statements.front().span,
              fmt::format("the program is far larger than the {} bytes of its area", room)));
}

} // namespace orb::structured
