#include "base/text/text.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/lint/sums.h"
#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::check_lines() {
  bool falls = false;
  bool runs = true; // as far as tests of known values show
  forget_letters();
  std::vector<LetterSet> cleared_at(flow_.code.size(), ~LetterSet{0}); // on all jumps from above
  for (const auto& jump : flow_.jumps)
    if (jump.to != none && (jump.call || jump.to <= jump.from))
      cleared_at[jump.to] = 0;
  for (std::uint32_t i = 0; i < flow_.code.size(); ++i) {
    const auto& code = flow_.code[i];
    const bool entered = code.target || !falls;
    if (code.target)
      cleared_above_ = (falls ? cleared_ | cleared_above_ : ~LetterSet{0}) & cleared_at[i];
    else if (entered)
      cleared_above_ = 0;
    if (entered)
      begin_block();
    runs = runs || entered;
    if (followed_)
      take_up(i);
    else if (entered)
      forget_letters();
    line_ = code.line;
    code_ = i;
    cleared_on_line_ = 0;
    const auto& statement = program_.statements[code.statement];
    if (runs || statement.error)
      runs = go(statement, i);
    else
      for (const auto& one : program_.whole(statement))
        note_uses(one);
    falls = code.falls && !statement.error; // a line that does not parse may assign anything
    const auto jumps = flow_.jumps_of(code);
    if (!jumps.empty() || statement.error)
      counting_ = 0; // the loop may exit early
    for (const auto& jump : jumps)
      if (jump.call)
        falls = false; // the subroutine may change everything
      else if (jump.to != none)
        cleared_at[jump.to] &= cleared_ | cleared_above_;
    in_order_ = in_order_ && falls;
  }
}

void ValuesPass::take_up(std::uint32_t code) {
  if (!ways_.is_kept(code))
    return;
  block_ = code;
  if (!ways_.load(code, now_))
    forget_letters();
}

void ValuesPass::check_outside(const Item& value, std::string_view word,
                               const spec::Parameter& parameter) {
  note_risk(value.value);
  if (usual_ != nullptr)
    return check_usual(known_[value.value], value.span, parameter.least, parameter.greatest,
                       allowed_values(word, parameter));
  const auto& range = range_of(value);
  if (range.misses(parameter.least, parameter.greatest))
    add_out_of_range(value, word, parameter);
  else if (!check_loop_range(value, word, parameter) && known_[value.value].exact)
    check_may_leave(value, word, parameter);
}

void ValuesPass::check_usual(const Value& value, Span span, std::int64_t least,
                             std::int64_t greatest, Message allowed) {
  const bool below = value.range.lo < least && value.origin == Origin::Motion;
  if (value.exact && value.origin != Origin::Program && (below || value.range.hi > greatest))
    findings_.add(rules::MayLeaveRange, span,
                  texts::ButCanBeOne(std::move(allowed), program_.text_of(span),
                                     below ? value.range.lo : value.range.hi));
}

void ValuesPass::check_may_leave(const Item& value, std::string_view word,
                                 const spec::Parameter& parameter) {
  const auto& range = range_of(value);
  if (range.lo == Range{}.lo || range.hi == Range{}.hi)
    return; // the amount is unknown
  const auto kind = program_.nodes[value.value].kind;
  const bool single =
      kind == NodeKind::Letter || kind == NodeKind::System || kind == NodeKind::Group;
  const auto text = program_.text_of(value.span);
  const auto whole = single ? std::string(text) : fmt::format("({})", text);
  const auto turn = std::int64_t{parameter.greatest} + 1;
  Message help;
  if (range.lo == 1 && range.hi == turn)
    help = texts::WriteOneLess(whole);
  else if (range.lo >= 0)
    help = texts::WriteRemainder(whole, turn);
  else if (turn == full_turn && range.lo >= -full_turn)
    help = texts::WriteTurned(text, full_turn);
  else
    help = texts::SetFirstOutOfRange(parameter.least, parameter.greatest);
  add_may_leave(value, allowed_values(word, parameter), std::move(help));
}

void ValuesPass::add_may_leave(const Item& value, Message allowed, Message help) {
  const auto& range = range_of(value);
  findings_.add(
      rules::MayLeaveRange, value.span,
      texts::ButCanBe(std::move(allowed), program_.text_of(value.span), range.lo, range.hi),
      std::move(help));
}

