#include "base/duration.h"
#include "repair/arrange.h"
#include "structured/meaning/check_pass.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>

namespace orb::structured {
namespace {

/// Checks where statements stand and the values that they take. Large because each statement has
/// its own member.
class StatementsPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    for (const auto i : program_.order) {
      const auto& statement = at(i);
      check_place(i, statement);
      check_statement(statement);
      follow(i, statement);
    }
  }

private:
  struct CaseRange {
    std::int32_t lo;
    std::int32_t hi;
    std::uint32_t select;
  };

  /// Tracks the open blocks; the end of a block has its opener's depth.
  void follow(std::uint32_t i, const Statement& statement) {
    if (opens_block(statement.role()))
      open_.push_back(i);
    else if (closes_block(statement.role()) && statement.opener != none)
      while (!open_.empty() && open_.back() >= statement.opener) // including unclosed ones
        open_.pop_back();
  }

  bool in_loop() const {
    return std::any_of(open_.begin(), open_.end(),
                       [&](std::uint32_t opener) { return is_loop(at(opener).role()); });
  }

  bool in_select() const {
    return std::any_of(open_.begin(), open_.end(),
                       [&](std::uint32_t opener) { return at(opener).role() == Kind::Select; });
  }

  /// True if the first line of the enclosing sub does not parse.
  bool in_broken_routine() const {
    return std::any_of(open_.begin(), open_.end(), [&](std::uint32_t opener) {
      return at(opener).meant == Kind::Sub || at(opener).meant == Kind::Function;
    });
  }

  void misplaced(const Statement& statement, Message message, Message help = {}) {
    report(rules::MisplacedStatement, statement.word.size() > 0 ? statement.word : statement.span,
           std::move(message), std::move(help));
  }

  /// Reports a statement outside the block that it leaves. Foreign words are not reported again.
  void stands_outside(const Statement& statement, const Row<Hole::Code>& outside,
                      Message help = {}) {
    auto words = statement.word;
    std::erase_if(program_.diagnostics, [&](const Diagnostic& one) {
      const bool same = one.rule == &rules::ForeignWord && one.span.begin == words.begin;
      words = same ? one.span : words;
      return same;
    });
    report(rules::MisplacedStatement, words, outside(program_.text_of(words)), std::move(help));
  }

  /// The first part of the innermost block if it comes after statement `i`.
  std::uint32_t none_yet(std::uint32_t i) const {
    const auto next = at(open_.back()).next;
    return next != none && next > i ? next : none - 1;
  }

  void check_statement(const Statement& statement) {
    if (statement.kind == Kind::Robot)
      check_robot(statement);
    else if (statement.kind == Kind::For)
      check_for(statement);
    else if (statement.kind == Kind::Next)
      check_next(statement);
    else if (statement.kind == Kind::Case)
      check_case(statement);
    else if (statement.kind == Kind::Assign)
      check_assign(statement);
    else if (statement.kind == Kind::Select && !in_select())
      cases_.clear();
  }

  void check_place(std::uint32_t i, const Statement& statement) {
    const auto routine = names_.routine_of[i];
    const auto word = program_.text_of(statement.word);
    const bool sets = statement.kind == Kind::Local && i + 1 < program_.statements.size() &&
                      at(i + 1).kind == Kind::Assign && at(i + 1).span.begin < statement.span.end;
    if (declares(statement.kind) && statement.depth > 0)
      misplaced(statement, texts::InsideBlock(word), texts::AtTopLevel());
    if ((statement.kind == Kind::Exit || statement.kind == Kind::Continue) && !in_loop())
      stands_outside(statement, texts::OutsideLoop);
    if (statement.kind == Kind::Local && (routine == 0 || statement.depth != 1) &&
        !in_broken_routine())
      misplaced(statement,
                routine == 0 ? texts::OutsideRoutine("local") : texts::InsideBlock("local"),
                routine != 0 ? texts::LocalFirst()
                : sets       ? texts::Write(program_.text_of(at(i + 1).span))
                             : texts::NoneInMain());
    if (statement.kind == Kind::Return)
      check_return(routine, statement);
    if (!open_.empty() && at(open_.back()).kind == Kind::Select &&
        at(open_.back()).next == none_yet(i) && !parts_block(statement.kind) &&
        !closes_block(statement.kind) && statement.kind != Kind::Broken)
      misplaced(statement, texts::BeforeFirstCase());
  }

