#include "structured/optimise/forward.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"
#include "structured/analyse/line_facts.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

constexpr std::uint32_t reach = 40; ///< lines over which a value is forwarded
constexpr std::uint16_t largest_joined_term = 64;

/// True if the line only assigns a dead variable, or assigns a variable or an element to itself.
bool is_dead(const Code& code, const CodeLine& line, std::span<const std::uint64_t> live) {
  if (line.kind == LineKind::SetElement)
    return line.proven && code.terms[line.term].kind == TermKind::Element;
  if (line.kind != LineKind::Let)
    return false;
  const auto& term = code.terms[line.term];
  if (term.kind == TermKind::Variable && term.left == line.variable)
    return true;
  return !contains(live, line.variable) && (term.effects & (effect::faults | effect::clears)) == 0;
}

class Forwarder {
public:
  explicit Forwarder(Code& code)
      : code_(code), flow_(read_flow(code)), facts_(code_, flow_),
        liveness_(read_liveness(code, flow_)) {}

  bool run() {
    constexpr int most_copies = 8;
    for (int n = 0; n < most_copies && copy_everywhere(); ++n) {
      flow_ = read_flow(code_);
      liveness_ = read_liveness(code_, flow_);
    }
    go_back();
    for (auto i = static_cast<std::uint32_t>(code_.lines.size()); i-- > 0;)
      if (code_.lines[i].kind == LineKind::Let)
        move(i);
    return changed_;
  }

private:
  void drop(CodeLine& line) {
    line.kind = LineKind::Nothing;
    changed_ = true;
  }

  // ---- facts about lines

