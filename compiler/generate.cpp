#include "compiler/generate.h"

#include "bytecode/arithmetic.h"
#include "bytecode/op.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace orb::compiler {

namespace {

using bytecode::Chunk;
using bytecode::Ends;
using bytecode::Op;
using spec::BasicError;
using spec::Function;
using spec::Operator;
using spec::Relation;
using spec::Statement;

/// Registers of constants get their final number when the temporaries have been counted.
constexpr std::uint16_t constant_mark = 0x8000;
/// Of constants and of texts.
constexpr std::size_t most_registers = 0x7F00;

/// The row of a relation among the four that begin with the one for `=`.
constexpr Op with_relation(Op equal, Relation relation) {
  return static_cast<Op>(static_cast<std::size_t>(equal) + static_cast<std::size_t>(relation));
}
static_assert(with_relation(Op::UnlessEqual, Relation::Greater) == Op::UnlessGreater &&
              with_relation(Op::WhenEqual, Relation::Less) == Op::WhenLess &&
              with_relation(Op::SelectEqual, Relation::NotEqual) == Op::SelectNotEqual);

constexpr std::array operations{Op::Multiply,  Op::Divide,     Op::Remainder,
                                Op::ShiftLeft, Op::ShiftRight, Op::Add,
                                Op::Subtract,  Op::And,        Op::Or};
static_assert(operations.size() == spec::operators.size() &&
              operations[static_cast<std::size_t>(Operator::ShiftRight)] == Op::ShiftRight &&
              operations[static_cast<std::size_t>(Operator::Or)] == Op::Or);

constexpr std::array functions{Op::Sqrt, Op::Rnd, Op::Abs};
static_assert(functions.size() == spec::functions.size() &&
              functions[static_cast<std::size_t>(Function::Abs)] == Op::Abs);

/// Emits instructions in the order of the text: whatever an expression does (fail, draw a random
/// number, clear what it reads) happens where it is written.
class Generator {
public:
  explicit Generator(const Program& program) : program_(program) {}

  Chunk run() {
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number())
        line_of_.try_emplace(program_.lines[i].number, i); // of duplicates the first counts, A-26
    begins_.assign(program_.lines.size() + 1, 0);
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      begins_[i] = here();
      if (!line.has_statement())
        continue;
      const auto number = line.number <= UINT16_MAX ? line.number : 0;
      chunk_.lines.push_back({static_cast<std::uint16_t>(number), here()});
      statement(program_.statements[line.statement]);
      if (overflow_)
        give_up(begins_[i]);
    }
    begins_[program_.lines.size()] = here();
    emit(Op::EndOfProgram);
    resolve();
    return std::move(chunk_);
  }

