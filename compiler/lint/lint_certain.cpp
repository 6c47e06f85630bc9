#include "compiler/lint/letters.h"
#include "compiler/lint/lint_passes.h"
#include "compiler/lint/range.h"
#include "compiler/lint/reading.h"
#include "compiler/text/rules.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace orb::compiler {
namespace {

/// A value that stops the program, whatever its sensors say.
struct CertainFault {
  Span span;
  Message message;
};

/// Runs a program from its first line for as long as nothing unknown decides where it goes.
class CertainRun {
public:
  CertainRun(const Program& program, const Flow& flow)
      : program_(program), flow_(flow), known_(program.nodes.size()) {}

  std::optional<CertainFault> run() {
    std::uint32_t at = 0;
    for (std::uint32_t lines = 0; lines < most_lines && at < flow_.code.size(); ++lines) {
      const auto next = go(at);
      if (fault_ || next == none)
        return fault_;
      if (next <= at && !is_news(next))
        return std::nullopt; // it does the same for ever
      at = next;
    }
    return std::nullopt;
  }

private:
  static constexpr std::uint32_t most_lines = 1500; ///< `for h = 0 to 360` and what is in it

  struct Loop {
    std::uint32_t letter = 0;
    std::uint32_t body = 0;
    Range end;
    Range step;
  };

  /// Whether what is known is not what it was when it last came back to this line.
  bool is_news(std::uint32_t code) {
    const bool same = back_at_ == code && back_.ranges == now_.ranges;
    back_at_ = code;
    back_ = now_;
    return !same;
  }

  void stop(Span span, Message message) {
    if (certain_ && !fault_)
      fault_ = CertainFault{span, std::move(message)};
  }

  Message becomes(Message allowed, Span span, Range range) const {
    return texts::ButBecomes(std::move(allowed), program_.text_of(span), shown(range));
  }

  // ---- values

  const Range& value(const Item& item) {
    for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
      known_[n] = compute(program_.nodes[n], n);
    return known_[item.value];
  }

  Range compute(const Node& node, std::uint32_t index) {
    switch (node.kind) {
    case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
    case NodeKind::Letter: return now_.ranges[node.what];
    case NodeKind::Indexed: check_index(node.span); return {};
    case NodeKind::System:
      return {spec::variables[node.what].least, spec::variables[node.what].greatest};
    case NodeKind::Group: return known_[index - 1];
    case NodeKind::Negate: return negate(known_[index - 1]);
    case NodeKind::Call: {
      const auto& row = spec::functions[node.what];
      const auto& operand = known_[index - 1];
      if (operand.misses(row.least, row.greatest))
        stop(program_.nodes[index - 1].span, becomes(texts::TakesOrMore(row.word, row.least),
                                                     program_.nodes[index - 1].span, operand));
      return apply(row.function, operand);
    }
    case NodeKind::Binary: {
      const auto& right = known_[index - 1];
      const auto left = program_.nodes[index - 1].first - 1;
      check_right(static_cast<spec::Operator>(node.what), program_.nodes[index - 1].span, right);
      return apply(static_cast<spec::Operator>(node.what), known_[left], right);
    }
    }
    return {};
  }

  void check_right(spec::Operator op, Span span, const Range& right) {
    const auto most = spec::value_of(spec::Limit::GreatestShift);
    const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
    const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
    if (divides && right == Range::only(0))
      stop(span, texts::DividesByZeroHere(program_.text_of(span)));
    else if (shifts && right.misses(0, most))
      stop(span, becomes(texts::ShiftMustBe(most), span, right));
  }

  void check_index(Span span) {
    const auto& index = now_.ranges[index_letter];
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    if (index.misses(1, most))
      stop(span, texts::UsedWhileIndexBecomes('Z', 'Y', shown(index), 1, most));
  }

  void check_value(const Item& item, std::string_view word, const spec::Parameter& parameter) {
    const auto& range = value(item);
    if (range.misses(parameter.least, parameter.greatest))
      stop(item.span, becomes(allowed_values(word, parameter), item.span, range));
  }

  void set(const Item& variable, const Range& range) {
    if (variable.kind == ItemKind::Letter) {
      now_.ranges[variable.value] = range;
    } else if (variable.kind == ItemKind::Indexed) {
      check_index(variable.span);
    }
  }

  // ---- lines

