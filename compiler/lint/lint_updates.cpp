#include "compiler/lint/line_pass.h"
#include "compiler/text/rules.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

/// Finds changes of variables that have no effect, or not the one that the next test waits for.
class UpdatesPass : private LinePass {
public:
  UpdatesPass(const Program& program, const Flow& flow, const Settings& settings,
              Findings& findings)
      : LinePass(program, flow, findings), settings_(settings) {}

  void run() {
    for (const auto& place : flow_.all(Statement::If))
      check_toggle(place.code);
    for (const auto& place : flow_.all(Statement::For))
      if (flow_.is_line(place))
        check_end(place.code);
    for (const auto& place : flow_.all(Statement::Let))
      if (flow_.is_line(place))
        check_restart(place.code);
    for (const auto& jump : flow_.jumps)
      if (!jump.call && jump.to <= jump.from && jump.from - jump.to < longest_loop)
        check_steps(jump);
  }

private:
  /// The number that a statement assigns to a letter.
  std::optional<std::int32_t> number_set(const StatementNode& statement,
                                         std::uint32_t letter) const {
    if (statement.error || statement.kind != Statement::Let)
      return std::nullopt;
    const auto let = program_.as<LetView>(statement);
    return let.variable.kind == ItemKind::Letter && let.variable.value == letter
               ? constant_in(program_, let.expression)
               : std::nullopt;
  }

  std::string_view name_of(const Item& item) const { return program_.text_of(item.span); }

  // ---- two tests where the second undoes the first

  /// `if L = 0 then L = 1`, in one line of code or around a jump.
  struct Change {
    const StatementNode* test = nullptr;
    const StatementNode* let = nullptr;
    std::uint32_t letter = none;
    std::int32_t from = 0;
    std::int32_t to = 0;
    std::uint32_t next = none; ///< the line of code below
  };
  std::optional<Change> change_at(std::uint32_t code) const {
    if (code >= size_ || statement_of(code).error || statement_of(code).kind != Statement::If ||
        statement_of(code).else_branch != none)
      return std::nullopt;
    const auto& test = statement_of(code);
    const auto condition = program_.as<IfView>(test);
    const auto letter = letter_in(program_, condition.first.left);
    const auto from = number_in(program_, condition.first.right);
    const auto jumps = flow_.jumps_of(flow_.code[code]);
    const bool around = jumps.size() == 1 && jumps.front().to == code + 2;
    if (!letter || !from || condition.second || (!jumps.empty() && !around) ||
        orders_of(condition.first) != (around ? Orders::NotEqual : Orders::Equal))
      return std::nullopt;
    const auto& let = around ? statement_of(code + 1) : program_.statements[test.then_branch];
    const auto to = number_set(let, *letter);
    return to ? std::optional(Change{&test, &let, *letter, *from, *to, code + (around ? 2 : 1)})
              : std::nullopt;
  }

  void check_toggle(std::uint32_t code) {
    const auto first = change_at(code);
    const auto second = first ? change_at(first->next) : std::nullopt;
    if (!second || second->letter != first->letter || second->from != first->to ||
        second->to != first->from)
      return;
    const auto condition = program_.as<IfView>(*second->test).first;
    auto& d = findings_.add(
        rules::LostUpdate, span_of(condition),
        texts::UndoesTheLineAbove(name_of(condition.left), first->to),
        texts::WriteInsteadOfBoth(fmt::format(
            "{} else {}", program_.text_of({first->test->span.begin, first->let->span.end}),
            program_.text_of(second->let->span))));
    add_note(d, first->let->span, texts::SetHere());
  }

  // ---- loops

  /// The line of the `next` below a `for`; 0 if none is near.
  std::uint32_t next_below(std::uint32_t code, std::uint32_t letter) const {
    for (auto i = code + 1; i < size_ && i - code < longest_loop; ++i) {
      const auto& statement = statement_of(i);
      if (!statement.error && statement.kind == Statement::Next &&
          program_.as<NextView>(statement).variable.value == letter)
        return i;
    }
    return 0;
  }

  /// A loop that changes the variable of its end, which `for` has computed already.
  void check_end(std::uint32_t code) {
    const auto loop = program_.as<ForView>(statement_of(code));
    const auto last = next_below(code, loop.variable.value);
    if (is_repeated(code, last))
      return; // the next time, the end is another
    for (const auto& node : nodes_of(program_, loop.end)) {
      if (node.kind != NodeKind::Letter || node.what == loop.variable.value)
        continue;
      for (auto i = code + 1; i < last; ++i)
        for (const auto& statement : whole(i))
          if (const auto step = step_in(statement);
              step.letter == node.what && step.by != 0 && !is_read(node.what, code + 1, i)) {
            auto& d = findings_.add(rules::LostUpdate, statement.span,
                                    texts::EndIsComputed(name_of(program_.items_of(statement)[0])),
                                    texts::TestItInTheLoop());
            add_note(d, statement_of(code).span, texts::TheLoop());
            return;
          }
    }
  }