private:
  std::uint32_t here() const { return static_cast<std::uint32_t>(chunk_.code.size()); }

  std::uint32_t emit(Op op, std::uint16_t a = 0, std::uint16_t b = 0, std::uint16_t c = 0,
                     std::uint16_t d = 0) {
    chunk_.code.push_back({op, false, a, b, c, d, 0});
    return here() - 1;
  }

  /// The line ends with what was emitted last.
  void end_line() { chunk_.code.back().ends_line = true; }

  /// Leads instruction `at` to a line; false where there is none of that number.
  bool lead_to(std::uint32_t at, std::uint32_t number) {
    const auto found = line_of_.find(number);
    if (found == line_of_.end())
      return false;
    jumps_.emplace_back(at, found->second);
    return true;
  }

  void resolve() {
    for (const auto& [at, line] : jumps_)
      chunk_.code[at].target = begins_[line];
    const std::uint16_t first = chunk_.first_constant();
    const auto place = [&](std::uint16_t& operand, char kind) {
      if (kind == 'r' && operand >= constant_mark)
        operand = static_cast<std::uint16_t>(operand - constant_mark + first);
    };
    for (auto& instruction : chunk_.code) {
      const auto operands = bytecode::info(instruction.op).operands;
      place(instruction.a, operands[0]);
      place(instruction.b, operands[1]);
      place(instruction.c, operands[2]);
      place(instruction.d, operands[3]);
    }
  }

  /// No text that fits a ball runs out of registers; of one that does, the line is a trap.
  void give_up(std::uint32_t begin) {
    overflow_ = false;
    chunk_.code.resize(begin);
    while (!jumps_.empty() && jumps_.back().first >= begin)
      jumps_.pop_back();
    trap(BasicError::ExpressionTooComplex);
  }

  void trap(BasicError error) { emit(Op::Trap, spec::code(error)); }

  // Registers. The stack holds those of the values that have been computed and not yet used.

  std::uint16_t constant(std::int32_t value) {
    if (chunk_.constants.size() >= most_registers && !constants_.contains(value)) {
      overflow_ = true;
      return constant_mark;
    }
    const auto [at, fresh] = constants_.try_emplace(
        value, static_cast<std::uint16_t>(constant_mark + chunk_.constants.size()));
    if (fresh)
      chunk_.constants.push_back(value);
    return at->second;
  }

  std::optional<std::int32_t> constant_in(std::uint16_t index) const {
    if (index < constant_mark)
      return std::nullopt;
    return chunk_.constants[index - constant_mark];
  }

  static bool is_temporary(std::uint16_t index) {
    return index >= bytecode::first_temporary && index < constant_mark;
  }

  /// The temporary that belongs to a place on the stack: a value is in nobody's way there.
  std::uint16_t temporary(std::size_t place) {
    chunk_.temporaries = std::max(chunk_.temporaries, static_cast<std::uint16_t>(place + 1));
    return static_cast<std::uint16_t>(bytecode::first_temporary + place);
  }

  std::uint16_t pop() {
    const std::uint16_t index = stack_.back();
    stack_.pop_back();
    return index;
  }

  // Values.

  /// Emits what computes the next value on the stack.
  void compute(Op op, std::uint16_t b = 0, std::uint16_t c = 0, std::uint16_t d = 0) {
    const std::uint16_t to = temporary(stack_.size());
    emit(op, to, b, c, d);
    stack_.push_back(to);
  }

  /// Combines the two topmost values.
  void combine(Operator written) {
    const std::uint16_t right = pop();
    const std::uint16_t left = pop();
    const auto x = constant_in(left);
    const auto y = constant_in(right);
    if (const auto value = x && y ? bytecode::calculate(written, *x, *y) : std::nullopt) {
      stack_.push_back(constant(*value));
      return;
    }
    const Op op = operations[static_cast<std::size_t>(written)];
    if (y && *y > 1 && (op == Op::Divide || op == Op::Remainder))
      divide_by_constant(op, left, right, static_cast<std::uint32_t>(*y));
    else if (!(op == Op::Add && join(op, right, left)) && !join(op, left, right))
      compute(op, left, right);
  }

  void divide_by_constant(Op op, std::uint16_t left, std::uint16_t right, std::uint32_t divisor) {
    const bool quotient = op == Op::Divide;
    if (std::has_single_bit(divisor))
      compute(quotient ? Op::DivideByPower : Op::RemainderByPower, left, right,
              static_cast<std::uint16_t>(std::countr_zero(divisor)));
    else
      compute(quotient ? Op::DivideBy : Op::RemainderBy, left, right);
  }

  /// Where the value on the right was computed last: both operations in one instruction, if any.
  bool join(Op op, std::uint16_t left, std::uint16_t right) {
    constexpr std::array rows{std::array{Op::Multiply, Op::Add, Op::MultiplyAdd},
                              std::array{Op::DivideBy, Op::Subtract, Op::DivideSubtract},
                              std::array{Op::RemainderBy, Op::Add, Op::RemainderAdd}};
    for (const auto& [first, second, both] : rows)
      if (op == second && is_last(first, right, here())) {
        const auto last = chunk_.code.back();
        chunk_.code.pop_back();
        compute(both, last.b, last.c, left);
        return true;
      }
    return false;
  }

  /// Whether a temporary has been computed by the last instruction before `end`, which is an `op`.
  bool is_last(Op op, std::uint16_t to, std::uint32_t end) const {
    return is_temporary(to) && chunk_.code[end - 1].op == op && chunk_.code[end - 1].a == to;
  }

  void negate() {
    const std::uint16_t operand = pop();
    stack_.insert(stack_.end(), {constant(0), operand});
    combine(Operator::Subtract);
  }

  /// The first node of the first level too many: it is noticed where that opens.
  std::uint32_t too_deep(std::uint32_t root) const {
    std::uint32_t found = none;
    for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i)
      if (program_.nodes[i].depth > spec::value_of(spec::Limit::ExpressionLevels))
        found = std::min(found, program_.nodes[i].first);
    return found;
  }

  /// Computes an expression: its register, which is also put on the stack. Nothing when it traps.
  std::optional<std::uint16_t> value(std::uint32_t root) {
    const std::uint32_t stop = too_deep(root);
    for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i) {
      if (i == stop) {
        trap(BasicError::ExpressionTooComplex);
        return std::nullopt;
      }
      const auto& node = program_.nodes[i];
      switch (node.kind) {
      case NodeKind::Number: stack_.push_back(constant(node.value)); break;
      case NodeKind::Letter: stack_.push_back(node.what); break;
      case NodeKind::Indexed: compute(Op::LoadElement); break;
      case NodeKind::System: compute(Op::ReadSystem, node.what); break;
      case NodeKind::Group: break;
      case NodeKind::Negate: negate(); break;
      case NodeKind::Binary: combine(static_cast<Operator>(node.what)); break;
      case NodeKind::Call: compute(functions[node.what], pop()); break;
      }
    }
    return stack_.back();
  }

  void move(std::uint16_t to, std::uint16_t from) {
    if (is_temporary(from))
      chunk_.code.back().a = to; // what was emitted last computed it
    else
      emit(Op::Copy, to, from);
  }

  /// Computes expressions into temporaries side by side: the first one; nothing when one traps.
  std::optional<std::uint16_t> side_by_side(std::span<const Item> items) {
    const std::size_t first = stack_.size();
    for (const auto& item : items) {
      const std::uint16_t place = temporary(stack_.size());
      if (!value(item.value))
        return std::nullopt;
      move(place, pop());
      stack_.push_back(place);
    }
    return static_cast<std::uint16_t>(bytecode::first_temporary + first);
  }

  bool is_leaf(std::uint32_t root) const {
    const auto kind = program_.nodes[root].kind;
    return kind == NodeKind::Number || kind == NodeKind::Letter;
  }

  // Lines.

  void statement(const StatementNode& node) {
    stack_.clear();
    if (node.error) {
      trap(*node.error);
      return;
    }
    const auto items = program_.items_of(node);
    switch (node.kind) {
    case Statement::Let: assign(program_.as<LetView>(node)); return;
    case Statement::If: decide(node); return;
    case Statement::For: begin_loop(program_.as<ForView>(node)); return;
    case Statement::Next: end_loop(program_.as<NextView>(node).variable); return;
    case Statement::Goto: branch(Op::Goto, program_.as<BranchView>(node)); return;
    case Statement::Gosub: branch(Op::Gosub, program_.as<BranchView>(node)); return;
    case Statement::Return: emit(Op::Return); return;
    case Statement::On:
      choose(node.spelling == Spelling::OnGosub ? Op::OnGosub : Op::OnGoto,
             program_.as<OnView>(node));
      return;
    case Statement::Print: print(items); return;
    case Statement::Input: input(program_.as<InputView>(node)); return;
    case Statement::Delay:
      if (const auto time = value(items[0].value))
        emit(Op::Delay, *time);
      return;
    case Statement::End: emit(Op::End); return;
    case Statement::Data: data(items); return;
    case Statement::Rstr: emit(Op::RestartData); return;
    case Statement::Read: read(items); return;
    case Statement::Random: emit(Op::Random); return;
    case Statement::Tron: emit(Op::Tron); return;
    case Statement::Troff: emit(Op::Troff); return;
    case Statement::Reset: emit(Op::Reset); return;
    // clang-format off
    case Statement::Rgb: case Statement::Ledc: case Statement::BackLed: case Statement::Goroll:
    case Statement::Heading: case Statement::Raw: case Statement::Locate: case Statement::Basflg:
    case Statement::Sleep: case Statement::Macrun: case Statement::Mackill:
      perform(node.kind, items); return;
      // clang-format on
    }
  }

  /// Sets a variable to a value.
  void store(const Item& variable, std::uint16_t from) {
    if (variable.kind == ItemKind::Letter)
      move(static_cast<std::uint16_t>(variable.value), from);
    else if (variable.kind == ItemKind::Indexed)
      emit(Op::StoreElement, from);
    else
      emit(Op::WriteSystem, static_cast<std::uint16_t>(variable.value), from);
  }

  void assign(const LetView& let) {
    const auto from = value(let.expression.value);
    if (!from)
      return;
    store(let.variable, *from);
    end_line();
  }

  /// `if … then v = x else v = y` where x and y can neither fail nor be noticed: both are computed
  /// and one is taken, so that the processor has no jump to guess.
  bool select(const StatementNode& node, Relation relation, std::uint16_t left,
              std::uint16_t right) {
    if (node.else_branch == none)
      return false;
    const auto& then = program_.statements[node.then_branch];
    const auto& otherwise = program_.statements[node.else_branch];
    if (then.kind != Statement::Let || then.error || otherwise.kind != Statement::Let ||
        otherwise.error)
      return false;
    const auto x = program_.as<LetView>(then);
    const auto y = program_.as<LetView>(otherwise);
    if (x.variable.kind != ItemKind::Letter || y.variable.kind != ItemKind::Letter ||
        x.variable.value != y.variable.value)
      return false;
    const Item values[] = {x.expression, y.expression};
    const std::uint32_t begin = here();
    const auto pair = side_by_side(values);
    const bool harmless =
        std::all_of(chunk_.code.begin() + begin, chunk_.code.end(), [](const auto& made) {
          return info(made.op).compiled == bytecode::Compiled::Wholly;
        });
    stack_.resize(2); // left and right
    if (!harmless) {
      chunk_.code.resize(begin);
      return false;
    }
    const auto to = static_cast<std::uint16_t>(x.variable.value);
    if (relation == Relation::Equal && constant_in(right) == 0 && is_last(Op::And, left, begin)) {
      const auto bits = chunk_.code[begin - 1];
      chunk_.code.erase(chunk_.code.begin() + begin - 1);
      emit(Op::SelectClear, to, bits.b, bits.c, *pair);
    } else {
      emit(with_relation(Op::SelectEqual, relation), to, left, right, *pair);
    }
    return true;
  }

  void branch(Op op, const BranchView& branch) {
    const std::uint32_t at = emit(op);
    if (lead_to(at, branch.target.value))
      chunk_.code[at].ends_line = op == Op::Goto;
    else
      chunk_.code[at] = {Op::Trap, false, spec::code(BasicError::BadLineNumber)};
  }

  void choose(Op op, const OnView& on) {
    const auto index = value(on.selector.value);
    if (!index)
      return;
    emit(op, *index, static_cast<std::uint16_t>(on.targets.size()));
    for (const auto& target : on.targets) {
      const std::uint32_t row = emit(Op::Target);
      if (!lead_to(row, target.value))
        chunk_.code[row].a = spec::code(BasicError::BadLineNumber);
    }
  }

  void begin_loop(const ForView& loop) {
    const auto start = value(loop.start.value);
    if (!start)
      return;
    const bool letter = loop.variable.kind == ItemKind::Letter;
    const auto variable = static_cast<std::uint16_t>(loop.variable.value);
    const bool simple =
        letter && is_leaf(loop.end.value) && (loop.step == nullptr || is_leaf(loop.step->value));
    if (!simple) // the start is assigned before end and step are evaluated
      store(loop.variable, *start);
    const auto end = value(loop.end.value);
    if (!end)
      return;
    const auto step = loop.step != nullptr ? value(loop.step->value) : constant(1);
    if (!step)
      return;
    if (letter)
      emit(Op::For, variable, simple ? *start : variable, *end, *step);
    else
      emit(Op::ForElement, 0, *end, *step);
  }

  void end_loop(const Item& variable) {
    const bool letter = variable.kind == ItemKind::Letter;
    emit(letter ? Op::Next : Op::NextElement, static_cast<std::uint16_t>(variable.value));
  }

  static Relation relation_of(const Comparison& comparison) {
    return static_cast<Relation>(comparison.relation.value);
  }

  /// Puts the registers of both sides on the stack. False when one traps.
  bool compare(const Comparison& comparison) {
    if (!value(comparison.left.value) || !value(comparison.right.value))
      return false;
    const auto left = stack_[stack_.size() - 2];
    const auto relation = relation_of(comparison);
    if (is_last(Op::RemainderByPower, left, here()) && constant_in(stack_.back()) == 0 &&
        (relation == Relation::Equal || relation == Relation::NotEqual)) {
      auto& last = chunk_.code.back(); // the remainder is 0 where the low bits are
      last = {Op::And, false, left, last.b, constant(*constant_in(last.c) - 1)};
    }
    return true;
  }

  void decide(const StatementNode& node) {
    const auto condition = program_.as<IfView>(node);
    // Both comparisons are evaluated before one is tested.
    if (!compare(condition.first) || (condition.second && !compare(*condition.second)))
      return;
    const auto& then = program_.statements[node.then_branch];
    const bool has_else = node.else_branch != none;
    const auto first = relation_of(condition.first);
    const auto last = relation_of(condition.last());
    if (!condition.second && select(node, first, stack_[0], stack_[1]))
      return;

    const bool either = condition.second && condition.joint->kind == ItemKind::Or;
    const std::uint32_t begin = here();
    if (condition.second)
      emit(with_relation(either ? Op::WhenEqual : Op::UnlessEqual, first), stack_[0], stack_[1]);
    const std::uint32_t end =
        emit(with_relation(Op::UnlessEqual, last), stack_[stack_.size() - 2], stack_.back());
    // `then goto` is part of the test where nothing else remains to be done.
    const bool jumps = !has_else && !either && then.kind == Statement::Goto && !then.error &&
                       lead_to(end, program_.as<BranchView>(then).target.value);
    const std::uint32_t then_part = here();
    if (jumps)
      chunk_.code[end].op = with_relation(Op::WhenEqual, last);
    else
      statement(then);
    const std::uint32_t skip = has_else ? leave_branch() : none;
    for (std::uint32_t at = begin; at <= end; ++at) {
      chunk_.code[at].target = here();
      chunk_.code[at].ends_line = !has_else;
    }
    if (either) {
      chunk_.code[begin].target = then_part;
      chunk_.code[begin].ends_line = false;
    }
    if (!has_else)
      return;
    statement(program_.statements[node.else_branch]);
    if (skip != none)
      chunk_.code[skip].target = here();
  }

  /// Behind a `then` that has an `else`: what falls through goes on at the next line. The
  /// instruction that leads there; none where nothing falls through.
  std::uint32_t leave_branch() {
    auto& last = chunk_.code.back();
    if (bytecode::info(last.op).ends != Ends::Either || last.op == Op::Goto)
      return none;
    last.ends_line = false;
    const std::uint32_t at = emit(Op::Goto);
    end_line();
    return at;
  }

  void print(std::span<const Item> items) {
    const bool open = !items.empty() && items.back().kind == ItemKind::Semicolon;
    for (const auto& item : items) {
      if (item.kind == ItemKind::Expression || item.kind == ItemKind::Character) {
        if (!value(item.value))
          return;
        emit(item.kind == ItemKind::Character ? Op::PrintCharacter : Op::PrintNumber, pop());
      } else if (item.kind == ItemKind::String) {
        text(program_.text_of(item.span));
      } else if (item.kind == ItemKind::Comma) {
        emit(Op::PrintBlank);
      } // of semicolons only the last one means something
    }
    emit(open ? Op::PrintOpen : Op::PrintLine);
  }

  void text(std::string_view quoted) {
    if (chunk_.texts.size() >= most_registers) {
      overflow_ = true;
      return;
    }
    emit(Op::PrintText, static_cast<std::uint16_t>(chunk_.texts.size()));
    chunk_.texts.emplace_back(quoted.substr(1, quoted.size() - 2));
  }

  void input(const InputView& input) {
    const auto variable = input.variable.kind == ItemKind::Letter
                              ? static_cast<std::uint16_t>(input.variable.value)
                              : bytecode::element_by_index;
    if (input.milliseconds == nullptr) {
      emit(Op::Input, variable);
      return;
    }
    const auto time = value(input.milliseconds->value);
    const auto fallback = time ? value(input.fallback->value) : std::nullopt;
    if (fallback)
      emit(Op::InputTimed, variable, *time, *fallback);
  }

  void data(std::span<const Item> items) {
    const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues));
    const auto kept = items.first(std::min(items.size(), most)); // more are ignored
    if (const auto first = side_by_side(kept))
      emit(Op::SetData, *first, static_cast<std::uint16_t>(kept.size()));
  }

  void read(std::span<const Item> items) {
    for (const auto& item : items) {
      compute(Op::ReadData);
      store(item, pop());
    }
    end_line();
  }

  void perform(Statement kind, std::span<const Item> items) {
    const auto first = side_by_side(items);
    if (!first)
      return;
    // Of no arguments the first is any register that there is.
    emit(Op::Perform, static_cast<std::uint16_t>(kind), items.empty() ? std::uint16_t{0} : *first,
         static_cast<std::uint16_t>(items.size()));
  }

  const Program& program_;
  Chunk chunk_;
  std::unordered_map<std::uint32_t, std::uint32_t> line_of_;
  std::unordered_map<std::int32_t, std::uint16_t> constants_;
  std::vector<std::uint32_t> begins_; ///< by line of the program: its instruction, or the next one
  std::vector<std::pair<std::uint32_t, std::uint32_t>> jumps_; ///< from instruction to line
  std::vector<std::uint16_t> stack_;
  bool overflow_ = false;
};

} // namespace

bytecode::Chunk generate(const Program& program) {
  return Generator(program).run();
}

} // namespace orb::compiler
