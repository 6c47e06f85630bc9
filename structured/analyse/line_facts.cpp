#include "structured/analyse/line_facts.h"

namespace orb::structured {
namespace {

/// True if the line has an effect outside the program, or takes time.
bool acts(const CodeLine& line) {
  return line.kind == LineKind::Do || line.kind == LineKind::Print ||
         line.kind == LineKind::SetSystem || line.kind == LineKind::Gosub ||
         line.kind == LineKind::Return;
}

} // namespace

bool LineFacts::writes(const CodeLine& line, std::uint32_t variable) const {
  bool found = false;
  each_write(code_, line, [&](std::uint32_t v) { found = found || v == variable; });
  if (const auto routine = callee_of(line); routine != none)
    found = found || contains(flow_.written[routine], variable);
  return found;
}

bool LineFacts::touches(const CodeLine& line, std::uint32_t variable) const {
  bool found = writes(line, variable);
  each_line_read(code_, line, [&](std::uint32_t v) { found = found || v == variable; });
  if (const auto routine = callee_of(line); routine != none)
    found = found || contains(flow_.touched[routine], variable);
  return found;
}

bool LineFacts::sets_elements(const CodeLine& line) const {
  const auto callee = callee_of(line);
  return callee != none ? flow_.sets_elements[callee] : sets_element(code_, line);
}

std::uint8_t LineFacts::effects_of(const CodeLine& line) const {
  std::uint8_t effects = 0;
  each_root(code_, line, [&](std::uint32_t root) { effects |= code_.terms[root].effects; });
  if (line.kind == LineKind::SetElement)
    effects |= effect::faults;
  return effects;
}

bool LineFacts::reads(std::uint32_t term, std::uint32_t variable) const {
  bool found = false;
  each_read(code_, term, [&](std::uint32_t v) { found = found || v == variable; });
  return found;
}

bool LineFacts::disturbs(const CodeLine& line, std::uint32_t term) const {
  bool found = (code_.terms[term].effects & effect::elements) != 0 && sets_elements(line);
  each_write(code_, line, [&](std::uint32_t v) { found = found || reads(term, v); });
  if (const auto routine = callee_of(line); routine != none)
    each_read(code_, term,
              [&](std::uint32_t v) { found = found || contains(flow_.written[routine], v); });
  return found;
}

bool LineFacts::passes(const CodeLine& line, std::uint32_t term) const {
  const auto effects = code_.terms[term].effects;
  constexpr std::uint8_t noticed = effect::faults | effect::clears;
  if (disturbs(line, term) || ordered(effects, effects_of(line)))
    return false;
  if (acts(line) && (effects & (noticed | effect::senses)) != 0)
    return false;
  bool seen = false; // kept variables are inspected after the program stops
  each_write(code_, line, [&](std::uint32_t v) { seen = seen || code_.variables[v].kept; });
  if (seen && (effects & effect::faults) != 0)
    return false;
  const bool splits = line.kind == LineKind::If || line.kind == LineKind::Next;
  return !splits || (effects & noticed) == 0;
}

bool LineFacts::ends_text(const CodeLine& line) {
  return line.kind == LineKind::Label || line.kind == LineKind::Next || !falls_through(line);
}

} // namespace orb::structured
