#include "structured/meaning/checker.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/idioms.h"

#include <map>

namespace orb::structured {

void Checker::check_jumps() {
  std::vector<std::uint32_t> labels;
  for (const auto i : program_.order)
    if (at(i).kind == Kind::Label)
      labels.push_back(i);
  constexpr std::size_t most = 4096;
  if (labels.size() > most)
    labels.resize(most);
  for (std::size_t n = 0; n < labels.size(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      if (at(labels[m]).name == at(labels[n]).name &&
          names_.routine_of[labels[m]] == names_.routine_of[labels[n]]) {
        report(rules::NameTaken, at(labels[n]).name_span,
               texts::DuplicateLabel(program_.text_of(at(labels[n]).name_span)));
        break;
      }
  for (const auto i : program_.order)
    if (at(i).kind == Kind::Goto)
      check_goto(i, labels);
  for (const auto label : labels)
    check_label(label);
}

/// `sonst:` and `forever:` parse as labels but are foreign keywords.
void Checker::check_label(std::uint32_t label) {
  const auto word = program_.text_of(at(label).name_span);
  const auto meant = repair::word_at(repair::tokens_of(word, repair::Language::Structured), 0);
  if (meant == "else" || meant == "forever")
    report(rules::ForeignWord, at(label).name_span, texts::NotOfThisLanguage(word));
}

void Checker::check_goto(std::uint32_t i, const std::vector<std::uint32_t>& labels) {
  const auto& jump = at(i);
  const auto label = std::find_if(labels.begin(), labels.end(), [&](std::uint32_t l) {
    return at(l).name == jump.name && names_.routine_of[l] == names_.routine_of[i];
  });
  if (label == labels.end()) {
    report_unknown_label(i, labels);
    return;
  }
  if (!encloses(*label, i))
    report(rules::GotoTarget, jump.name_span, texts::LabelInBlock(program_.text_of(jump.name_span)),
           texts::NotIntoBlocks());
  else
    report(rules::Unstructured, jump.span, texts::ProgramUses("goto"));
}

void Checker::report_unknown_label(std::uint32_t i, const std::vector<std::uint32_t>& labels) {
  const auto& jump = at(i);
  const auto word = std::string(program_.text_of(jump.name_span));
  auto& d = report(rules::GotoTarget, jump.name_span, texts::UnknownLabel(word));
  const auto sub =
      std::find_if(names_.symbols.begin(), names_.symbols.end(), [&](const Symbol& one) {
        return one.kind == SymbolKind::Sub && equal_words(program_.name(one.name), word);
      });
  if (sub != names_.symbols.end()) {
    const auto call =
        fmt::format("{}{}", word, names_.routines[sub->routine].parameters > 0 ? "(…)" : "");
    d.help = texts::ItIsASub(call);
    if (call == word)
      d.fix = Fix{texts::CallSub(), {{jump.span, word}}, Safety::Unsafe};
    return;
  }
  std::vector<std::string_view> here;
  for (const auto label : labels)
    if (names_.routine_of[label] == names_.routine_of[i])
      here.push_back(program_.text_of(at(label).name_span));
  const auto meant = closest(word, here);
  if (!meant)
    return;
  d.help = texts::DidYouMean(*meant);
  d.fix = Fix{texts::Write(*meant), {{jump.name_span, *meant}}, Safety::Unsafe};
}

bool Checker::encloses(std::uint32_t label, std::uint32_t other) const {
  std::uint32_t depth = at(label).depth;
  for (auto n = label; depth > 0;) {
    if (n == 0)
      return false;
    --n;
    if (!opens_block(at(n).kind) || at(n).depth != depth - 1)
      continue;
    --depth;
    auto end = n;
    std::uint32_t part = n;
    while (at(end).next != none) {
      end = at(end).next;
      if (end <= label)
        part = end;
    }
    const auto part_end = at(part).next;
    if (other < part || part_end == none || other > part_end)
      return false;
  }
  return true;
}

void Checker::check_recursion() {
  const auto calls = calls_of(program_, names_);
  std::vector<std::uint8_t> state(calls.size(), 0); // 1: open, 2: done
  for (std::uint32_t root = 1; root < calls.size(); ++root) {
    std::vector<std::pair<std::uint32_t, std::size_t>> path;
    if (state[root] == 0) {
      path.push_back({root, 0});
      state[root] = 1;
    }
    while (!path.empty()) {
      auto& [routine, next] = path.back();
      if (next == calls[routine].size()) {
        state[routine] = 2;
        path.pop_back();
        continue;
      }
      const auto callee = calls[routine][next++];
      if (state[callee] == 1) {
        report_cycle(path, callee);
        return;
      }
      if (state[callee] == 0) {
        state[callee] = 1;
        path.push_back({callee, 0});
      }
    }
  }
}

void Checker::report_cycle(const std::vector<std::pair<std::uint32_t, std::size_t>>& path,
                           std::uint32_t callee) {
  const auto first = std::find_if(path.begin(), path.end(),
                                  [&](const auto& open) { return open.first == callee; });
  auto circle = texts::Quoted(name_of(callee));
  for (auto open = first + 1; open != path.end(); ++open)
    circle = texts::Calls(std::move(circle), name_of(open->first));
  const auto& symbol = names_.symbols[names_.routines[callee].symbol];
  report(rules::Recursion, symbol.span, texts::Calls(std::move(circle), name_of(callee)),
         texts::UseLoop());
}

void Checker::check_loops() {
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

void Checker::check_called_loops() {
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

bool Checker::always_holds(std::uint32_t condition) const {
  const auto& node = program_.nodes[condition];
  const bool equality =
      node.kind == NodeKind::Relation && static_cast<Comparison>(node.what) == Comparison::Equal;
  const auto right = evaluate(program_, names_, equality ? condition - 1 : condition);
  if (!equality || !right)
    return right && right->value != 0;
  const auto left = evaluate(program_, names_, program_.before(condition - 1));
  return left && left->value == right->value;
}

void Checker::check_inverted(std::uint32_t i) {
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
  d.fix = Fix{d.help, {{root.span, std::move(turned)}}, Safety::Unsafe};
}

void Checker::check_endless(std::uint32_t i) {
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

void Checker::check_left(std::uint32_t i) {
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
  const auto seconds = sleeps && size(statement) == 1 ? value_of(item(statement, 0)) : std::nullopt;
  constexpr std::int32_t second = 1000; // ms; larger values were already meant as ms
  const auto longest = spec::info(spec::Statement::Delay).parameters()[0].greatest / second;
  auto& d = report(
      compiler::rules::UnreachableLine, after->span, texts::UnreachableAfter(word),
      seconds ? texts::ForPause(
                    fmt::format("delay {}{}", seconds->value, seconds->value > longest ? "" : "s"))
      : sleeps ? texts::ForPause(fmt::format("delay {}", program_.text_of(item(statement, 0).span)))
      : ends   ? texts::RemoveAbove(word)
               : texts::RemoveLine());
  d.notes.push_back({statement.span, sleeps ? texts::FallsAsleep()
                                     : ends ? texts::EndsHere()
                                            : texts::NeverPast()});
}

const Statement* Checker::never_reached(std::uint32_t i, std::uint32_t after) const {
  if (after >= program_.statements.size() || names_.routine_of[after] != names_.routine_of[i] ||
      at(after).depth != at(i).depth)
    return nullptr;
  const auto kind = at(after).kind;
  const bool runs = kind != Kind::Label && kind != Kind::Local && kind != Kind::Broken &&
                    !declares(kind) && !parts_block(kind) && !closes_block(kind) &&
                    (kind != Kind::Robot || at(after).robot != spec::Statement::Data);
  return runs ? &at(after) : nullptr;
}

void Checker::check_counter(std::uint32_t i) {
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
            program_.nodes[node - 1].kind != NodeKind::Name || names_.of_node[node - 1] != counter)
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

/// The line number within its file.
std::ptrdiff_t Checker::line_of(Span span) const {
  const auto begin = program_.file_at(span.begin).begin;
  const auto above = std::string_view(program_.text).substr(begin, span.begin - begin);
  return 1 + std::count(above.begin(), above.end(), line_end_of(program_.text).back());
}

} // namespace orb::structured