void ValuesPass::add_out_of_range(const Item& value, std::string_view word,
                                  const spec::Parameter& parameter) {
  auto& d =
      findings_.add(rules::ValueOutOfRange, value.span,
                    texts::FoundValue(allowed_values(word, parameter), shown(range_of(value))));
  if (known_[value.value].narrowed)
    d.severity = Severity::Warning; // perhaps no value passes the test
  const auto nodes = nodes_of(program_, value);
  const bool written = std::all_of(nodes.begin(), nodes.end(), [](const Node& node) {
    return node.kind == NodeKind::Number || node.kind == NodeKind::Negate;
  });
  if (const auto meant = nearest_allowed(parameter, range_of(value).lo); written && meant)
    d.fix =
        single_fix(texts::WriteValue(*meant), value.span, std::to_string(*meant), Safety::Unsafe);
  constexpr std::int64_t most_lines = 9;
  const auto parts = range_of(value).lo / parameter.greatest + 1;
  if (!d.fix && written && word == spec::info(spec::Statement::Delay).word && parts > 1 &&
      parts <= most_lines)
    d.help = texts::WriteOnLines(fmt::format("{} {}", word, range_of(value).lo / parts), parts);
}

bool ValuesPass::is_counted(const Item& value) const {
  const auto& root = program_.nodes[value.value];
  std::uint32_t counters = 0;
  for (auto n = root.first; n <= value.value; ++n) {
    const auto& node = program_.nodes[n];
    if (node.kind == NodeKind::Letter && (counting_ & bit(node.what)) != 0)
      ++counters;
    else if (node.kind != NodeKind::Number && node.kind != NodeKind::Group &&
             (node.kind != NodeKind::Binary || !keeps_ends(node)))
      return false;
  }
  const bool wraps = range_of(value) == Range{};
  return counters == 1 && !conditional_ && !wraps;
}

bool ValuesPass::check_loop_range(const Item& value, std::string_view word,
                                  const spec::Parameter& parameter) {
  if (!is_counted(value))
    return false;
  const auto& root = program_.nodes[value.value];
  const auto text = program_.text_of(value.span);
  const auto& range = range_of(value);
  auto& d =
      findings_.add(rules::LoopLeavesRange, value.span,
                    texts::ButRanges(allowed_values(word, parameter), text, range.lo, range.hi));
  const bool heading = parameter.greatest + 1 == full_turn && range.lo >= 0;
  const bool single = root.kind == NodeKind::Letter;
  if (heading) {
    d.help =
        texts::WriteRemainder(single ? std::string(text) : fmt::format("({})", text), full_turn);
    d.fix = Fix{
        d.help,
        {{{value.span.begin, value.span.begin}, single ? "" : "("},
         {{value.span.end, value.span.end}, fmt::format("{} % {}", single ? "" : ")", full_turn)}},
        Safety::Unsafe};
  } else if (single && range.hi > parameter.greatest) {
    d.help = texts::EndLoopAt(parameter.greatest);
  }
  return true;
}

bool ValuesPass::keeps_ends(const Node& node) {
  const auto op = static_cast<spec::Operator>(node.what);
  return op == spec::Operator::Add || op == spec::Operator::Subtract ||
         op == spec::Operator::Multiply;
}

void ValuesPass::check_arguments(const StatementNode& statement) {
  const auto& row = spec::info(statement.kind);
  const auto arguments = program_.items_of(statement);
  const bool mended = statement.kind == spec::Statement::Goroll &&
                      (check_swapped(arguments) || check_backward(statement));
  for (std::size_t i = mended ? 2 : 0; i < arguments.size(); ++i)
    check_range(arguments[i], row.word, row.parameter_slots[i]);
  if (statement.kind == spec::Statement::Goroll && arguments.size() < row.parameters().size() &&
      target_.version >= spec::info(spec::BasicGrowth::GoValue).since)
    add_missing_go(statement, arguments.back());
  if (statement.kind == spec::Statement::Basflg)
    check_flags(arguments.front());
  if (statement.kind == spec::Statement::Sleep)
    check_sleep(program_.as<SleepView>(statement).line);
  if (statement.kind == spec::Statement::Rstr)
    data_.left = conditional_ ? DataSet::unknown : data_.size;
}

/// The separator that the program writes between two values: `, ` or `,`.
std::string_view ValuesPass::comma_of(std::span<const Item> arguments) const {
  return program_.text_of({arguments[0].span.end, arguments[1].span.begin});
}

