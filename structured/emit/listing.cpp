#include "structured/emit/listing.h"

#include <fmt/format.h>
#include <map>

namespace orb::structured {
namespace {

/// The name of the main program or of a sub.
std::string part_name(const Compiled& compiled, std::uint32_t routine) {
  const auto symbol = compiled.names.routines[routine].symbol;
  if (symbol == none)
    return "main program";
  const auto& named = compiled.names.symbols[symbol];
  return fmt::format("{} {}", named.kind == SymbolKind::Sub ? "sub" : "function",
                     compiled.program.name(named.name));
}

std::string_view trimmed(std::string_view line) {
  const auto begin = line.find_first_not_of(" \t");
  return begin == std::string_view::npos ? std::string_view() : line.substr(begin);
}

} // namespace

std::string listing(const Compiled& compiled, const compiler::Image& image) {
  const auto& program = compiled.program;
  std::vector<Source> sources;
  for (const auto& file : program.files)
    sources.emplace_back(file.name, program.text.substr(file.begin, file.end - file.begin));
  std::map<std::uint32_t, std::uint32_t> bytes; // of each routine
  std::string text;
  std::pair<std::uint32_t, std::uint32_t> shown{none, none}; // file and line
  for (std::size_t i = 0; i < image.lines.size(); ++i) {
    const auto& line = compiled.robot.lines[i];
    const auto& packed = image.lines[i];
    bytes[compiled.names.routine_of[line.statement]] += packed.size;
    const auto place = place_of(program, program.statements[line.statement].span);
    const auto& source = sources[place.file];
    const auto at = source.position(place.span.begin).line;
    if (shown != std::pair{place.file, at})
      text += fmt::format("{}:{}: {}\n", source.name(), at, trimmed(source.line(at)));
    shown = {place.file, at};
    const auto robot = std::string_view(image.bytes).substr(packed.offset, packed.size - 1);
    text += fmt::format("{:>8}  {}\n", packed.size, robot);
  }
  text += '\n';
  for (const auto& [routine, size] : bytes)
    text += fmt::format("{:>8}  {}\n", size, part_name(compiled, routine));
  return text + fmt::format("{:>8}  in total, including the final NUL\n", image.bytes.size());
}

} // namespace orb::structured
