#include "debug/sources.h"

#include "base/text/text.h"
#include "run/start.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::debug {
namespace {

std::vector<Sources::Level> levels_of(const run::LinePlace& place, std::uint32_t first_file) {
  std::vector<Sources::Level> levels;
  std::uint32_t id = 0;
  for (const auto& call : place.calls) {
    levels.push_back({id, {first_file + call.file, call.line}, call.sub});
    id = call.id;
  }
  levels.push_back({id, {first_file + place.file, place.line}, place.sub});
  return levels;
}

/// Calls `visit` with the spots for which a line is the first one, outermost first.
template <class Visit>
void each_beginning(const Sources::Line& line, Visit visit) {
  const auto own = line.levels.size() - 1;
  for (auto k = line.shared == 0 ? 0 : line.shared - 1; k < own; ++k)
    visit(line.levels[k].spot);
  if (line.begins)
    visit(line.spot);
}

} // namespace

Sources::Sources(std::span<const run::Input> inputs, const run::Options& options) {
  for (const auto& input : inputs) {
    const auto file = static_cast<std::uint32_t>(files_.size());
    files_.push_back({input.source->name(), input.source.get()});
    for (const auto& other : input.included)
      files_.push_back({other->name(), other.get()});
    if (input.program) {
      const bool first = programs_.empty();
      main_file_ = first ? file : main_file_;
      add_program(input, run::area_of(programs_.size(), options), file);
    }
    for (const auto& macro : input.macros) {
      macro_names_[macro.image.id] = macro.name;
      for (std::size_t k = 0; k < macro.command_lines.size(); ++k)
        if (macro.command_lines[k] != 0)
          commands_.push_back(
              {macro.image.id, static_cast<int>(k) + 1, {file, macro.command_lines[k]}});
    }
  }
}

void Sources::add_program(const run::Input& input, spec::Area area, std::uint32_t file) {
  ProgramOf program{&input, area, file, {}};
  const auto holders = letter_holders(*input.program);
  const Line* before = nullptr;
  for (const auto& [number, place] : input.program->lines.places) {
    Line line{number, {file + place.file, place.line}, levels_of(place, file), 0, false, {}};
    line.shared = before == nullptr ? 0 : shared(*before, line);
    line.begins = line.shared < line.levels.size() || before == nullptr ||
                  before->levels[line.shared - 1].spot != line.spot;
    const auto found = holders.find(number);
    if (found != holders.end())
      line.symbols = found->second;
    else
      line.symbols.fill(structured::none);
    before = &program.lines.emplace(static_cast<int>(number), std::move(line)).first->second;
  }
  programs_.push_back(std::move(program));
}

std::string Sources::words(Spot spot) const {
  return fmt::format("{}:{}", files_[spot.file].name, spot.line);
}

std::string_view Sources::text(Spot spot) const {
  return trim(files_[spot.file].source->line(spot.line));
}

std::optional<std::uint32_t> Sources::file(std::string_view name) const {
  const auto with = [&](auto same) -> std::optional<std::uint32_t> {
    const auto found = std::find_if(files_.begin(), files_.end(), same);
    if (found == files_.end())
      return std::nullopt;
    return static_cast<std::uint32_t>(found - files_.begin());
  };
  if (const auto exact = with([&](const File& one) { return one.name == name; }))
    return exact;
  return with([&](const File& one) {
    return one.name.ends_with(fmt::format("/{}", name)) ||
           name.ends_with(fmt::format("/{}", one.name));
  });
}

const Sources::Line* Sources::line(spec::Area area, int number) const {
  for (const auto& program : programs_)
    if (program.area == area || programs_.size() == 1)
      if (const auto found = program.lines.find(number); found != program.lines.end())
        return &found->second;
  return nullptr;
}

const run::Input* Sources::input(spec::Area area) const {
  for (const auto& program : programs_)
    if (program.area == area || programs_.size() == 1)
      return program.input;
  return nullptr;
}

std::optional<Spot> Sources::spot(int macro, int command) const {
  for (const auto& one : commands_)
    if (one.macro == macro && one.command == command)
      return one.spot;
  return std::nullopt;
}

std::string Sources::macro_name(int macro) const {
  const auto found = macro_names_.find(macro);
  return found == macro_names_.end() ? fmt::format("macro {}", macro) : found->second;
}

std::size_t Sources::shared(const Line& a, const Line& b) {
  std::size_t count = 0;
  while (count < std::min(a.levels.size(), b.levels.size()) &&
         a.levels[count].is_same(b.levels[count]))
    ++count;
  return count;
}

std::optional<std::uint32_t> Sources::runs(std::uint32_t file, std::uint32_t line) const {
  std::optional<std::uint32_t> best;
  const auto take = [&](Spot spot) {
    if (spot.file == file && spot.line >= line && (!best || spot.line < *best))
      best = spot.line;
  };
  for (const auto& program : programs_)
    for (const auto& [number, one] : program.lines)
      each_beginning(one, take);
  for (const auto& one : commands_)
    take(one.spot);
  return best;
}

std::vector<int> Sources::robot_lines(Spot spot) const {
  std::vector<int> all;
  for (const auto& program : programs_)
    for (const auto& [number, one] : program.lines)
      each_beginning(one, [&, robot = number](Spot begins) {
        if (begins == spot)
          all.push_back(robot);
      });
  return all;
}

bool Sources::has_sub(std::string_view name) const {
  for (const auto& program : programs_)
    for (const auto& [robot, one] : program.lines)
      for (auto k = one.shared; k < one.levels.size(); ++k)
        if (!one.levels[k].sub.empty() && equal_words(one.levels[k].sub, name))
          return true;
  return false;
}

std::vector<Spot> Sources::subs(std::string_view name) const {
  std::vector<Spot> found;
  const auto number = parse_number<int>(name);
  const auto take = [&](Spot spot) {
    if (std::find(found.begin(), found.end(), spot) == found.end())
      found.push_back(spot);
  };
  for (const auto& program : programs_)
    for (const auto& [robot, one] : program.lines) {
      if (program.input->program->compiled == nullptr && number == robot)
        take(one.spot);
      for (auto k = one.shared; k < one.levels.size(); ++k)
        if (!one.levels[k].sub.empty() && equal_words(one.levels[k].sub, name))
          take(one.levels[k].spot);
    }
  if (!found.empty())
    return found;
  for (const auto& program : programs_)
    for (const auto& call : program.input->program->lines.calls)
      if (equal_words(call.called, name))
        if (const auto line = runs(program.first_file + call.place.file, call.place.line))
          take({program.first_file + call.place.file, *line});
  return found;
}

} // namespace orb::debug