  /// Removes dead assignments, and finds for each line the variables that it reads last.
  void go_back() {
    last_reads_ = VariableSets(code_.lines.size(), code_.variables.size());
    std::vector<std::uint64_t> live;
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      const auto out = liveness_.out[b];
      live.assign(out.begin(), out.end());
      for (auto i = flow_.blocks[b].end; i-- > flow_.blocks[b].begin;) {
        auto& line = code_.lines[i];
        if (is_dead(code_, line, live))
          drop(line);
        each_line_read(code_, line, [&](std::uint32_t v) {
          bool set = false;
          each_write(code_, line, [&](std::uint32_t w) { set = set || w == v; });
          if ((set && line.kind != LineKind::Next) || !contains(live, v))
            insert(last_reads_[i], v);
        });
        step_back(code_, flow_, liveness_, line, live);
      }
    }
  }

  bool live_at(std::uint32_t label, std::uint32_t variable) const {
    const auto block = flow_.block_of_label[label];
    return block != none && contains(liveness_.in[block], variable);
  }

  // ---- forwarding a value to its only reader

  void move(std::uint32_t i) {
    const auto variable = code_.lines[i].variable;
    if (variable == index_variable || code_.variables[variable].kept)
      return;
    const auto term = code_.lines[i].term;
    const auto last =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(code_.lines.size()), i + reach);
    for (auto j = i + 1; j < last; ++j) {
      auto& line = code_.lines[j];
      if (line.kind == LineKind::Label)
        return;
      std::uint32_t count = 0;
      each_line_read(code_, line, [&](std::uint32_t v) { count += v == variable ? 1 : 0; });
      if (count > 0) {
        if (count == 1 && contains(last_reads_[j], variable))
          substitute(i, j, variable, term);
        return;
      }
      if (facts_.touches(line, variable) || facts_.ends_text(line) || !facts_.passes(line, term))
        return;
      if (line.kind == LineKind::If && live_at(line.label, variable))
        return;
    }
  }

  /// Replaces the variable in line `j` by `term`, computed at line `i`.
  void substitute(std::uint32_t i, std::uint32_t j, std::uint32_t variable, std::uint32_t term) {
    auto& line = code_.lines[j];
    // A fault must be reported at its own statement.
    if ((code_.terms[term].effects & effect::faults) != 0 && code_.lines[i].origin != line.origin)
      return;
    std::uint8_t before = 0;
    bool done = false;
    bool good = true;
    each_root(code_, line, [&](std::uint32_t& root) {
      if (done || !good)
        return;
      if (!facts_.reads(root, variable)) {
        before |= code_.terms[root].effects;
        return;
      }
      if (line.kind == LineKind::For && &root == &line.end && facts_.reads(term, line.variable) &&
          !is_read_of(line.term, line.variable)) {
        good = false;
        return;
      }
      const auto result = replaced(root, variable, term, before);
      if (!result) {
        good = false;
        return;
      }
      root = *result;
      done = true;
    });
    if (!done)
      return;
    drop(code_.lines[i]);
    // The variables of the term are now read as late as here.
    each_read(code_, term, [&](std::uint32_t v) {
      bool last = false;
      for (auto k = i; k <= j; ++k) {
        last = last || contains(last_reads_[k], v);
        remove(last_reads_[k], v);
      }
      if (last)
        insert(last_reads_[j], v);
    });
  }

  bool is_read_of(std::uint32_t term, std::uint32_t variable) const {
    return code_.terms[term].kind == TermKind::Variable && code_.terms[term].left == variable;
  }

  /// `root` with the variable replaced by `term`; nothing if that is too deep or reorders side
  /// effects. `before` collects the effects computed before the variable.
  std::optional<std::uint32_t> replaced(std::uint32_t root, std::uint32_t variable,
                                        std::uint32_t term, std::uint8_t& before) {
    const auto node = code_.terms[root];
    if (node.kind == TermKind::Variable && node.left == variable) {
      if (ordered(before, code_.terms[term].effects))
        return std::nullopt;
      return term;
    }
    if (!facts_.reads(root, variable)) {
      before |= node.effects;
      return root;
    }
    std::optional<std::uint32_t> result;
    if (node.kind == TermKind::Binary) {
      const auto left = replaced(node.left, variable, term, before);
      const auto right = left ? replaced(node.right, variable, term, before) : std::nullopt;
      if (!right)
        return std::nullopt;
      result = code_.binary(static_cast<spec::Operator>(node.what), *left, *right);
    } else if (node.kind == TermKind::Call) {
      const auto operand = replaced(node.left, variable, term, before);
      if (!operand)
        return std::nullopt;
      result = code_.call(static_cast<spec::Function>(node.what), *operand);
    }
    if (!result || code_.terms[*result].size > largest_joined_term ||
        code_.terms[*result].levels > spec::value_of(spec::Limit::ExpressionLevels))
      return std::nullopt;
    return result;
  }

  // ---- copies

  std::uint32_t renamed(std::uint32_t root, std::uint32_t from, std::uint32_t to) {
    return with_variables(code_, root, [&](std::uint32_t term) {
      return code_.terms[term].left == from ? code_.read(to) : term;
    });
  }

  /// Replaces a copy by its original everywhere if the two never differ while the copy is live.
  /// Moves a sum to its reader if there is only one.
  bool copy_everywhere() {
    reads_ = reads_of(code_);
    writes_.assign(code_.variables.size(), {});
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i)
        each_write(code_, code_.lines[i], [&](std::uint32_t v) { writes_[v].push_back(b); });
    const auto first = liveness_.in[0];
    std::vector<bool> moved(code_.variables.size(), false); // their live ranges changed
    bool any = false;
    for (auto& line : code_.lines) {
      if (line.kind != LineKind::Let)
        continue;
      const auto copied = line.variable;
      const auto& term = code_.terms[line.term];
      constexpr std::uint16_t small = 5;
      const bool is_copy = term.kind == TermKind::Variable;
      const bool is_sum = (term.kind == TermKind::Binary || term.kind == TermKind::Call) &&
                          term.effects == 0 && term.size <= small && reads_[copied] == 1;
      if ((!is_copy && !is_sum) || copied == index_variable || code_.variables[copied].kept ||
          writes_[copied].size() != 1 || contains(first, copied))
        continue;
      bool moves = moved[copied];
      each_read(code_, line.term, [&](std::uint32_t v) {
        moves = moves || moved[v] || v == index_variable || v == copied || meet(copied, v, is_copy);
      });
      if (moves)
        continue;
      const auto root = line.term;
      if (is_copy ? rename(line, copied) : compute_there(line, copied)) {
        any = moved[copied] = true;
        each_read(code_, root, [&](std::uint32_t v) { moved[v] = true; });
      }
    }
    return any;
  }

  bool rename(CodeLine& line, std::uint32_t copied) {
    const auto original = code_.terms[line.term].left;
    drop(line);
    for (auto& other : code_.lines)
      each_root(code_, other, [&](std::uint32_t& root) { root = renamed(root, copied, original); });
    return true;
  }

  bool compute_there(CodeLine& line, std::uint32_t copied) {
    for (auto& other : code_.lines) {
      std::uint8_t before = 0;
      bool done = false;
      if (other.kind == LineKind::For) // its end is computed after its variable is set
        continue;
      each_root(code_, other, [&](std::uint32_t& root) {
        const auto result = replaced(root, copied, line.term, before);
        done = done || (result && *result != root);
        root = result.value_or(root);
      });
      if (!done)
        continue;
      drop(line);
      return true;
    }
    return false;
  }

  /// True if `set` is assigned while `needed`, which is assigned once, is live. For copies also if
  /// `set` is the counter of a loop.
  bool meet(std::uint32_t needed, std::uint32_t set, bool is_copy) const {
    std::vector<std::uint64_t> live;
    for (const auto b : writes_[set]) {
      const auto out = liveness_.out[b];
      live.assign(out.begin(), out.end());
      for (auto i = flow_.blocks[b].end; i-- > flow_.blocks[b].begin;) {
        const auto& line = code_.lines[i];
        bool writes = false;
        each_write(code_, line, [&](std::uint32_t v) { writes = writes || v == set; });
        if (writes && (contains(live, needed) || contains(liveness_.across[line.routine], needed) ||
                       (is_copy && (line.kind == LineKind::For || line.kind == LineKind::Next))))
          return true;
        step_back(code_, flow_, liveness_, line, live);
      }
    }
    return false;
  }

  Code& code_;
  Flow flow_;
  LineFacts facts_;
  Liveness liveness_;
  std::vector<std::vector<std::uint32_t>> writes_; ///< of each variable: blocks that set it
  VariableSets last_reads_;
  std::vector<std::uint32_t> reads_; ///< of each variable, in all lines
  bool changed_ = false;
};

} // namespace

bool forward_values(Code& code) {
  tidy(code);
  return Forwarder(code).run();
}

} // namespace orb::structured
