#include "structured/emit/size.h"

#include "compiler/text/image.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace orb::structured {
namespace {

namespace robot = compiler::rules;
namespace robot_texts = compiler::texts;

/// Lists the largest parts of the program, in bytes.
Message largest_parts(const Compiled& compiled) {
  std::map<std::uint32_t, std::uint32_t> bytes;
  const auto& lines = compiled.image.lines;
  for (std::size_t i = 0; i < lines.size(); ++i)
    bytes[compiled.names.routine_of[compiled.robot.lines[i].statement]] += lines[i].size;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted;
  for (const auto& [routine, size] : bytes)
    sorted.push_back({size, routine});
  std::sort(sorted.rbegin(), sorted.rend());
  constexpr std::size_t most = 3;
  Message largest;
  for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) {
    const auto [size, routine] = sorted[i];
    const auto symbol = compiled.names.routines[routine].symbol;
    auto name = symbol == none
                    ? texts::TheMainProgram()
                    : texts::Quoted(compiled.program.name(compiled.names.symbols[symbol].name));
    largest = i == 0 ? texts::PartTakes(std::move(name), size)
                     : texts::PartsTake(std::move(largest), std::move(name), size);
  }
  return texts::LargestParts(std::move(largest));
}

} // namespace

void check_size(Compiled& compiled, const compiler::Target& target) {
  const auto& image = compiled.image;
  const auto size = static_cast<std::int32_t>(image.bytes.size());
  const auto room = compiler::area_bytes(target);
  const bool in_ram = target.area == compiler::Area::Ram;
  const auto oldest = spec::value_of(spec::Limit::RamBytesUntil146);
  if (size <= room && (!in_ram || target.ram_bytes || size <= oldest))
    return;
  const auto limit = static_cast<std::uint32_t>(size > room ? room : oldest);
  std::size_t first = 0;
  while (first + 1 < image.lines.size() &&
         image.lines[first].offset + image.lines[first].size < limit)
    ++first;
  auto& program = compiled.program;
  const auto span = program.statements[compiled.robot.lines[first].statement].span;
  if (size > room)
    program.diagnostics.push_back(
        finding(robot::ProgramTooLarge, span,
                robot_texts::MoreThanAreaHolds(size, size - room, room, in_ram ? "RAM" : "flash"),
                largest_parts(compiled)));
  else
    program.diagnostics.push_back(
        finding(robot::LargerThanOldRam, span, robot_texts::MoreThanOldRobotsHold(size, oldest),
                robot_texts::GiveRam(spec::value_of(spec::Limit::RamBytes))));
}

void report_too_large(Compiled& compiled, const compiler::Target& target) {
  compiled.program.diagnostics.push_back(finding(robot::ProgramTooLarge,
                                                 compiled.program.statements.front().span,
                                                 texts::FarLarger(compiler::area_bytes(target))));
}

} // namespace orb::structured
