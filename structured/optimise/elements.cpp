#include "structured/optimise/elements.h"

#include "structured/analyse/flow.h"
#include "structured/analyse/line_facts.h"

#include <algorithm>

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
      // Keep the name of an argument, since fault messages use it.
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

  /// True if the element or the index changes while the variable that holds it is live.
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
    return line.kind == LineKind::Let && code.terms[line.term].kind == TermKind::Element;
  });
  return any && ElementUser(code).run();
}

} // namespace orb::structured