  /// True if a loop is in another one, or behind the start of a subroutine.
  bool is_repeated(std::uint32_t begin, std::uint32_t end) const {
    const auto loops = flow_.all(Statement::For);
    return std::any_of(flow_.jumps.begin(), flow_.jumps.end(),
                       [&](const Flow::Jump& jump) {
                         return jump.to <= begin && (jump.call || jump.from > end);
                       }) ||
           std::any_of(loops.begin(), loops.end(), [&](const auto& place) {
             const auto loop = program_.as<ForView>(program_.statements[place.statement]);
             return place.code < begin && next_below(place.code, loop.variable.value) > end;
           });
  }

  /// True if a line from `begin` on, other than `but`, reads a letter.
  bool is_read(std::uint32_t letter, std::uint32_t begin, std::uint32_t but) const {
    for (auto i = begin; i < size_; ++i)
      for (const auto& statement : whole(i))
        if (i != but && reads(statement, letter))
          return true;
    return false;
  }

  /// A sum that grows in a loop, although a subroutine that the loop calls begins it anew.
  void check_restart(std::uint32_t code) {
    const auto step = step_in(statement_of(code));
    if (step.letter == none)
      return;
    for (const auto& call : flow_.jumps) {
      const auto restart = call.call && call.to != none &&
                                   statement_of(call.from).kind == Statement::Gosub &&
                                   in_one_loop(code, call.from)
                               ? restart_in(call.to, step.letter)
                               : none;
      if (restart == none || (call.to <= code && code <= restart))
        continue;
      const auto& let = statement_of(restart);
      auto& d = findings_.add(
          rules::LostUpdate, statement_of(code).span,
          texts::SubBeginsAnew(name_of(program_.items_of(let)[0]), *number_set(let, step.letter)),
          texts::UseAnotherVariable());
      add_note(d, let.span, texts::SetHere());
      return;
    }
  }

  /// True if a `for` runs both lines in each of its rounds.
  bool in_one_loop(std::uint32_t one, std::uint32_t other) const {
    const auto loops = flow_.all(Statement::For);
    return std::any_of(loops.begin(), loops.end(), [&](const auto& place) {
      const auto loop = program_.as<ForView>(program_.statements[place.statement]);
      const auto end = next_below(place.code, loop.variable.value);
      const bool around = place.code < std::min(one, other) && std::max(one, other) < end;
      return around && std::none_of(flow_.jumps.begin(), flow_.jumps.end(), [&](const auto& jump) {
               return !jump.call && place.code <= jump.from && jump.from <= end;
             });
    });
  }

  /// The line of a subroutine that sets a letter to a number before any other line uses it; none if
  /// there is no such line.
  std::uint32_t restart_in(std::uint32_t entry, std::uint32_t letter) const {
    for (auto i = entry; i < size_ && i - entry < longest_loop && is_plain(i); ++i) {
      const auto& statement = statement_of(i);
      if (number_set(statement, letter))
        return i;
      if (reads(statement, letter))
        return none;
      for (const auto& item : program_.items_of(statement))
        if (item.kind == ItemKind::Letter && item.value == letter)
          return none;
    }
    return none;
  }

  /// A loop until a letter equals a number that its steps never meet.
  void check_steps(const Flow::Jump& jump) {
    const auto& statement = statement_of(jump.from);
    if (statement.error || statement.kind != Statement::If || statement.else_branch != none)
      return;
    const auto condition = program_.as<IfView>(statement);
    const auto letter = letter_in(program_, condition.first.left);
    const auto end = number_in(program_, condition.first.right);
    if (!letter || !end || condition.second || orders_of(condition.first) != Orders::NotEqual ||
        settings_[*letter].size() != 2)
      return;
    std::optional<std::int32_t> begin;
    Shifted step;
    for (const auto& setting : settings_[*letter]) {
      const auto& set = statement_of(setting.code);
      if (const auto number = number_set(set, *letter); number && setting.code < jump.to)
        begin = number;
      else if (jump.to <= setting.code && setting.code < jump.from && is_single(setting.code))
        step = step_in(set);
    }
    const auto way = std::int64_t{*end} - begin.value_or(*end);
    if (step.by == 0 || way == 0 || way / step.by < 1 || way % step.by == 0 ||
        std::any_of(flow_.jumps.begin(), flow_.jumps.end(), [&](const Flow::Jump& other) {
          return other.from != jump.from && jump.to <= other.from && other.from <= jump.from;
        }))
      return;
    const auto name = name_of(condition.first.left);
    const bool until =
        program_.text_of({condition.first.left.span.end, condition.first.right.span.begin})
            .find('=') != std::string_view::npos;
    const auto* const test = until ? (step.by > 0 ? ">=" : "<=") : step.by > 0 ? "<" : ">";
    findings_.add(rules::EndlessLoop, span_of(condition.first),
                  texts::StepsOver(name, *end, *begin + way / step.by * step.by,
                                   *begin + (way / step.by + 1) * step.by),
                  texts::TestWith(fmt::format("{} {} {}", name, test, *end)));
  }

  const Settings& settings_;
};

} // namespace

void lint_updates(const Program& program, const Flow& flow, const Settings& settings,
                  Findings& findings) {
  UpdatesPass(program, flow, settings, findings).run();
}

} // namespace orb::compiler