  /// The line of code that comes next; `none` where that depends on something unknown.
  std::uint32_t go(std::uint32_t at) {
    const auto& statement = program_.statements[flow_.code[at].statement];
    if (statement.error)
      return none;
    if (spec::info(statement.kind).form == spec::Form::Conditional)
      return branch(statement, at);
    return step(statement, at);
  }

  std::uint32_t step(const StatementNode& statement, std::uint32_t at) {
    if (statement.error)
      return none;
    switch (spec::info(statement.kind).form) {
    case spec::Form::Loop: return begin_loop(program_.as<ForView>(statement), at);
    case spec::Form::LoopEnd: return end_loop(program_.as<NextView>(statement), at);
    case spec::Form::Branch: return jump(statement, 0, at);
    case spec::Form::IndexedBranch: return choose(statement, at);
    case spec::Form::Conditional: return none; // within another one
    case spec::Form::Assignment:
    case spec::Form::Output:
    case spec::Form::Entry:
    case spec::Form::Values:
    case spec::Form::Variables:
    case spec::Form::Arguments: break;
    }
    if (statement.kind == spec::Statement::Return)
      return come_back();
    obey(statement);
    return spec::info(statement.kind).after == spec::After::Ends ? none : at + 1;
  }

  /// A statement below which the next line comes.
  void obey(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const auto items = program_.items_of(statement);
    if (row.form == spec::Form::Assignment)
      return let(program_.as<LetView>(statement));
    for (std::size_t i = 0; i < items.size(); ++i)
      if (row.form == spec::Form::Arguments)
        check_value(items[i], row.word, row.parameter_slots[i]);
      else if (items[i].kind == ItemKind::Expression || items[i].kind == ItemKind::Character)
        value(items[i]);
      else // that `read` or `input` sets
        set(items[i], {});
  }

  void let(const LetView& let) {
    const auto range = value(let.expression);
    if (let.variable.kind == ItemKind::System) {
      const auto& row = spec::variables[let.variable.value];
      if (row.variable != spec::Variable::Ctrl)
        check_value(let.expression, row.word, {"", row.least, row.greatest, row.unit});
    } else {
      set(let.variable, range);
    }
  }

  std::uint32_t begin_loop(const ForView& loop, std::uint32_t at) {
    if (loop.variable.kind != ItemKind::Letter)
      return none;
    now_.ranges[loop.variable.value] = value(loop.start);
    const auto end = value(loop.end);
    const auto by = loop.step != nullptr ? value(*loop.step) : Range::only(1);
    if (by.has(0))
      return none; // which may stop it, and is said elsewhere
    // The innermost loop may begin again.
    if (!loops_.empty() && loops_.back().letter == loop.variable.value)
      loops_.pop_back();
    if (loops_.size() == static_cast<std::size_t>(spec::value_of(spec::Limit::ForDepth)))
      return none;
    loops_.push_back({loop.variable.value, at + 1, end, by});
    return at + 1;
  }

  std::uint32_t end_loop(const NextView& next, std::uint32_t at) {
    if (next.variable.kind != ItemKind::Letter || loops_.empty() ||
        loops_.back().letter != next.variable.value)
      return none;
    const auto& loop = loops_.back();
    auto& counter = now_.ranges[loop.letter];
    counter = apply(spec::Operator::Add, counter, loop.step);
    const auto over = loop.step.lo > 0 ? spec::Relation::Greater : spec::Relation::Less;
    if (!where(over, Holds::Yes, counter, loop.end))
      return loop.body;
    if (where(over, Holds::No, counter, loop.end))
      return none;
    loops_.pop_back();
    return at + 1;
  }

  /// To the line that the item names, by its place among those of the statement.
  std::uint32_t jump(const StatementNode& statement, std::uint32_t nth, std::uint32_t at) {
    for (const auto& way : flow_.jumps_of(flow_.code[at])) {
      if (way.item != statement.items_begin + nth || way.to == none)
        continue;
      if (!way.call)
        return way.to;
      if (calls_.size() == static_cast<std::size_t>(spec::value_of(spec::Limit::GosubDepth)))
        return none;
      calls_.push_back(at + 1);
      return way.to;
    }
    return none;
  }

  std::uint32_t choose(const StatementNode& statement, std::uint32_t at) {
    const auto on = program_.as<OnView>(statement);
    const auto range = value(on.selector);
    const auto count = static_cast<std::int32_t>(on.targets.size());
    if (range.misses(1, count))
      stop(on.selector.span, becomes(counted(on.targets.size(), texts::ListHasOne, texts::ListHas),
                                     on.selector.span, range));
    if (!range.constant() || range.misses(1, count))
      return none;
    return jump(statement, static_cast<std::uint32_t>(range.lo), at);
  }