/// A speed that is valid only as a heading, with a heading that is valid as a speed.
bool ValuesPass::check_swapped(std::span<const Item> arguments) {
  const auto parameters = spec::info(spec::Statement::Goroll).parameters();
  const auto heading = range_of(arguments[0]);
  const auto speed = range_of(arguments[1]);
  const auto is_number = [&](const Item& value) { return nodes_of(program_, value).size() == 1; };
  if (!heading.constant() || !speed.constant() || !is_number(arguments[0]) ||
      !is_number(arguments[1]) || heading.lo <= 0 || heading.lo > parameters[1].greatest ||
      speed.lo <= parameters[1].greatest || speed.lo > parameters[0].greatest)
    return false;
  auto& d = findings_.add(
      rules::ValueOutOfRange, arguments[1].span,
      texts::FoundValue(allowed_values("goroll", parameters[1]), shown(speed)),
      texts::WriteBecause(
          fmt::format("goroll {}{}{}{}", program_.text_of(arguments[1].span), comma_of(arguments),
                      program_.text_of(arguments[0].span),
                      program_.text_of({arguments[1].span.end, arguments.back().span.end})),
          texts::HeadingComesFirst()));
  d.fix = Fix{texts::SwapThem(),
              {{arguments[0].span, std::string(program_.text_of(arguments[1].span))},
               {arguments[1].span, std::string(program_.text_of(arguments[0].span))}},
              Safety::Unsafe};
  return true;
}

/// A negative speed: the ball drives backward if the heading is reversed.
bool ValuesPass::check_backward(const StatementNode& statement) {
  const auto arguments = program_.items_of(statement);
  const auto parameters = spec::info(spec::Statement::Goroll).parameters();
  const auto heading = range_of(arguments[0]);
  const auto speed = range_of(arguments[1]);
  const auto back =
      heading.constant() && speed.constant() ? heading_back(heading.lo, speed.lo) : std::nullopt;
  if (!back)
    return false;
  const auto line =
      fmt::format("goroll {}{}{}{}", *back, comma_of(arguments), -speed.lo,
                  program_.text_of({arguments[1].span.end, arguments.back().span.end}));
  auto& d = findings_.add(rules::ValueOutOfRange, arguments[1].span,
                          texts::FoundValue(allowed_values("goroll", parameters[1]), shown(speed)),
                          texts::WriteToDriveBack(line));
  d.fix =
      single_fix(d.help, {statement.word.begin, arguments.back().span.end}, line, Safety::Unsafe);
  return true;
}

void ValuesPass::add_missing_go(const StatementNode& statement, const Item& last) {
  auto& d = findings_.add(rules::MissingGo, statement.span, texts::ThirdIsGo());
  const bool brakes = range_of(last) == Range::only(0);
  d.fix = single_fix(texts::AddGoValue(), last.span,
                     fmt::format("{}{}{}", program_.text_of(last.span),
                                 comma_of(program_.items_of(statement)), brakes ? 0 : 1),
                     Safety::Unsafe); // it is unknown which of the three is missing
}

void ValuesPass::check_flags(const Item& value) {
  const auto range = range_of(value);
  for (const auto& row : spec::basic_flags)
    if (range.constant() && (range.lo & static_cast<std::int32_t>(row.flag)) != 0 &&
        row.since > target_.version)
      findings_.add(rules::NewerThanTarget, value.span,
                    texts::FlagNeedsVersion(static_cast<int>(row.flag), row.symbol,
                                            spec::info(row.since).text,
                                            spec::info(target_.version).text));
  const auto all = spec::value_of(spec::Limit::GreatestBasicFlags);
  if (range.lo > all &&
      !range.misses(0, spec::info(spec::Statement::Basflg).parameters()[0].greatest))
    findings_.add(rules::UnknownFlags, value.span,
                  texts::FoundValue(texts::TheFlagsAre(), shown(range)));
}

void ValuesPass::check_sleep(const Item& value) {
  const auto range = range_of(value);
  if (!range.constant() || range.lo < 1 ||
      range.misses(1, spec::value_of(spec::Limit::GreatestLineNumber)))
    return;
  const auto* number = flow_.find(static_cast<std::uint32_t>(range.lo));
  if (number != nullptr && number->code != none) {
    if (target_.area == Area::Ram)
      findings_.add(rules::WakesElsewhere, value.span, texts::WakesInFlash(range.lo),
                    texts::GiveAreaFlash());
    return;
  }
  auto& d = findings_.add(number == nullptr ? rules::MissingTarget : rules::EmptyTarget, value.span,
                          texts::NoLineToWakeUp(range.lo));
  if (target_.area == Area::Ram) {
    d.severity = Severity::Info;
    d.help = texts::LookedUpInFlash();
  }
}

