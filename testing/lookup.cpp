#include "testing/lookup.h"

#include "base/meant.h"
#include "spec/limits.h"
#include "testing/check_javascript.h"
#include "testing/text/rules.h"
#include "testing/texts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string_view>

namespace orb::testing {
namespace {

/// Suggests the known name nearest to an unknown one.
Message meant(std::string_view word, const std::vector<std::string_view>& known,
              const Row<>& none) {
  return meant_or(word, known,
                  known.empty() ? none() : texts::ItHas(fmt::format("{}", fmt::join(known, ", "))));
}

std::vector<std::string_view> variables_of(const structured::Compiled& compiled) {
  std::vector<std::string_view> names;
  for (const auto& symbol : compiled.names.symbols)
    if (symbol.kind == structured::SymbolKind::Variable)
      names.push_back(compiled.program.name(symbol.name));
  return names;
}

/// Finds a variable's letter.
void find_variable(const Expectation& one, const Prepared& program, Lookup& found) {
  const auto& name = one.name.text;
  const auto* first = run::first_with_program(program.inputs);
  if (first == nullptr) {
    found.meaning.problem = texts::OnlyMacros();
  } else if (first->program->compiled) {
    const auto& compiled = *first->program->compiled;
    if (const auto letter = structured::letter_of(compiled, name)) {
      found.meaning.variable = *letter;
    } else {
      found.meaning.problem = texts::NoSuchVariable(program.name, name);
      found.help = meant(name, variables_of(compiled), texts::HasNoVariables);
    }
  } else if (name.size() == 1 && name[0] >= 'A' &&
             name[0] - 'A' < spec::value_of(spec::Limit::DirectVariables)) {
    found.meaning.variable = static_cast<std::size_t>(name[0] - 'A');
  } else {
    found.meaning.problem = texts::NoSuchVariable(program.name, name);
    found.help = texts::OnlyAToY();
  }
  if (!found.meaning.problem.empty())
    found.rule = &rules::Variable;
}

void find_macro(const Expectation& one, const Prepared& program, Lookup& found) {
  const auto at = program.macros.find(one.name.text);
  if (at != program.macros.end()) {
    found.meaning.macro = at->second;
    return;
  }
  std::vector<std::string_view> known;
  for (const auto& row : program.macros)
    known.push_back(row.first);
  found.meaning.problem = texts::NoSuchMacro(one.name.text);
  found.help = meant(one.name.text, known, texts::HasNoMacros);
  found.rule = &rules::Macro;
}

void find_zone(const Expectation& one, const SuiteFile& file, Lookup& found) {
  const auto& name = one.name.text;
  found.meaning.zone = file.course ? file.course->zone(name) : nullptr;
  if (found.meaning.zone != nullptr)
    return;
  found.rule = &rules::Zone;
  if (!file.course) {
    found.meaning.problem = texts::NoCourse(name);
    found.help = texts::AddCourse();
    return;
  }
  std::vector<std::string_view> known;
  for (const auto& zone : file.course->zones)
    known.push_back(zone.id);
  found.meaning.problem = texts::NoSuchZone(name);
  found.help = meant(name, known, texts::HasNoZones);
}

} // namespace

Lookup look_up_alone(const Expectation& one, const SuiteFile& file, const Prepared& program) {
  Lookup found;
  found.meaning.packed_bytes = program.packed_bytes;
  if (one.other_ball)
    found.meaning.other_ball = file.file.balls[*one.other_ball].name.text;
  if (program.is_javascript() && refuse_of_robot(one, program, found))
    return found;
  if (one.word == Word::Inside || one.word == Word::Stay)
    find_zone(one, file, found);
  else if (one.word == Word::Marker && !one.name.text.empty())
    find_macro(one, program, found);
  else if (one.word == Word::Variable)
    find_variable(one, program, found);
  return found;
}

std::vector<const Expectation*> parts_of(const Expectation& one) {
  std::vector<const Expectation*> parts{&one};
  for (const auto& other : one.joined)
    parts.push_back(&other);
  if (one.other)
    for (const auto* part : parts_of(*one.other))
      parts.push_back(part);
  return parts;
}

Meaning look_up(const Expectation& one, const SuiteFile& file, const Prepared& program) {
  auto meaning = look_up_alone(one, file, program).meaning;
  const auto add_problem = [&](const Meaning& part) {
    if (meaning.problem.empty())
      meaning.problem = part.problem;
  };
  for (const auto& part : one.joined)
    add_problem(meaning.joined.emplace_back(look_up(part, file, program)));
  if (one.other) {
    meaning.other = std::make_shared<const Meaning>(look_up(*one.other, file, program));
    add_problem(*meaning.other);
  }
  return meaning;
}

} // namespace orb::testing