  std::uint32_t come_back() {
    if (calls_.empty())
      return none;
    const auto at = calls_.back();
    calls_.pop_back();
    return at;
  }

  // ---- conditions

  std::uint32_t branch(const StatementNode& statement, std::uint32_t at) {
    const auto* yes = &program_.statements[statement.then_branch];
    const auto* no =
        statement.else_branch == none ? nullptr : &program_.statements[statement.else_branch];
    if (const auto holds = truth(program_.as<IfView>(statement))) {
      const auto* taken = *holds ? yes : no;
      return taken == nullptr ? at + 1 : step(*taken, at);
    }
    if (!goes_on(*yes) || (no != nullptr && !goes_on(*no)))
      return none;
    certain_ = false;
    const auto before = now_;
    obey(*yes);
    const auto after = now_;
    now_ = before;
    if (no != nullptr)
      obey(*no);
    join_into(now_, after, letters_of(program_));
    certain_ = true;
    return at + 1;
  }

  /// Whether the line below comes next, whatever happens.
  static bool goes_on(const StatementNode& statement) {
    const auto after = spec::info(statement.kind).after;
    return !statement.error && (after == spec::After::Falls || after == spec::After::Waits);
  }

  std::optional<bool> truth(const IfView& condition) {
    const auto first = truth(condition.first);
    if (condition.joint == nullptr)
      return first;
    const bool sure = std::exchange(certain_, false); // it need not be looked at
    const auto second = truth(*condition.second);
    certain_ = sure;
    const bool decides = condition.joint->kind == ItemKind::Or; // as soon as one is this
    if (first == decides || second == decides)
      return decides;
    return first && second ? std::optional(!decides) : std::nullopt;
  }

  std::optional<bool> truth(const Comparison& comparison) {
    const auto relation = static_cast<spec::Relation>(comparison.relation.value);
    const auto left = value(comparison.left);
    const auto right = value(comparison.right);
    if (!where(relation, Holds::No, left, right))
      return true;
    if (!where(relation, Holds::Yes, left, right))
      return false;
    return std::nullopt;
  }

  const Program& program_;
  const Flow& flow_;
  std::vector<Range> known_; ///< by node
  Letters now_ = Letters::zero();
  std::vector<Loop> loops_;
  std::vector<std::uint32_t> calls_; ///< where they come back to
  Letters back_;                     ///< when it last went back
  std::uint32_t back_at_ = none;
  bool certain_ = true; ///< what runs now runs for certain
  std::optional<CertainFault> fault_;
};

bool meets(Span a, Span b) {
  return a.begin < b.end && b.begin < a.end;
}

/// Whether a sum that grows without limit is of a letter that stands at `span`.
bool is_about(const Program& program, const Diagnostic& grown, Span span) {
  return std::any_of(
      program.statements.begin(), program.statements.end(), [&](const StatementNode& statement) {
        if (statement.error || statement.kind != spec::Statement::Let)
          return false;
        const auto let = program.as<LetView>(statement);
        return let.expression.span == grown.span && let.variable.kind == ItemKind::Letter &&
               std::any_of(program.nodes.begin(), program.nodes.end(), [&](const Node& node) {
                 return node.kind == NodeKind::Letter && node.what == let.variable.value &&
                        meets(node.span, span);
               });
      });
}

/// Whether a finding warns of what happens for certain there.
bool warns_of(const Program& program, const Diagnostic& d, Span span) {
  if (d.rule == &rules::HeadingGrows || d.rule == &rules::ValueGrows)
    return is_about(program, d, span);
  return meets(d.span, span) && (d.rule == &rules::LoopLeavesRange ||
                                 d.rule == &rules::MayLeaveRange || d.rule == &rules::IndexBeforeY);
}

} // namespace

void lint_certain(const Program& program, const Flow& flow, Findings& findings) {
  const auto fault = CertainRun(program, flow).run();
  if (!fault)
    return;
  auto& all = findings.all();
  const bool said = std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) {
    return is_error(d) && meets(d.span, fault->span);
  });
  if (said)
    return;
  bool warned = false;
  for (auto& d : all)
    if (warns_of(program, d, fault->span)) {
      d.severity = Severity::Error;
      warned = true;
    }
  if (!warned)
    findings.add(rules::MayLeaveRange, fault->span, fault->message).severity = Severity::Error;
}

} // namespace orb::compiler