void ValuesPass::check_let(const LetView& let) {
  const auto& [variable, value] = let;
  if (variable.kind == ItemKind::Indexed) {
    check_index(variable.span);
  } else if (variable.kind != ItemKind::Letter &&
             static_cast<spec::Variable>(variable.value) != spec::Variable::Ctrl) {
    const auto& row = spec::variables[variable.value];
    check_range(value, row.word, {"", row.least, row.greatest, row.unit});
  }
}

void ValuesPass::check_for(const ForView& loop) {
  const auto& variable = loop.variable;
  const auto start = range_of(loop.start);
  const auto end = range_of(loop.end);
  const auto step = loop.step != nullptr ? range_of(*loop.step) : Range::only(1);
  if (step == Range::only(0))
    findings_.add(rules::ZeroStep, step_clause(program_.text, loop.end.span, loop.step->span),
                  step_of_zero().message, step_of_zero().help);
  const bool away = (step.lo > 0 && start.lo > end.hi) || (step.hi < 0 && start.hi < end.lo);
  if (away) {
    auto& d = findings_.add(rules::LoopRunsOnce, {loop.start.span.begin, loop.last().span.end},
                            texts::CountsAway(shown(start), shown(end)));
    if (loop.step == nullptr) {
      const auto counts = program_.text_of({variable.span.begin, loop.last().span.end});
      d.help = texts::ToCountDown(fmt::format("for {} step -1", counts));
      const auto at = loop.last().span.end;
      d.fix = single_fix(texts::CountDown(), {at, at}, " step -1", Safety::Unsafe);
    }
  }
  if (variable.kind == ItemKind::Indexed) {
    findings_.add(rules::IndexedLoop, variable.span, texts::ZAsLoopVariable(),
                  texts::CountWithLetter());
    check_index(variable.span);
    return;
  }
  begin_block(); // the body is entered from here and from `next`
  if (letters_[variable.value].assigned)
    return;
  if (start.constant() && end.constant() && step.constant() && step.lo != 0 && !away &&
      !conditional_)
    counting_ |= bit(variable.value);
}

void ValuesPass::forget(std::span<const Item> variables) {
  for (const auto& variable : variables)
    if (variable.kind == ItemKind::Letter)
      set_letter(variable.value, {});
}

void ValuesPass::check_indexed(std::span<const Item> variables) {
  for (const auto& variable : variables)
    if (variable.kind == ItemKind::Indexed)
      check_index(variable.span);
}

void ValuesPass::check_index(Span span) {
  indexed_used_ = true;
  const auto& index = letters_[index_letter];
  const auto range = now_[index_letter].range;
  const auto most = spec::value_of(spec::Limit::IndexedVariables);
  at_risk_ = at_risk_ || range.lo < 1 || range.hi > most;
  if (range.misses(1, most)) {
    if (index.first_set == nullptr)
      findings_.add(rules::IndexRange, span, texts::IndexNeverSet(), texts::UseAnotherLetter());
    else
      findings_.add(rules::IndexRange, span,
                    texts::UsedWhileIndexIs('Z', 'Y', shown(range), 1, most));
  } else if (index_begins_ && (*index_begins_ < 1 || *index_begins_ > most)) {
    auto& d = findings_.add(
        rules::MayLeaveRange, span,
        texts::UsedWhileIndexIs('Z', 'Y', shown(Range::only(*index_begins_)), 1, most));
    if (*index_begins_ == 0) {
      d.help = texts::LetCountFromOne();
      count_from_one(span, d);
    }
    index_begins_.reset();
  } else if (now_[index_letter].exact && (range.lo < 1 || range.hi > most)) {
    findings_.add(rules::MayLeaveRange, span,
                  texts::UsedWhileIndexCanBe('Z', 'Y', shown(range), 1, most),
                  texts::KeepWithin('Y', 1, most));
    now_[index_letter].exact = false; // what follows only runs with the other values
  } else if (index.first_set != nullptr &&
             index.first_set->span.begin > program_.lines[line_].span.end && in_order_ &&
             !before_y_) {
    before_y_ = true;
    findings_.add(rules::IndexBeforeY, span, texts::UsedAboveY(), texts::SetYFirst());
  }
}

