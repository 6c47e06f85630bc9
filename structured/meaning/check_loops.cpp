#include "base/text/text.h"
#include "structured/meaning/check_pass.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace orb::structured {
namespace {

/// Finds loops that end at once or never, count too far or share a counter, and lines that nothing
/// reaches.
class LoopsPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    for (const auto i : program_.order) {
      check_left(i);
      if (at(i).kind == Kind::Loop ||
          (at(i).kind == Kind::While && always_holds(item(at(i), 0).value)))
        check_endless(i);
      else if (at(i).kind == Kind::While && at(i).next != none)
        check_inverted(i);
      if (at(i).kind == Kind::For)
        check_counter(i);
      if (is_loop(at(i).kind) && at(i).next != none)
        check_single_round(i);
    }
    check_called_loops();
  }

private:
  /// Reports a loop that calls a routine with the same counter.
  void check_called_loops() {
    const auto calls = calls_of(program_, names_);
    // The loop of each routine, or of its callees, by counter variable.
    std::vector<std::map<std::uint32_t, std::uint32_t>> loops(calls.size());
    for (const auto i : program_.order)
      if (at(i).kind == Kind::For)
        loops[names_.routine_of[i]].try_emplace(variable_of(at(i)), i);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t r = 0; r < calls.size(); ++r) {
        const auto before = loops[r].size();
        for (const auto callee : calls[r])
          loops[r].insert(loops[callee].begin(), loops[callee].end());
        changed = changed || loops[r].size() != before;
      }
    }
    for (const auto i : program_.order) {
      const auto counter = at(i).kind == Kind::For ? variable_of(at(i)) : none;
      bool said = counter == none || at(i).next == none;
      for (auto n = i + 1; !said && n < at(i).next; ++n)
        each_call(program_, names_, n, [&](std::uint32_t routine, Span span) {
          const auto inner = loops[routine].find(counter);
          if (said || inner == loops[routine].end())
            return;
          said = true;
          const auto called = [&](std::uint32_t one) {
            return program_.name(names_.symbols[names_.routines[one].symbol].name);
          };
          const auto name = program_.name(names_.symbols[counter].name);
          auto& d = report(compiler::rules::LoopVariableSet, span,
                           texts::SetsCounter(called(routine), name),
                           texts::WriteIn(fmt::format("local {}", name),
                                          called(names_.routine_of[inner->second])));
          d.notes.push_back({at(i).span, compiler::texts::TheLoop()});
          d.notes.push_back({at(inner->second).span, texts::TheOtherLoop()});
        });
    }
  }

  /// True if a condition of constants holds.
  bool always_holds(std::uint32_t condition) const {
    const auto& node = program_.nodes[condition];
    const bool equality =
        node.kind == NodeKind::Relation && static_cast<Comparison>(node.what) == Comparison::Equal;
    const auto right = evaluate(program_, names_, equality ? condition - 1 : condition);
    if (!equality || !right)
      return right && right->value != 0;
    const auto left = evaluate(program_, names_, program_.before(condition - 1));
    return left && left->value == right->value;
  }

  /// Reports a loop that waits while a momentary condition holds.
  void check_inverted(std::uint32_t i) {
    const auto condition = item(at(i), 0).value;
    const auto& root = program_.nodes[condition];
    const auto asked = root.kind == NodeKind::Relation ? program_.before(condition - 1) : condition;
    const auto& node = program_.nodes[asked];
    if (node.kind != NodeKind::System)
      return;
    const auto& row = spec::info(static_cast<spec::Variable>(node.what));
    const auto bound = root.kind == NodeKind::Relation ? bound_of(condition) : std::nullopt;
    if (row.access != spec::Access::ReadClears || (root.kind == NodeKind::Relation && !bound) ||
        (bound && (!bound->holds(row.greatest) || bound->holds(row.least))))
      return;
    for (auto n = i + 1; n < at(i).next; ++n)
      if (at(n).kind != Kind::Robot || at(n).robot != spec::Statement::Delay)
        return;
    auto turned = fmt::format("not {}", row.word);
    auto& d = report(compiler::rules::InvertedWait, root.span,
                     compiler::texts::ForOneReadingOnly(row.word, row.greatest),
                     texts::Write("while " + turned));
    d.fix = single_fix(d.help, root.span, std::move(turned), Safety::Unsafe);
  }

  /// Reports code after a loop without an exit.
  void check_endless(std::uint32_t i) {
    const auto end = at(i).next;
    std::uint32_t loops = 0;
    for (auto n = i + 1; n < end; ++n) {
      const auto kind = at(n).kind;
      if (kind == Kind::Goto || (kind == Kind::Exit && loops == 0))
        return;
      loops += is_loop(kind) ? 1 : 0;
      loops -= at(n).opener != none && is_loop(at(at(n).opener).kind) ? 1 : 0;
    }
    if (const auto* const after = never_reached(i, end + 1))
      report(compiler::rules::UnreachableLine, after->span, texts::NothingLeaves(),
             texts::LeaveWithExit());
  }

  /// Reports code after a statement that does not fall through: `end`, `sleep`, `goto`, `return`,
  /// `exit`.
  void check_left(std::uint32_t i) {
    const auto& statement = at(i);
    const bool ends =
        statement.kind == Kind::Robot && spec::info(statement.robot).after == spec::After::Ends;
    if (!ends && statement.kind != Kind::Goto && statement.kind != Kind::Return &&
        statement.kind != Kind::Exit && statement.kind != Kind::Continue)
      return;
    const auto* const after = never_reached(i, i + 1);
    if (after == nullptr)
      return;
    const auto word = program_.text_of(statement.word);
    const bool sleeps = ends && statement.robot == spec::Statement::Sleep;
    const auto seconds =
        sleeps && size(statement) == 1 ? value_of(item(statement, 0)) : std::nullopt;
    constexpr std::int32_t second = 1000; // ms; larger values were already meant as ms
    const auto longest = spec::info(spec::Statement::Delay).parameters()[0].greatest / second;
    auto& d = report(compiler::rules::UnreachableLine, after->span, texts::UnreachableAfter(word),
                     seconds  ? texts::ForPause(fmt::format("delay {}{}", seconds->value,
                                                           seconds->value > longest ? "" : "s"))
                     : sleeps ? texts::ForPause(fmt::format(
                                    "delay {}", program_.text_of(item(statement, 0).span)))
                     : ends   ? texts::RemoveAbove(word)
                              : texts::RemoveLine());
    d.notes.push_back({statement.span, sleeps ? texts::FallsAsleep()
                                       : ends ? texts::EndsHere()
                                              : texts::NeverPast()});
  }

  /// Reports a loop whose counter is an index that goes out of bounds.
  void check_counter(std::uint32_t i) {
    const auto& loop = at(i);
    const auto counter = names_.of_node[item(loop, 0).value];
    const auto first = value_of(item(loop, 1));
    const auto last = value_of(item(loop, 2));
    if (counter == none || !first || !last || size(loop) > 3 || first->value > last->value)
      return;
    for (auto n = i + 1; n < loop.next; ++n) {
      const auto& statement = at(n);
      if (statement.kind == Kind::Exit || statement.kind == Kind::Continue ||
          statement.kind == Kind::Goto || statement.kind == Kind::Return)
        return;
      if (statement.depth != loop.depth + 1)
        continue;
      for (const auto& part : program_.items_of(statement)) {
        if (!part.has_nodes())
          continue;
        for (auto node = program_.nodes[part.value].first + 1; node <= part.value; ++node) {
          if (program_.nodes[node].kind != NodeKind::Element || names_.of_node[node] == none ||
              program_.nodes[node - 1].kind != NodeKind::Name ||
              names_.of_node[node - 1] != counter)
            continue;
          const auto& array = names_.symbols[names_.of_node[node]];
          const bool never = last->value < 1 || first->value > array.value; // an error elsewhere
          if (never || (first->value >= 1 && last->value <= array.value))
            continue;
          const auto name = program_.name(names_.symbols[counter].name);
          report(compiler::rules::LoopLeavesRange, program_.nodes[node - 1].span,
                 texts::CountsOut(name, first->value, last->value, program_.name(array.name), 1,
                                  array.value),
                 texts::WriteOnLine(fmt::format("for {} = 1 to {}", name, array.value),
                                    line_of(loop.span)));
          return;
        }
      }
    }
  }

  /// Reports a loop that ends with an unconditional `exit`.
  void check_single_round(std::uint32_t i) {
    auto last = none;
    for (auto n = i + 1; n < at(i).next; ++n) {
      if (at(n).kind == Kind::Continue || at(n).kind == Kind::Label)
        return;
      if (at(n).depth == at(i).depth + 1)
        last = n;
    }
    if (last == none || at(last).kind != Kind::Exit || size(at(last)) > 0 || last == i + 1)
      return;
    report(compiler::rules::LoopRunsOnce, at(last).span, texts::AlwaysEnds(),
           texts::MakeConditional("if speed = 0 then exit"));
  }

  /// The line number within its file.
  std::ptrdiff_t line_of(Span span) const {
    const auto begin = program_.file_at(span.begin).begin;
    const auto above = std::string_view(program_.text).substr(begin, span.begin - begin);
    return 1 + std::count(above.begin(), above.end(), line_end_of(program_.text).back());
  }
};

} // namespace

void check_loops(Program& program, const Names& names) {
  LoopsPass(program, names).run();
}

} // namespace orb::structured
