#include "structured/meaning/check.h"

#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"
#include "structured/text/blocks.h"
#include "structured/text/rules.h"
#include "structured/text/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace orb::structured {
namespace {

class Checker {
public:
  Checker(Program& program, const Names& names, const compiler::Target& target)
      : program_(program), names_(names), target_(target) {}

  void run() {
    for (const auto& statement : program_.statements)
      note_timer(statement);
    for (const auto i : program_.order) {
      const auto& statement = program_.statements[i];
      check_expressions(statement);
      check_place(i, statement);
      check_statement(statement);
      follow(i, statement);
    }
    check_jumps();
    const auto& found = program_.diagnostics;
    if (std::none_of(found.begin(), found.end(),
                     [](const Diagnostic& one) { return one.rule == &rules::UnclosedBlock; }))
      check_recursion(); // a sub without an end holds the calls below it
    check_unused();
    if (!any_error(program_.diagnostics))
      check_loops();
  }

private:
  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {}) {
    return program_.diagnostics.emplace_back(
        finding(rule, span, std::move(message), std::move(help)));
  }
  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& statement, std::uint32_t n) const {
    return program_.items[statement.items_begin + n];
  }
  static std::uint32_t size(const Statement& statement) {
    return statement.items_end - statement.items_begin;
  }
  std::optional<Constant> value_of(const Item& part) const {
    return evaluate(program_, names_, part.value);
  }

  void note_timer(const Statement& statement) {
    if (statement.kind != Kind::Assign || size(statement) < 2)
      return;
    const auto& place = program_.nodes[item(statement, 0).value];
    const auto value = value_of(item(statement, 1));
    if (place.kind == NodeKind::System && (!value || value->value != 0))
      timers_.set_above_0(static_cast<spec::Variable>(place.what));
  }

  // ---- expressions

  void check_expressions(const Statement& statement) {
    for (const auto& part : program_.items_of(statement)) {
      if (part.kind != ItemKind::Expression && part.kind != ItemKind::Place &&
          part.kind != ItemKind::Character)
        continue;
      const auto root = part.value;
      for (auto n = program_.nodes[root].first; n <= root; ++n)
        check_node(n, n == root);
      const bool condition_fits = statement.kind == Kind::If || statement.kind == Kind::ElseIf ||
                                  statement.kind == Kind::While || statement.kind == Kind::Until;
      if (!program_.nodes[root].is_condition())
        continue;
      if (!condition_fits)
        report_condition(root);
      else
        check_sides(root);
    }
  }

  void report_condition(std::uint32_t node) {
    if (names_unknown(node))
      return;
    report(rules::ConditionAsValue, program_.nodes[node].span, "a condition is not a number",
           "write `if … then` and set the value there");
  }

  /// Whether a name in an expression is unknown, which has been reported.
  bool names_unknown(std::uint32_t root) const {
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      if (program_.nodes[n].kind == NodeKind::Name && names_.of_node[n] == none)
        return true;
    return false;
  }

  void check_node(std::uint32_t n, bool is_root) {
    const auto& node = program_.nodes[n];
    check_number(n, is_root);
    if (node.kind == NodeKind::System)
      check_version(node.span, spec::variables[node.what].word, spec::variables[node.what].since,
                    spec::variables[node.what].old_word == program_.text_of(node.span));
    if (node.kind == NodeKind::Element)
      check_index(n);
    if (node.kind == NodeKind::Relation)
      check_sensor(n);
    if (node.kind == NodeKind::Binary)
      check_quotient(n);
    const bool takes_conditions =
        node.kind == NodeKind::Not || node.kind == NodeKind::And || node.kind == NodeKind::Or;
    if (takes_conditions || node.first == n)
      return;
    for (auto operand = n - 1;; operand = program_.nodes[operand].first - 1) {
      if (program_.nodes[operand].is_condition())
        report_condition(operand);
      if (program_.nodes[operand].first == node.first || program_.nodes[operand].first == 0)
        break;
    }
  }

  /// A sensor that is compared with a number, whichever side it stands on.
  void check_sensor(std::uint32_t n) {
    const auto& nodes = program_.nodes;
    const auto right = n - 1;
    const auto left = program_.before(right);
    const bool sensor_right = nodes[right].kind == NodeKind::System;
    if (sensor_right == (nodes[left].kind == NodeKind::System))
      return;
    const auto number = evaluate(program_, names_, sensor_right ? left : right);
    if (!number)
      return;
    const auto comparison = static_cast<Comparison>(nodes[n].what);
    const auto sensor = static_cast<spec::Variable>(nodes[sensor_right ? right : left].what);
    auto question =
        question_of(sensor_right ? mirrored(comparison) : comparison, sensor, number->value);
    if (!question)
      return;
    if (number->duration)
      question->written = 0; // it says its unit
    const auto answer = compiler::judge(*question, program_.text_of(nodes[n].span), timers_);
    if (answer)
      report(*answer->rule, nodes[n].span, answer->message, answer->help);
  }

  static Comparison mirrored(Comparison comparison) {
    switch (comparison) {
    case Comparison::Less: return Comparison::Greater;
    case Comparison::Greater: return Comparison::Less;
    case Comparison::LessEqual: return Comparison::GreaterEqual;
    case Comparison::GreaterEqual: return Comparison::LessEqual;
    case Comparison::Equal:
    case Comparison::NotEqual: break;
    }
    return comparison;
  }

  /// The same question as the robot asks it, which has no `<=` and `>=`.
  static std::optional<compiler::SensorQuestion>
  question_of(Comparison comparison, spec::Variable sensor, std::int32_t number) {
    using spec::Relation;
    const auto ask = [&](Relation relation, std::int64_t asked,
                         std::string symbol) -> std::optional<compiler::SensorQuestion> {
      if (asked < std::numeric_limits<std::int32_t>::min() ||
          asked > std::numeric_limits<std::int32_t>::max())
        return std::nullopt;
      return compiler::SensorQuestion{sensor, relation, static_cast<std::int32_t>(asked),
                                      std::move(symbol), number};
    };
    switch (comparison) {
    case Comparison::Equal: return ask(Relation::Equal, number, "=");
    case Comparison::NotEqual: return ask(Relation::NotEqual, number, "!");
    case Comparison::Less: return ask(Relation::Less, number, "<");
    case Comparison::Greater: return ask(Relation::Greater, number, ">");
    case Comparison::LessEqual: return ask(Relation::Less, std::int64_t{number} + 1, "<=");
    case Comparison::GreaterEqual: return ask(Relation::Greater, std::int64_t{number} - 1, ">=");
    }
    return std::nullopt;
  }

  /// `1 / 2` is 0.
  void check_quotient(std::uint32_t n) {
    const auto& nodes = program_.nodes;
    const auto& right = nodes[n - 1];
    const auto& left = nodes[program_.before(n - 1)];
    if (static_cast<spec::Operator>(nodes[n].what) != spec::Operator::Divide ||
        left.kind != NodeKind::Number || right.kind != NodeKind::Number || left.value == 0 ||
        left.value >= right.value)
      return;
    report(compiler::rules::ZeroQuotient, nodes[n].span,
           fmt::format("`{} / {}` is 0: values are whole numbers", left.value, right.value),
           fmt::format("multiply first: `x * {} / {}`", left.value, right.value));
  }

  /// `x = 1 or 6`: the number was meant to be compared like the one before it.
  void check_sides(std::uint32_t root) {
    const auto& nodes = program_.nodes;
    for (auto n = nodes[root].first; n <= root; ++n) {
      if (nodes[n].kind != NodeKind::And && nodes[n].kind != NodeKind::Or)
        continue;
      const auto right = n - 1;
      const auto left = program_.before(right);
      check_side(left, right);
      check_side(right, left);
    }
  }

  void check_side(std::uint32_t side, std::uint32_t other) {
    const auto& nodes = program_.nodes;
    if (nodes[side].kind != NodeKind::Number)
      return;
    const auto number = program_.text_of(nodes[side].span);
    std::string help;
    if (nodes[other].kind == NodeKind::Relation)
      help = fmt::format("write `{}{}`",
                         program_.text_of({nodes[other].span.begin, nodes[other - 1].span.begin}),
                         number);
    report(rules::NumberAsCondition, nodes[side].span,
           fmt::format("`{}` alone is a condition that {} holds", number,
                       nodes[side].value == 0 ? "never" : "always"),
           std::move(help));
  }

  /// 2147483648 can only be written with a minus sign before it.
  void check_number(std::uint32_t n, bool is_root) {
    const auto& node = program_.nodes[n];
    if (node.kind != NodeKind::Number || node.value != std::numeric_limits<std::int32_t>::min())
      return;
    if (is_root || program_.nodes[n + 1].kind != NodeKind::Negate ||
        program_.nodes[n + 1].first != n)
      report(rules::BadNumber, node.span,
             fmt::format("`{}` is above {}", program_.text_of(node.span),
                         spec::value_of(spec::Limit::GreatestInteger)));
  }

  void check_index(std::uint32_t n) {
    const auto index = names_.of_node[n];
    if (index == none)
      return;
    const auto& symbol = names_.symbols[index];
    const auto value = evaluate(program_, names_, n - 1);
    if (value && symbol.value > 0 && (value->value < 1 || value->value > symbol.value))
      report(rules::ArrayIndex, program_.nodes[n - 1].span,
             fmt::format("`{}` has the elements 1 to {}, found {}", program_.name(symbol.name),
                         symbol.value, value->value));
  }

  void check_version(Span span, std::string_view word, spec::BasicVersion since, bool old_name) {
    if (since > target_.version && !old_name)
      report(compiler::rules::NewerThanTarget, span,
             fmt::format("`{}` needs orbBasic {}, the target has {}", word, spec::info(since).text,
                         spec::info(target_.version).text));
  }

  // ---- where statements stand

  /// Keeps the open blocks; the end of a block has its opener's depth.
  void follow(std::uint32_t i, const Statement& statement) {
    if (opens_block(statement.role()))
      open_.push_back(i);
    else if (closes_block(statement.role()) && statement.opener != none)
      while (!open_.empty() && open_.back() >= statement.opener) // those without an end too
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

  /// Whether the line that begins the sub around a statement does not parse.
  bool in_broken_routine() const {
    return std::any_of(open_.begin(), open_.end(), [&](std::uint32_t opener) {
      return at(opener).meant == Kind::Sub || at(opener).meant == Kind::Function;
    });
  }

  void misplaced(const Statement& statement, std::string message, std::string help = {}) {
    report(rules::MisplacedStatement, statement.word.size() > 0 ? statement.word : statement.span,
           std::move(message), std::move(help));
  }

  /// Of what nothing is around to be left, also where the words are those of another language,
  /// which is not a second mistake.
  void stands_outside(const Statement& statement, std::string_view of, std::string help = {}) {
    auto words = statement.word;
    std::erase_if(program_.diagnostics, [&](const Diagnostic& one) {
      const bool same = one.rule == &rules::ForeignWord && one.span.begin == words.begin;
      words = same ? one.span : words;
      return same;
    });
    report(rules::MisplacedStatement, words,
           fmt::format("`{}` stands outside of {}", program_.text_of(words), of), std::move(help));
  }

  void check_place(std::uint32_t i, const Statement& statement) {
    const auto routine = names_.routine_of[i];
    const auto word = program_.text_of(statement.word);
    if (declares(statement.kind) && statement.depth > 0)
      misplaced(statement, fmt::format("`{}` stands inside a block", word),
                "declarations stand at top level");
    if ((statement.kind == Kind::Exit || statement.kind == Kind::Continue) && !in_loop())
      stands_outside(statement, "loops");
    if (statement.kind == Kind::Local && (routine == 0 || statement.depth != 1) &&
        !in_broken_routine())
      misplaced(statement,
                routine == 0 ? "`local` stands outside of subs and functions"
                             : "`local` stands inside a block",
                routine == 0 ? "the variables of the main program need no declaration"
                             : "move it to the beginning of the sub");
    if (statement.kind == Kind::Return)
      check_return(routine, statement);
    if (!open_.empty() && at(open_.back()).kind == Kind::Select &&
        at(open_.back()).next == none_yet(i) && !parts_block(statement.kind) &&
        !closes_block(statement.kind) && statement.kind != Kind::Broken)
      misplaced(statement, "a statement stands between `select` and its first `case`");
  }

  /// The first part of the innermost block where it lies after statement `i`.
  std::uint32_t none_yet(std::uint32_t i) const {
    const auto next = at(open_.back()).next;
    return next != none && next > i ? next : none - 1;
  }

  void check_return(std::uint32_t routine, const Statement& statement) {
    if (routine == 0) {
      if (!in_broken_routine())
        stands_outside(statement, "subs and functions", "`end` ends the program");
      return;
    }
    const auto& symbol = names_.symbols[names_.routines[routine].symbol];
    const bool function = symbol.kind == SymbolKind::Function;
    if (function && size(statement) == 0)
      report(rules::ArgumentCount, statement.span, "a function returns a value",
             "write `return e`");
    else if (!function && size(statement) > 0)
      report(rules::ArgumentCount, item(statement, 0).span, "a sub returns no value",
             "make it a `function`");
  }

  // ---- statements

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

  void check_assign(const Statement& statement) {
    const auto& target = program_.nodes[item(statement, 0).value];
    if (target.kind != NodeKind::System || statement.operation != Statement::none_operation)
      return;
    const auto& row = spec::variables[target.what];
    if (row.variable != spec::Variable::Ctrl)
      check_range(item(statement, 1), row.word, {"", row.least, row.greatest, row.unit});
  }

  void check_range(const Item& part, std::string_view word, const spec::Parameter& parameter) {
    if (part.kind != ItemKind::Expression)
      return;
    const auto value = value_of(part);
    if (!value || (value->value >= parameter.least && value->value <= parameter.greatest))
      return;
    const auto name = parameter.name.empty() ? "" : fmt::format("{} ", parameter.name);
    report(compiler::rules::ValueOutOfRange, part.span,
           fmt::format("`{}` takes {}{} to {}, found {}", word, name, parameter.least,
                       parameter.greatest, value->value));
  }

  void check_robot(const Statement& statement) {
    const auto& row = spec::info(statement.robot);
    // With two values `goroll` is older: the robot's lines are checked for its go value.
    if (statement.robot != spec::Statement::Goroll || size(statement) == row.parameters().size())
      check_version(statement.word, row.word, row.since, false);
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
      check_range(item(statement, n), row.word, row.parameters()[n]);
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
    report(rules::ArgumentCount, statement.span,
           fmt::format("`RGB` takes 3 values or a colour, found {}", size(statement)));
  }

  void check_data(const Statement& statement) {
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues));
    for (const auto& part : program_.items_of(statement))
      require_constant(part);
    if (size(statement) > most)
      report(compiler::rules::TooManyDataValues, item(statement, most).span,
             fmt::format("the line holds {} values; the robot ignores those after the {}th",
                         size(statement), most));
  }

  bool require_constant(const Item& part) {
    if (value_of(part))
      return true;
    if (program_.nodes[part.value].is_condition() || names_unknown(part.value))
      return false; // said already
    report(rules::NotConstant, part.span, "the value is not known when the program is compiled",
           "use literals and constants that are declared above");
    return false;
  }

  bool is_quotient(std::uint32_t node) const {
    const auto divide = static_cast<std::uint8_t>(spec::Operator::Divide);
    return program_.nodes[node].kind == NodeKind::Binary && program_.nodes[node].what == divide;
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
          report(rules::BadNumber, node.span,
                 fmt::format("`{}` is not a whole number of seconds", program_.text_of(node.span)),
                 "`sleep` counts in seconds");
      } else if (node.kind == NodeKind::Name && names_.of_node[n] != none &&
                 names_.symbols[names_.of_node[n]].duration && !is_quotient(time.value)) {
        written = true;
        report(rules::SecondsExpected, node.span,
               fmt::format("`{}` is in milliseconds, `sleep` counts in seconds",
                           program_.text_of(node.span)),
               "write the duration here, or divide by 1000");
      }
    }
    if (!written)
      check_range(time, "sleep", parameters[0]);
    if (size(statement) > 1)
      check_range(item(statement, 1), "sleep", parameters[1]);
    if (size(statement) > 2 && item(statement, 2).kind != ItemKind::Restart)
      report(rules::MalformedLine, item(statement, 2).span,
             "the third value of `sleep` is the word `restart`, or nothing");
  }

  // ---- loops

  std::uint32_t variable_of(const Statement& loop) const {
    return names_.of_node[item(loop, 0).value];
  }

  void check_for(const Statement& statement) {
    const auto variable = variable_of(statement);
    const auto around = std::find_if(open_.rbegin(), open_.rend(), [&](std::uint32_t opener) {
      return variable != none && at(opener).kind == Kind::For &&
             variable_of(at(opener)) == variable;
    });
    if (around != open_.rend()) {
      const auto name = program_.text_of(item(statement, 0).span);
      auto& d = report(rules::LoopVariable, item(statement, 0).span,
                       fmt::format("the loop around this one counts in `{}` already", name));
      d.notes.push_back({at(*around).span, fmt::format("this loop counts in `{}`", name)});
    }
    if (program_.nodes[item(statement, 0).value].kind == NodeKind::System)
      report(rules::WrongUse, item(statement, 0).span, "a loop counts in a variable");
    if (size(statement) < 4 || !require_constant(item(statement, 3)))
      return;
    if (value_of(item(statement, 3))->value == 0)
      report(compiler::rules::ZeroStep, item(statement, 3).span, "the step of the loop is 0");
  }

  void check_next(const Statement& statement) {
    if (size(statement) == 0 || statement.opener == none)
      return;
    const auto& loop = at(statement.opener);
    if (loop.kind != Kind::For)
      return;
    const auto& named = program_.nodes[item(statement, 0).value];
    const auto& counter = program_.nodes[item(loop, 0).value];
    if (counter.kind == NodeKind::Name &&
        (named.kind != NodeKind::Name || counter.value != named.value))
      report(rules::LoopVariable, item(statement, 0).span,
             fmt::format("the innermost loop counts in `{}`", program_.text_of(counter.span)),
             fmt::format("write `next {}`, or `next` alone", program_.text_of(counter.span)));
  }

  // ---- select

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

  struct CaseRange {
    std::int32_t lo;
    std::int32_t hi;
    std::uint32_t select;
  };

  void add_case(CaseRange range, Span span) {
    if (range.lo > range.hi) {
      report(rules::CaseValue, span, fmt::format("{} is above {}", range.lo, range.hi),
             "write the smaller value first");
      return;
    }
    for (const auto& other : cases_)
      if (other.select == range.select && other.lo <= range.hi && range.lo <= other.hi) {
        report(rules::CaseValue, span,
               fmt::format("{} has a `case` above already", std::max(other.lo, range.lo)));
        return;
      }
    constexpr std::size_t most = 1024; // no robot holds more; looking for doubles takes pairs
    if (cases_.size() < most)
      cases_.push_back(range);
  }

  // ---- jumps and calls

  void check_jumps() {
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
                 fmt::format("`{}` is a label already", program_.text_of(at(labels[n]).name_span)));
          break;
        }
    for (const auto i : program_.order)
      if (at(i).kind == Kind::Goto)
        check_goto(i, labels);
  }

  void check_goto(std::uint32_t i, const std::vector<std::uint32_t>& labels) {
    const auto& jump = at(i);
    const auto label = std::find_if(labels.begin(), labels.end(), [&](std::uint32_t l) {
      return at(l).name == jump.name && names_.routine_of[l] == names_.routine_of[i];
    });
    if (label == labels.end()) {
      report(rules::GotoTarget, jump.name_span,
             fmt::format("there is no label `{}:` here", program_.text_of(jump.name_span)));
      return;
    }
    if (!encloses(*label, i))
      report(rules::GotoTarget, jump.name_span,
             fmt::format("the label `{}` lies inside a block", program_.text_of(jump.name_span)),
             "a `goto` may leave blocks, never enter one");
    else
      report(rules::Unstructured, jump.span, "a `goto` stands in the program");
  }

  /// Whether every block around `label` is also around `other`.
  bool encloses(std::uint32_t label, std::uint32_t other) const {
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

  void check_recursion() {
    const auto calls = calls_of(program_, names_);
    std::vector<std::uint8_t> state(calls.size(), 0); // 1 open, 2 done
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
          report_circle(path, callee);
          return;
        }
        if (state[callee] == 0) {
          state[callee] = 1;
          path.push_back({callee, 0});
        }
      }
    }
  }

  void report_circle(const std::vector<std::pair<std::uint32_t, std::size_t>>& path,
                     std::uint32_t callee) {
    std::string circle;
    bool inside = false;
    for (const auto& [routine, next] : path) {
      inside = inside || routine == callee;
      if (inside)
        circle += fmt::format("`{}` calls ", name_of(routine));
    }
    const auto& symbol = names_.symbols[names_.routines[callee].symbol];
    report(rules::Recursion, symbol.span, fmt::format("{}`{}`", circle, name_of(callee)),
           "use a loop");
  }

  // ---- loops

  void check_loops() {
    for (const auto i : program_.order) {
      if (at(i).kind == Kind::Loop)
        check_endless(i);
      if (at(i).kind == Kind::For)
        check_counter(i);
    }
  }

  /// What stands after a loop that nothing leaves.
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
    const auto after = end + 1;
    if (after >= program_.statements.size() || names_.routine_of[after] != names_.routine_of[i] ||
        at(after).depth != at(i).depth || at(after).kind == Kind::Label ||
        declares(at(after).kind) || parts_block(at(after).kind) || closes_block(at(after).kind))
      return;
    report(compiler::rules::UnreachableLine, at(after).span,
           "this never runs: nothing leaves the loop above",
           "leave the loop with `exit`, as in `if speed = 0 then exit`");
  }

  /// A loop whose counter is an index in each turn, and not always that of an element.
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
        if (part.kind != ItemKind::Expression && part.kind != ItemKind::Place &&
            part.kind != ItemKind::Character)
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
                 fmt::format("`{}` counts from {} to {}, and `{}` has the elements 1 to {}", name,
                             first->value, last->value, program_.name(array.name), array.value),
                 fmt::format("write `for {} = 1 to {}`", name, array.value));
          return;
        }
      }
    }
  }

  // ---- unused names

  void check_unused() {
    if (any_error(program_.diagnostics))
      return; // what reads it may be what is wrong
    const bool runs = main_file_runs();
    for (const auto& symbol : names_.symbols) {
      if (symbol.read)
        continue;
      if (symbol.kind == SymbolKind::Variable)
        report_unused(symbol, "is set but never read");
      else if (symbol.kind == SymbolKind::Local)
        report_unused(symbol, "is never read");
      else if (symbol.kind == SymbolKind::Constant && runs && in_main_file(symbol.span))
        report_unused(symbol,
                      "is never used"); // those of an included file are for all that include it
    }
  }

  void report_unused(const Symbol& symbol, std::string_view how) {
    report(rules::UnusedName, symbol.span, fmt::format("`{}` {}", program_.name(symbol.name), how));
  }

  bool in_main_file(Span span) const {
    return &program_.file_at(span.begin) == &program_.files.front();
  }

  /// Not only declarations, for others to include.
  bool main_file_runs() const {
    return std::any_of(program_.statements.begin(), program_.statements.end(),
                       [&](const Statement& one) {
                         return one.depth == 0 && !declares(one.kind) && one.kind != Kind::EndSub &&
                                one.kind != Kind::EndFunction && in_main_file(one.span);
                       });
  }

  std::string_view name_of(std::uint32_t routine) const {
    return program_.name(names_.symbols[names_.routines[routine].symbol].name);
  }

  compiler::Timers timers_;
  Program& program_;
  const Names& names_;
  const compiler::Target& target_;
  std::vector<std::uint32_t> open_;
  std::vector<CaseRange> cases_;
};

} // namespace

void check(Program& program, const Names& names, const compiler::Target& target) {
  Checker(program, names, target).run();
}

std::vector<std::vector<std::uint32_t>> calls_of(const Program& program, const Names& names) {
  std::vector<std::vector<std::uint32_t>> calls(names.routines.size());
  const auto add = [&](std::uint32_t from, std::uint32_t symbol) {
    if (symbol == none || names.symbols[symbol].routine == 0)
      return;
    calls[from].push_back(names.symbols[symbol].routine);
  };
  for (const auto i : program.order) {
    const auto& statement = program.statements[i];
    if (statement.kind == Kind::Call)
      add(names.routine_of[i], names.of_statement[i]);
    for (const auto& item : program.items_of(statement))
      if (item.kind == ItemKind::Expression || item.kind == ItemKind::Place ||
          item.kind == ItemKind::Character)
        for (auto n = program.nodes[item.value].first; n <= item.value; ++n)
          if (program.nodes[n].kind == NodeKind::Call)
            add(names.routine_of[i], names.of_node[n]);
  }
  for (auto& list : calls) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return calls;
}

} // namespace orb::structured