  void check_return(std::uint32_t routine, const Statement& statement) {
    if (routine == 0) {
      if (!in_broken_routine())
        stands_outside(statement, texts::OutsideRoutine, texts::EndEnds());
      return;
    }
    const auto& symbol = names_.symbols[names_.routines[routine].symbol];
    const bool function = symbol.kind == SymbolKind::Function;
    if (function && size(statement) == 0)
      report(rules::ArgumentCount, statement.span, texts::FunctionMustReturn(),
             texts::ReturnTakesValue());
    else if (!function && size(statement) > 0)
      turn(program_, names_, routine, SymbolKind::Function,
           report(rules::ArgumentCount, item(statement, 0).span, texts::SubReturnsNone()));
  }

  void check_assign(const Statement& statement) {
    const auto& target = program_.nodes[item(statement, 0).value];
    if (target.kind != NodeKind::System || statement.operation != Statement::none_operation)
      return;
    const auto& row = spec::variables[target.what];
    if (row.variable != spec::Variable::Ctrl)
      check_range(item(statement, 1), row.word, {"", row.least, row.greatest, row.unit});
  }

  void check_robot(const Statement& statement) {
    const auto& row = spec::info(statement.robot);
    if (statement.robot == spec::Statement::Data) {
      check_data(statement);
      return;
    }
    if (statement.robot == spec::Statement::Sleep) {
      check_sleep(statement);
      return;
    }
    if (statement.robot == spec::Statement::Rgb && size(statement) < 3) {
      check_colour(statement);
      return;
    }
    if (statement.robot == spec::Statement::Input && size(statement) == 3) {
      check_range(item(statement, 1), row.word, row.parameters()[0]);
      return;
    }
    for (std::uint32_t n = 0; n < size(statement) && n < row.parameters().size(); ++n)
      if (auto* const d = check_range(item(statement, n), row.word, row.parameters()[n]);
          d != nullptr && n == 1 && statement.robot == spec::Statement::Goroll)
        help_backwards(statement, *d);
    if (statement.robot == spec::Statement::Goroll && size(statement) > 1)
      check_swapped(statement);
  }

  /// `goroll 100, direction, 1`: the names show which value is which.
  void check_swapped(const Statement& statement) {
    const auto& heading = item(statement, 0);
    const auto& speed = item(statement, 1);
    const auto is = [&](std::string_view what, const Item& one) {
      return program_.nodes[one.value].kind == NodeKind::Name &&
             repair::is_called(what, program_.text_of(one.span));
    };
    const bool is_heading = is("heading", speed) && !is("speed", speed) && !is("heading", heading);
    const bool is_speed = is("speed", heading) && !is("heading", heading) && !is("speed", speed) &&
                          heading.span.size() > 1;
    if (!is_heading && !is_speed)
      return;
    const Span rest{speed.span.end, item(statement, size(statement) - 1).span.end};
    const auto& named = is_heading ? speed : heading;
    const auto name = program_.text_of(named.span);
    const auto values =
        fmt::format("{}, {}", program_.text_of(speed.span), program_.text_of(heading.span));
    auto& d = report(rules::SwappedValues, named.span,
                     is_heading ? texts::SpeedHere(name) : texts::HeadingHere(name),
                     texts::Write(fmt::format("goroll {}{}", values, program_.text_of(rest))));
    d.fix = single_fix(d.help, {heading.span.begin, speed.span.end}, values, Safety::Unsafe);
  }

  void help_backwards(const Statement& statement, Diagnostic& d) {
    const auto heading = value_of(item(statement, 0));
    const auto speed = std::int64_t{value_of(item(statement, 1))->value};
    const Span rest{d.span.end, item(statement, size(statement) - 1).span.end};
    if (const auto back = heading ? compiler::heading_back(heading->value, speed) : std::nullopt)
      d.help = compiler::texts::WriteToDriveBack(
          fmt::format("goroll {}, {}{}", *back, -speed, program_.text_of(rest)));
  }

  void check_colour(const Statement& statement) {
    const auto& part = item(statement, 0);
    if (part.kind == ItemKind::Colour)
      return;
    const auto& node = program_.nodes[part.value];
    const bool named =
        size(statement) == 1 && node.kind == NodeKind::Name && names_.of_node[part.value] == none;
    if (named)
      return; // a colour, or reported as unknown
    report(rules::ArgumentCount, statement.span, texts::RgbTakes("RGB", size(statement)));
  }

