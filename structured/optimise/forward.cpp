#include "structured/optimise/forward.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"
#include "structured/analyse/line_facts.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

constexpr std::uint32_t reach = 40; ///< lines that a value is followed
constexpr std::uint16_t largest_term = 64;

/// Whether a line only sets what nobody reads, or a variable or an element to itself.
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
      : code_(code), named_(tidy(code)), flow_(read_flow(code)), facts_(code_, flow_),
        liveness_(read_liveness(code, flow_)) {}

  bool run() {
    constexpr int most_copies = 8;
    for (int n = 0; n < most_copies && copy_everywhere(); ++n) {
      flow_ = read_flow(code_);
      liveness_ = read_liveness(code_, flow_);
    }
    go_back();
    reads_ = reads_of(code_);
    const auto size = static_cast<std::uint32_t>(code_.lines.size());
    if (reads_[index_variable] > 0)
      reuse_elements();
    for (auto i = size; i-- > 0;)
      if (code_.lines[i].kind == LineKind::Let && !move(i))
        copy(i);
    return changed_;
  }

private:
  void drop(CodeLine& line) {
    line.kind = LineKind::Nothing;
    changed_ = true;
  }

  // ---- facts about lines

  /// Removes what nobody reads, and finds of each line the variables that it reads and nothing
  /// after it.
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

  // ---- moving a value to its only reader

  bool move(std::uint32_t i) {
    const auto variable = code_.lines[i].variable;
    if (variable == index_variable || code_.variables[variable].kept)
      return false;
    const auto term = code_.lines[i].term;
    const auto last =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(code_.lines.size()), i + reach);
    for (auto j = i + 1; j < last; ++j) {
      auto& line = code_.lines[j];
      if (line.kind == LineKind::Label)
        return false;
      std::uint32_t count = 0;
      each_line_read(code_, line, [&](std::uint32_t v) { count += v == variable ? 1 : 0; });
      if (count > 0)
        return count == 1 && contains(last_reads_[j], variable) && substitute(i, j, variable, term);
      if (facts_.touches(line, variable) || facts_.ends_text(line) || !facts_.passes(line, term))
        return false;
      if (line.kind == LineKind::If && live_at(line.label, variable))
        return false;
    }
    return false;
  }

  /// Puts `term`, computed at line `i`, in place of the variable in line `j`.
  bool substitute(std::uint32_t i, std::uint32_t j, std::uint32_t variable, std::uint32_t term) {
    auto& line = code_.lines[j];
    // What stops the program stops it at its own statement.
    if ((code_.terms[term].effects & effect::faults) != 0 && code_.lines[i].origin != line.origin)
      return false;
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
      return false;
    drop(code_.lines[i]);
    // What the term reads is now read as late as here.
    each_read(code_, term, [&](std::uint32_t v) {
      bool last = false;
      for (auto k = i; k <= j; ++k) {
        last = last || contains(last_reads_[k], v);
        remove(last_reads_[k], v);
      }
      if (last)
        insert(last_reads_[j], v);
    });
    return true;
  }

  bool is_read_of(std::uint32_t term, std::uint32_t variable) const {
    return code_.terms[term].kind == TermKind::Variable && code_.terms[term].left == variable;
  }

  /// `root` with `term` in place of the variable; nothing where that would be too deep, or would
  /// change the order of what is noticed. `before` gathers what is computed before the variable.
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
    if (!result || code_.terms[*result].size > largest_term ||
        code_.terms[*result].levels > spec::value_of(spec::Limit::ExpressionLevels))
      return std::nullopt;
    return result;
  }

  // ---- copies

  /// Reads the original in place of a copy, where that does away with the copy.
  bool copy(std::uint32_t i) {
    const auto variable = code_.lines[i].variable;
    const auto source = code_.lines[i].term;
    if (variable == index_variable || code_.variables[variable].kept ||
        code_.terms[source].kind != TermKind::Variable)
      return false;
    const auto original = code_.terms[source].left;
    if (original == index_variable || original == variable)
      return false;
    std::uint32_t found = 0;
    std::vector<std::uint32_t> readers;
    const auto last =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(code_.lines.size()), i + reach);
    for (auto j = i + 1; j < last; ++j) {
      const auto& line = code_.lines[j];
      if (line.kind == LineKind::Label)
        break;
      std::uint32_t count = 0;
      each_root(code_, line, [&](std::uint32_t root) {
        each_read(code_, root, [&](std::uint32_t v) { count += v == variable ? 1 : 0; });
      });
      const bool original_set = line.kind == LineKind::For && line.variable == original;
      if (count > 0 && original_set)
        break;
      if (count > 0)
        readers.push_back(j);
      found += count;
      if (facts_.writes(line, variable) || facts_.writes(line, original) || facts_.ends_text(line))
        break;
    }
    if (found == 0 || found != reads_[variable])
      return false;
    for (const auto j : readers)
      each_root(code_, code_.lines[j],
                [&](std::uint32_t& root) { root = renamed(root, variable, original); });
    reads_[original] += found;
    reads_[variable] = 0;
    drop(code_.lines[i]);
    for (auto k = i; k <= readers.back(); ++k)
      remove(last_reads_[k], original);
    return true;
  }

  std::uint32_t renamed(std::uint32_t root, std::uint32_t from, std::uint32_t to) {
    return with_variables(code_, root, [&](std::uint32_t term) {
      return code_.terms[term].left == from ? code_.read(to) : term;
    });
  }

  /// Reads the original all through the program where a copy, once made, is never another value
  /// while it is needed; computes a sum where it is read, if that is one place.
  bool copy_everywhere() {
    reads_ = reads_of(code_);
    writes_.assign(code_.variables.size(), {});
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b)
      for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i)
        each_write(code_, code_.lines[i], [&](std::uint32_t v) { writes_[v].push_back(b); });
    const auto first = liveness_.in[0];
    std::vector<bool> moved(code_.variables.size(), false); // they live elsewhere now
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
      if (other.kind == LineKind::For) // its end is computed when its variable is set
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

  /// Whether a variable is set while another one, which is set once, is needed or, for copies, is
  /// what a loop counts in.
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

  // ---- elements that a variable holds

  struct Held {
    std::uint32_t index; ///< a term
    std::uint32_t variable;
    std::uint32_t since; ///< this line
  };

  /// What is known at a place: what the index was set to, while that is still so, and elements.
  struct Known {
    std::uint32_t index = none;
    std::uint32_t since = 0;     ///< this line
    std::uint32_t tested = none; ///< the same where its tests follow: it is 0 where they fail
    std::vector<Held> held;
  };

  /// What is known on all ways to a label that have been seen, all of them from above.
  struct Arrival {
    std::uint32_t ways = 0;
    Known known;
  };

  void arrive(Arrival& arrival, const Known& known) const {
    auto& all = arrival.known;
    if (arrival.ways++ == 0) {
      all = known;
      return;
    }
    if (all.index != none &&
        (known.index == none || known.tested != all.tested || !same(code_, all.index, known.index)))
      all.index = none;
    all.since = std::min(all.since, known.since);
    std::erase_if(all.held, [&](Held& held) {
      const auto other = std::find_if(known.held.begin(), known.held.end(), [&](const Held& one) {
        return one.variable == held.variable && same(code_, one.index, held.index);
      });
      if (other != known.held.end())
        held.since = std::min(held.since, other->since);
      return other == known.held.end();
    });
  }

  void read_on(std::uint32_t variable, std::uint32_t since, std::uint32_t until) {
    for (auto k = since; k < until; ++k)
      remove(last_reads_[k], variable);
  }

  /// The label after the tests of an index that is set in line `i`, or none where it has none.
  std::uint32_t end_of_tests(std::uint32_t i) const {
    const auto& lines = code_.lines;
    const auto is_test = [&](std::uint32_t n) {
      return n < lines.size() && lines[n].kind == LineKind::If && lines[n].guard;
    };
    if (lines[i].kind != LineKind::Let || lines[i].variable != index_variable || !is_test(i + 1))
      return none;
    const auto last = is_test(i + 2) ? i + 2 : i + 1;
    auto n = last + 1;
    if (n < lines.size() && lines[n].kind == LineKind::Label && last > i + 1 &&
        lines[n].label == lines[i + 1].label && named_[lines[n].label] == 1)
      ++n;
    else if (last > i + 1)
      return none;
    return n + 1 < lines.size() && lines[n].guard && lines[n].kind == LineKind::Let &&
                   lines[n + 1].kind == LineKind::Label && named_[lines[n + 1].label] == 1 &&
                   lines[last].label == lines[n + 1].label
               ? n + 1
               : none;
  }

  /// Whether the tests after two lines that set the index let the same pass.
  bool test_alike(std::uint32_t a, std::uint32_t b, std::uint32_t end_of_b) const {
    for (++a, ++b; b < end_of_b; ++a, ++b) {
      const auto& one = code_.lines[a];
      const auto& other = code_.lines[b];
      if (one.kind != other.kind || one.guard != other.guard)
        return false;
      if (one.kind != LineKind::If)
        continue;
      const auto& first = code_.conditions[one.condition].first;
      const auto& second = code_.conditions[other.condition].first;
      if (first.comparison != second.comparison || !same(code_, first.right, second.right))
        return false;
    }
    return code_.lines[a].kind == LineKind::Label;
  }

  /// What an element is known to be is read from the variable that holds it; an index is not set
  /// and tested again.
  void reuse_elements() {
    std::vector<Arrival> arrivals(code_.labels);
    Known known;
    auto& index = known.index; // not a structured binding: clang 14 lets no lambda capture one
    auto& since = known.since;
    auto& tested = known.tested;
    auto& elements = known.held;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      if (index != none && swap_stores(i, index, elements))
        read_on(index_variable, since, i);
      auto& line = code_.lines[i];
      if (const auto end = end_of_tests(i); end != none) {
        if (index != none && tested != none && same(code_, line.term, index) &&
            test_alike(tested, i, end)) {
          read_on(index_variable, since, i);
          for (; i < end; ++i)
            drop(code_.lines[i]);
          continue;
        }
        known = {is_still(line.term) ? line.term : none, i, i, {}};
        i = end;
        continue;
      }
      each_target(code_, line, [&](std::uint32_t label) { arrive(arrivals[label], known); });
      if (line.kind == LineKind::Label) {
        auto& arrival = arrivals[line.label];
        if (i > 0 && falls_through(code_.lines[i - 1]))
          arrive(arrival, known);
        else
          ++arrival.ways;
        known = arrival.ways == named_[line.label] + 1 ? arrival.known : Known{};
        auto live = liveness_.in[flow_.block_of_label[line.label]];
        insert(live, index_variable);
        for (const auto& held : elements)
          insert(live, held.variable);
        continue;
      }
      if (line.kind == LineKind::Gosub) {
        keep_over_call(line, known);
        continue;
      }
      if (line.kind == LineKind::Let && line.variable == index_variable && index != none &&
          tested == none && same(code_, line.term, index)) {
        read_on(index_variable, since, i);
        drop(line);
        continue;
      }
      const bool loads = line.kind == LineKind::Let && index != none &&
                         code_.terms[line.term].kind == TermKind::Element;
      const auto at = index;
      if (loads)
        for (const auto& held : elements)
          if (same(code_, held.index, index)) {
            line.term = code_.read(held.variable);
            ++reads_[held.variable];
            read_on(held.variable, held.since, i);
            changed_ = true;
            break;
          }
      if (index != none && line.kind != LineKind::For && line.kind != LineKind::Do)
        for (const auto& held : elements)
          if (held.since < since && is_element(held.variable, held.since) &&
              same(code_, held.index, index))
            read_there(line, held.variable, since, i);
      if (facts_.sets_elements(line))
        std::erase_if(elements, [&](const Held& held) {
          return index == none || !facts_.differ(held.index, index);
        });
      each_write(code_, line, [&](std::uint32_t v) {
        std::erase_if(elements, [&](const Held& held) {
          return held.variable == v || facts_.reads(held.index, v);
        });
        if (v == index_variable || (index != none && facts_.reads(index, v)))
          index = none;
      });
      if (line.kind == LineKind::Let && line.variable == index_variable) {
        index = is_still(line.term) ? line.term : none;
        since = i;
        tested = none;
      } else if (loads && index != none && line.variable != index_variable) {
        elements.push_back({at, line.variable, i});
      } else if (line.kind == LineKind::SetElement && index != none &&
                 code_.terms[line.term].kind == TermKind::Variable &&
                 code_.terms[line.term].left != index_variable) {
        elements.push_back({at, code_.terms[line.term].left, i});
      }
    }
  }

  void keep_over_call(const CodeLine& call, Known& known) const {
    if (known.index != none &&
        (facts_.writes(call, index_variable) || facts_.disturbs(call, known.index)))
      known.index = none;
    std::erase_if(known.held, [&](const Held& held) {
      return facts_.sets_elements(call) || facts_.writes(call, held.variable) ||
             facts_.disturbs(call, held.index);
    });
  }

  /// Whether a term stays the same while its variables do.
  bool is_still(std::uint32_t term) const {
    constexpr std::uint8_t moving = effect::clears | effect::senses | effect::elements;
    return (code_.terms[term].effects & moving) == 0 && !facts_.reads(term, index_variable);
  }

  /// Whether line `since` reads an element into a variable that is read once.
  bool is_element(std::uint32_t variable, std::uint32_t since) const {
    const auto& line = code_.lines[since];
    return line.kind == LineKind::Let && line.variable == variable && reads_[variable] == 1 &&
           !code_.variables[variable].kept && code_.terms[line.term].effects == effect::elements;
  }

  /// Reads the element itself in place of the only reading of the variable that holds it, where
  /// the index, set in line `since`, stands there again.
  void read_there(CodeLine& line, std::uint32_t variable, std::uint32_t since, std::uint32_t i) {
    each_root(code_, line, [&](std::uint32_t& root) {
      const auto better = with_variables(code_, root, [&](std::uint32_t term) {
        if (code_.terms[term].left != variable)
          return term;
        const auto element = code_.element();
        code_.terms[element].effects = effect::elements;
        return element;
      });
      if (better == root)
        return;
      root = better;
      reads_[variable] = 0;
      read_on(index_variable, since, i);
      changed_ = true;
    });
  }

  /// `Y=I; Z=A; Y=J; Z=B` where the index is J already: `Z=B; Y=I; Z=A`, if the elements are not
  /// one, or each gets what the other holds.
  bool swap_stores(std::uint32_t i, std::uint32_t index, std::span<const Held> all) {
    if (i + 3 >= code_.lines.size() || !contains(last_reads_[i + 3], index_variable) ||
        !stores(i) || !stores(i + 2) || !same(code_, code_.lines[i + 2].term, index))
      return false;
    const auto first = code_.lines[i].term;
    const auto value = code_.lines[i + 1].term;
    const auto other = code_.lines[i + 3].term;
    const auto is_held = [&](std::uint32_t at, std::uint32_t term) {
      return std::any_of(all.begin(), all.end(), [&](const Held& held) {
        return same(code_, held.index, at) && code_.terms[term].kind == TermKind::Variable &&
               code_.terms[term].left == held.variable;
      });
    };
    if (!facts_.differ(first, index) && !(is_held(first, other) && is_held(index, value)))
      return false;
    std::swap(code_.lines[i], code_.lines[i + 2]);
    std::swap(code_.lines[i + 1], code_.lines[i + 3]);
    drop(code_.lines[i]);
    for (auto k = i; k <= i + 3; ++k)
      each_member(last_reads_[k], [&](std::uint32_t v) { remove(last_reads_[k], v); });
    return true;
  }

  /// Whether two lines set an element, and nothing else matters to them.
  bool stores(std::uint32_t i) const {
    const auto& set = code_.lines[i];
    const auto& store = code_.lines[i + 1];
    return set.kind == LineKind::Let && set.variable == index_variable &&
           store.kind == LineKind::SetElement && store.proven && !set.guard && !store.guard &&
           code_.terms[set.term].effects == 0 && code_.terms[store.term].effects == 0 &&
           !facts_.reads(set.term, index_variable) && !facts_.reads(store.term, index_variable);
  }

  Code& code_;
  std::vector<std::uint32_t> named_; ///< of each label: how often
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
  return Forwarder(code).run();
}

} // namespace orb::structured