/// `for Y = 0 to 9` has as many rounds as `for Y = 1 to 10`.
void ValuesPass::count_from_one(Span use, Diagnostic& d) const {
  const StatementNode* loop = nullptr;
  for (const auto& statement : program_.statements)
    if (!statement.error && statement.kind == spec::Statement::For &&
        statement.span.begin < use.begin &&
        program_.as<ForView>(statement).variable.value == index_letter)
      loop = &statement;
  if (loop == nullptr)
    return;
  const auto view = program_.as<ForView>(*loop);
  const auto last = nodes_of(program_, view.end);
  if (view.step != nullptr || last.size() != 1 || last[0].kind != NodeKind::Number ||
      last[0].value >= spec::value_of(spec::Limit::IndexedVariables))
    return;
  d.fix = Fix{texts::CountFromOne(),
              {{view.start.span, "1"}, {view.end.span, std::to_string(last[0].value + 1)}},
              Safety::Unsafe};
  d.help = texts::Write(fmt::format("for Y = 1 to {}", last[0].value + 1));
}

void ValuesPass::check_on(const OnView& on) {
  const auto& [selector, targets] = on;
  const auto count = static_cast<std::int32_t>(targets.size());
  const auto range = range_of(selector);
  if (range.lo >= 1 && range.hi <= count)
    return;
  note_risk(selector.value);
  const auto list = counted(targets.size(), texts::ListHasOne, texts::ListHas);
  if (range.misses(1, count))
    findings_.add(rules::SelectorRange, selector.span, texts::FoundValue(list, shown(range)));
  else if (known_[selector.value].exact || is_counted(selector))
    add_may_leave(selector, list,
                  range.hi > count ? counted(static_cast<std::size_t>(range.hi - count),
                                             texts::WriteOneMoreNumber, texts::WriteMoreNumbers)
                                   : Message());
}

void ValuesPass::check_condition(const IfView& condition) {
  check_answer(condition.first);
  if (condition.second)
    check_answer(*condition.second);
}

/// What the source asks: of a structured program, a line may ask the opposite. Nothing for a
/// `case`.
std::optional<Orders> ValuesPass::written_orders(const Comparison& comparison) const {
  const auto sign = trim(program_.text_of({comparison.left.span.end, comparison.right.span.begin}));
  const auto orders = orders_of(comparison);
  const char direction = sign == "<>" ? '!' : sign.empty() ? '\0' : sign[0];
  for (const auto asked : {orders, opposite(orders)})
    if (direction == sign_of(asked, "!")[0])
      return asked;
  return std::nullopt;
}

/// A sensor, compared with a value that is known here but not written as a number.
void ValuesPass::check_known_bound(const Comparison& comparison) {
  const auto sensor = sensor_in(program_, comparison.left);
  const auto& bound = known_[comparison.right.value].range;
  const auto asked = written_orders(comparison);
  const auto written = program_.text_of(comparison.right.span).front();
  if (!sensor || !asked || !bound.constant() || is_digit(written) || written == '-')
    return;
  const auto& row = spec::info(*sensor);
  if (!bound.misses(row.least, row.greatest))
    return; // perhaps the first of several
  const Span all{comparison.left.span.begin, comparison.right.span.end};
  if (auto said = judge({*sensor, *asked, bound.lo, true, "!"}, program_.text_of(all), {}))
    findings_.add(*said->rule, all, std::move(said->message), std::move(said->help));
}

void ValuesPass::check_answer(const Comparison& comparison) {
  check_known_bound(comparison);
  const auto& known = known_[comparison.left.value];
  const Span all{comparison.left.span.begin, comparison.right.span.end};
  const auto number = number_in(program_, comparison.right);
  const auto asked = known.bounded ? written_orders(comparison) : std::nullopt;
  if (number && asked && !where(*asked, known.range, Range::only(*number))) {
    findings_.add(rules::ConstantComparison, all, texts::NeverTrueBelow(program_.text_of(all)),
                  texts::TestItFirst());
    return;
  }
  const auto letter = letter_in(program_, comparison.left);
  if (!letter || !number || orders_of(comparison) != Orders::Equal)
    return;
  if (!now_[*letter].dense)
    return;
  const auto& range = now_[*letter].range;
  if (range.constant() || range.has(*number))
    return;
  const auto name = spec::letter_name(*letter);
  findings_.add(rules::ConstantComparison, all,
                texts::AsItIsHere(texts::NeverTrue(fmt::format("{} = {}", name, *number)), name,
                                  range.lo, range.hi),
                texts::CompareWithFromTo(range.lo, range.hi));
}

} // namespace orb::compiler