  void check_data(const Statement& statement) {
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues));
    for (const auto& part : program_.items_of(statement))
      require_constant(part);
    if (size(statement) > most)
      report(compiler::rules::TooManyDataValues, item(statement, most).span,
             compiler::texts::LineHasValues(size(statement), most));
  }

  void check_sleep(const Statement& statement) {
    const auto parameters = spec::info(statement.robot).parameters();
    const auto& time = item(statement, 0);
    bool written = false;
    for (auto n = program_.nodes[time.value].first; n <= time.value; ++n) {
      const auto& node = program_.nodes[n];
      if (node.kind == NodeKind::Duration) {
        written = true;
        if (node.value % 1000 != 0)
          report(rules::BadNumber, node.span, texts::NoWholeSeconds(program_.text_of(node.span)),
                 texts::SleepInSeconds());
      } else if (node.kind == NodeKind::Name && names_.of_node[n] != none &&
                 names_.symbols[names_.of_node[n]].duration && !is_quotient(time.value)) {
        written = true;
        report(rules::SecondsExpected, node.span,
               texts::InMilliseconds(program_.text_of(node.span)), texts::DivideBy1000());
      }
    }
    if (!written)
      check_range(time, "sleep", parameters[0]);
    if (size(statement) > 1)
      check_range(item(statement, 1), "sleep", parameters[1]);
    if (size(statement) > 2 && item(statement, 2).kind != ItemKind::Restart)
      report(rules::MalformedLine, item(statement, 2).span,
             texts::ThirdOfSleep("sleep", "restart"));
  }

  void check_for(const Statement& statement) {
    const auto variable = variable_of(statement);
    const auto around = std::find_if(open_.rbegin(), open_.rend(), [&](std::uint32_t opener) {
      return variable != none && at(opener).kind == Kind::For &&
             variable_of(at(opener)) == variable;
    });
    if (around != open_.rend()) {
      const auto name = program_.text_of(item(statement, 0).span);
      auto& d = report(rules::LoopVariable, item(statement, 0).span, texts::AlreadyCounts(name));
      d.notes.push_back({at(*around).span, texts::ThisCounts(name)});
    }
    if (program_.nodes[item(statement, 0).value].kind == NodeKind::System)
      report(rules::WrongUse, item(statement, 0).span, texts::LoopNeedsVariable());
    if (size(statement) >= 4 && !require_constant(item(statement, 3)))
      return;
    if (size(statement) >= 4 && value_of(item(statement, 3))->value == 0)
      report(compiler::rules::ZeroStep,
             compiler::step_clause(program_.text, item(statement, 2).span, item(statement, 3).span),
             compiler::step_of_zero());
    else if (size(statement) >= 3)
      check_direction(statement);
  }

  /// Reports a loop that never runs because its bounds are reversed.
  void check_direction(const Statement& statement) {
    const auto number = [&](std::uint32_t n) { // the value of a name may change
      const auto& part = item(statement, n);
      const auto kind = program_.nodes[part.value].kind;
      return kind == NodeKind::Number || kind == NodeKind::Negate ? value_of(part) : std::nullopt;
    };
    const auto from = number(1);
    const auto to = number(2);
    const auto step = size(statement) >= 4 ? value_of(item(statement, 3))->value : 1;
    if (!from || !to || (step > 0 ? from->value <= to->value : from->value >= to->value))
      return;
    const Span counted{statement.word.begin, item(statement, 2).span.end};
    const auto turned = step == -1 ? std::string(program_.text_of(counted))
                                   : fmt::format("{} step {}", program_.text_of(counted), -step);
    auto& d = report(rules::LoopNeverRuns, counted, texts::CountsAway(from->value, to->value),
                     texts::Write(turned));
    d.fix =
        single_fix(d.help, {counted.begin, item(statement, size(statement) >= 4 ? 3 : 2).span.end},
                   turned, Safety::Unsafe);
  }

  void check_next(const Statement& statement) {
    if (size(statement) == 0 || statement.opener == none)
      return;
    const auto& loop = at(statement.opener);
    if (loop.kind != Kind::For)
      return;
    const auto& named = program_.nodes[item(statement, 0).value];
    const auto& counter = program_.nodes[item(loop, 0).value];
    if (counter.kind != NodeKind::Name ||
        (named.kind == NodeKind::Name && counter.value == named.value))
      return;
    if (crossed_ == std::pair{named.value, counter.value})
      return; // already reported at the other `next`
    crossed_ = {counter.value, named.value};
    const auto name = std::string(program_.text_of(counter.span));
    report(rules::LoopVariable, item(statement, 0).span,
           compiler::texts::InnermostLoopVariable(name), texts::WriteAlone("next " + name, "next"));
  }

  void check_case(const Statement& statement) {
    for (std::uint32_t n = 0; n < size(statement); ++n) {
      const auto& first = item(statement, n);
      const bool range = n + 2 < size(statement) && item(statement, n + 1).kind == ItemKind::To;
      const auto& last = range ? item(statement, n + 2) : first;
      n += range ? 2 : 0;
      if (!require_constant(first) || (range && !require_constant(last)))
        continue;
      add_case({value_of(first)->value, value_of(last)->value, statement.opener},
               {first.span.begin, last.span.end});
    }
  }

  void add_case(CaseRange range, Span span) {
    if (range.lo > range.hi) {
      report(rules::CaseValue, span, compiler::texts::IsAbove(range.lo, range.hi),
             texts::SmallerFirst());
      return;
    }
    for (const auto& other : cases_)
      if (other.select == range.select && other.lo <= range.hi && range.lo <= other.hi) {
        report(rules::CaseValue, span, texts::DuplicateCase(std::max(other.lo, range.lo)));
        return;
      }
    constexpr std::size_t most =
        1024; // no robot holds more; the search for duplicates is quadratic
    if (cases_.size() < most)
      cases_.push_back(range);
  }

  /// Returns the finding, if any; valid until the next one.
  Diagnostic* check_range(const Item& part, std::string_view word,
                          const spec::Parameter& parameter) {
    const auto value = part.kind == ItemKind::Expression ? value_of(part) : std::nullopt;
    if (!value || (value->value >= parameter.least && value->value <= parameter.greatest))
      return nullptr;
    auto& d =
        report(compiler::rules::ValueOutOfRange, part.span,
               compiler::texts::FoundValue(compiler::allowed_values(word, parameter),
                                           compiler::shown(compiler::Range::only(value->value))));
    const auto text = program_.text_of(part.span);
    const bool negative = // a number, not a sum
        text.starts_with('-') && text.find_first_of(" \t+-*/%(", 1) == std::string_view::npos;
    std::string meant;
    if (const auto nearest = compiler::nearest_allowed(parameter, value->value);
        nearest && (negative || program_.nodes[part.value].kind == NodeKind::Number))
      meant = std::to_string(*nearest);
    else if (negative && parameter.name != "speed" &&
             -std::int64_t{value->value} <= parameter.greatest)
      meant = text.substr(1);
    // A value slightly above the limit becomes several waits; one large enough for milliseconds
    // already has them.
    constexpr std::int32_t second = 1000;
    constexpr std::int64_t most_lines = 3;
    const auto kind = program_.nodes[part.value].kind;
    const auto parts = value->value / parameter.greatest + 1;
    const bool waits = word == spec::info(spec::Statement::Delay).word && parts > 1 &&
                       (kind == NodeKind::Number || kind == NodeKind::Duration);
    if (waits && parts <= most_lines) {
      const auto each = value->value / static_cast<std::int32_t>(parts);
      d.help = texts::WriteOnLines(
          fmt::format("{} {}", word,
                      kind == NodeKind::Number ? std::to_string(each) : time_text(each)),
          parts);
      return &d;
    }
    if (meant.empty() && text.ends_with('s') && value->value / second <= parameter.greatest &&
        text == fmt::format("{}s", value->value / second))
      meant = fmt::format("{}ms", value->value / second);
    if (!meant.empty())
      d.fix = single_fix(texts::Write(meant), part.span, meant, Safety::Unsafe);
    return &d;
  }

  bool require_constant(const Item& part) {
    if (value_of(part))
      return true;
    if (program_.nodes[part.value].is_condition() || names_unknown(part.value))
      return false; // already reported
    report(rules::NotConstant, part.span, texts::NotConstant(), texts::UseLiterals());
    return false;
  }

  bool is_quotient(std::uint32_t node) const {
    const auto divide = static_cast<std::uint8_t>(spec::Operator::Divide);
    return program_.nodes[node].kind == NodeKind::Binary && program_.nodes[node].what == divide;
  }

  std::vector<std::uint32_t> open_; ///< the open blocks
  std::vector<CaseRange> cases_;
  std::pair<std::int32_t, std::int32_t> crossed_{-1, -1}; ///< the names in a crossed pair
};

} // namespace

void check_statements(Program& program, const Names& names) {
  StatementsPass(program, names).run();
}

} // namespace orb::structured
