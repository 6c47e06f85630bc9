#include "structured/optimise/elements.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"
#include "structured/analyse/line_facts.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

class ElementUser {
public:
  explicit ElementUser(Code& code)
      : code_(code), flow_(read_flow(code)), facts_(code_, flow_),
        liveness_(read_liveness(code, flow_)) {}

  bool run() {
    count();
    bool changed = false;
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      changed = read_at_once(b) || changed;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      changed = read_there(i) || changed;
    return changed;
  }

private:
  void count() {
    writes_.assign(code_.variables.size(), 0);
    for (const auto& line : code_.lines)
      each_write(code_, line, [&](std::uint32_t v) { ++writes_[v]; });
  }

  // ---- `read v`, `a[i] = v`

  bool read_at_once(std::uint32_t b) {
    const auto& block = flow_.blocks[b];
    bool changed = false;
    const auto out = liveness_.out[b];
    std::vector<std::uint64_t> live(out.begin(), out.end());
    for (auto i = block.end; i-- > block.begin;) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::SetElement && line.proven && put(block.begin, i, live))
        changed = true;
      step_back(code_, flow_, liveness_, code_.lines[i], live);
    }
    return changed;
  }

  /// Whether the value of line `i` comes from a statement above it that can set the element itself,
  /// in whose place only values for the index are computed.
  bool put(std::uint32_t begin, std::uint32_t i, std::span<const std::uint64_t> live) {
    const auto& value = code_.terms[code_.lines[i].term];
    if (value.kind != TermKind::Variable || contains(live, value.left) ||
        value.left == index_variable || code_.variables[value.left].kept)
      return false;
    for (auto n = i; n-- > begin;) {
      auto& line = code_.lines[n];
      if (line.kind == LineKind::Nothing)
        continue;
      const bool idle =
          (line.kind == LineKind::Let && is_pure(effects_of(code_, line))) ||
          (line.kind == LineKind::SetElement && line.proven && is_pure(effects_of(code_, line)));
      if (idle && !facts_.touches(line, value.left))
        continue;
      return is_last_of(line, value.left) && falls_through(line) && take_last(n, i);
    }
    return false;
  }

  bool is_last_of(const CodeLine& line, std::uint32_t variable) const {
    if (line.kind != LineKind::Do || line.parts_end == line.parts_begin)
      return false;
    const auto& last = code_.parts[line.parts_end - 1];
    const bool alone = line.parts_end - line.parts_begin == 1;
    return last.kind == PartKind::Variable && last.value == variable &&
           (alone || line.robot == spec::Statement::Read);
  }

  /// Line `to` reads the last of what line `from` reads.
  bool take_last(std::uint32_t from, std::uint32_t to) {
    auto& line = code_.lines[from];
    const auto begin = static_cast<std::uint32_t>(code_.parts.size());
    code_.parts.push_back({PartKind::Element, none, {}, {}});
    code_.lines[to] = line;
    code_.lines[to].parts_begin = begin;
    code_.lines[to].parts_end = begin + 1;
    if (--line.parts_end == line.parts_begin)
      line.kind = LineKind::Nothing;
    return true;
  }

  // ---- `v = a[i]`

  bool read_there(std::uint32_t i) {
    const auto line = code_.lines[i];
    if (line.kind != LineKind::Let || code_.terms[line.term].kind != TermKind::Element ||
        code_.terms[line.term].effects != effect::elements || line.variable == index_variable ||
        code_.variables[line.variable].kept || writes_[line.variable] != 1 ||
        contains(liveness_.in[0], line.variable) || moves(line.variable))
      return false;
    std::vector<std::pair<std::uint32_t*, std::uint32_t>> better; // roots
    bool fits = true;
    for (auto& other : code_.lines) {
      std::uint32_t reads = 0;
      each_line_read(code_, other, [&](std::uint32_t v) { reads += v == line.variable ? 1 : 0; });
      if (reads == 0)
        continue;
      // What a statement is given keeps the name that a fault speaks of.
      fits = fits && other.kind != LineKind::For && other.kind != LineKind::Next &&
             other.kind != LineKind::Switch &&
             (other.kind != LineKind::Do || code_.variables[line.variable].symbol == none);
      each_root(code_, other, [&](std::uint32_t& root) {
        if (facts_.reads(root, line.variable))
          better.push_back({&root, with_element(root, line.variable)});
      });
    }
    if (!fits || better.empty())
      return false;
    for (const auto& [root, term] : better)
      *root = term;
    code_.lines[i].kind = LineKind::Nothing;
    return true;
  }

  /// Whether the element changes, or the index, while the variable that holds it is needed.
  bool moves(std::uint32_t held) const {
    std::vector<std::uint64_t> live;
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      const auto out = liveness_.out[b];
      live.assign(out.begin(), out.end());
      for (auto i = flow_.blocks[b].end; i-- > flow_.blocks[b].begin;) {
        const auto& line = code_.lines[i];
        if ((facts_.sets_elements(line) || facts_.writes(line, index_variable)) &&
            (contains(live, held) || contains(liveness_.across[line.routine], held)))
          return true;
        step_back(code_, flow_, liveness_, line, live);
      }
    }
    return false;
  }

  std::uint32_t with_element(std::uint32_t root, std::uint32_t held) {
    return with_variables(code_, root, [&](std::uint32_t term) {
      if (code_.terms[term].left != held)
        return term;
      const auto element = code_.element();
      code_.terms[element].effects = effect::elements;
      return element;
    });
  }

  Code& code_;
  Flow flow_;
  LineFacts facts_;
  Liveness liveness_;
  std::vector<std::uint32_t> writes_; ///< of each variable
};

} // namespace

bool use_elements(Code& code) {
  const bool any = std::any_of(code.lines.begin(), code.lines.end(), [&](const CodeLine& line) {
    return line.kind == LineKind::SetElement ||
           (line.kind == LineKind::Let && code.terms[line.term].kind == TermKind::Element);
  });
  return any && ElementUser(code).run();
}

} // namespace orb::structured
