#include "compiler/generate.h"

#include "bytecode/arithmetic.h"
#include "bytecode/op.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <unordered_map>

namespace orb::compiler {

namespace {

using bytecode::Arithmetic;
using bytecode::Chunk;
using bytecode::Ends;
using bytecode::Glue;
using bytecode::Instruction;
using bytecode::Op;
using spec::BasicError;
using spec::Function;
using spec::Operator;
using spec::Relation;
using spec::Statement;

// The instruction table, looked up by what is wanted. Nothing where it has no such row.

std::optional<Op> calculation(Arithmetic op, Ends ends) {
#define ORB_CALC(name, sign)                                                                       \
  if (op == Arithmetic::name)                                                                      \
    return ends == Ends::Line ? Op::name##Line : Op::name;
#include "bytecode/op.def"
  return std::nullopt;
}

std::optional<Op> left_chain(Arithmetic first, Arithmetic second, Ends ends) {
#define ORB_LEFT(op1, s1, op2, s2)                                                                 \
  if (first == Arithmetic::op1 && second == Arithmetic::op2)                                       \
    return ends == Ends::Line ? Op::op1##Then##op2##Line : Op::op1##Then##op2;
#include "bytecode/op.def"
  return std::nullopt;
}

std::optional<Op> right_chain(Arithmetic first, Arithmetic second, Ends ends) {
#define ORB_RIGHT(op1, s1, op2, s2)                                                                \
  if (first == Arithmetic::op1 && second == Arithmetic::op2)                                       \
    return ends == Ends::Line ? Op::op1##Of##op2##Line : Op::op1##Of##op2;
#include "bytecode/op.def"
  return std::nullopt;
}

/// What a test does: If ends the line when it is not true, Unless jumps, Goto jumps when it is;
/// Select takes one of two values, AddGoto counts before it tests.
enum class Then : std::uint8_t { If, Unless, Goto, Select, AddGoto };

Op test(Relation relation, Then then) {
#define ORB_TEST(rel, sign)                                                                        \
  if (relation == Relation::rel)                                                                   \
    switch (then) {                                                                                \
    case Then::If: return Op::If##rel;                                                             \
    case Then::Unless: return Op::Unless##rel;                                                     \
    case Then::Goto: return Op::Goto##rel;                                                         \
    case Then::Select: return Op::Select##rel;                                                     \
    case Then::AddGoto: return Op::AddGoto##rel;                                                   \
    }
#include "bytecode/op.def"
  return Op::IfEqual;
}

std::optional<Op> calculated_test(Arithmetic op, Relation relation, Then then) {
#define ORB_CALC_TEST(name, s, rel, sign)                                                          \
  if (op == Arithmetic::name && relation == Relation::rel)                                         \
    switch (then) {                                                                                \
    case Then::If: return Op::If##name##rel;                                                       \
    case Then::Unless: return Op::Unless##name##rel;                                               \
    case Then::Goto: return Op::Goto##name##rel;                                                   \
    case Then::Select: return Op::Select##name##rel;                                               \
    case Then::AddGoto: break;                                                                     \
    }
#include "bytecode/op.def"
  return std::nullopt;
}

Op two_tests(Glue glue, Relation first, Relation second, Then then) {
#define ORB_TWO_TESTS(name, rel1, s1, rel2, s2)                                                    \
  if (glue == Glue::name && first == Relation::rel1 && second == Relation::rel2)                   \
    return then == Then::If ? Op::If##rel1##name##rel2 : Op::Unless##rel1##name##rel2;
#include "bytecode/op.def"
  return Op::IfEqualAndEqual;
}

/// The instruction that also does the `next` behind a line that ends with `op`.
std::optional<Op> with_next(Op op) {
#define ORB_CALC(name, sign)                                                                       \
  if (op == Op::name##Line)                                                                        \
    return Op::name##Next;
#define ORB_LEFT(op1, s1, op2, s2)                                                                 \
  if (op == Op::op1##Then##op2##Line)                                                              \
    return Op::op1##Then##op2##Next;
#define ORB_RIGHT(op1, s1, op2, s2)                                                                \
  if (op == Op::op1##Of##op2##Line)                                                                \
    return Op::op1##Of##op2##Next;
#include "bytecode/op.def"
  return std::nullopt;
}

Arithmetic arithmetic(Operator op) {
  switch (op) {
  case Operator::Multiply: return Arithmetic::Multiply;
  case Operator::Divide: return Arithmetic::Divide;
  case Operator::Remainder: return Arithmetic::Remainder;
  case Operator::ShiftLeft: return Arithmetic::ShiftLeft;
  case Operator::ShiftRight: return Arithmetic::ShiftRight;
  case Operator::Add: return Arithmetic::Add;
  case Operator::Subtract: return Arithmetic::Subtract;
  case Operator::And: return Arithmetic::And;
  case Operator::Or: return Arithmetic::Or;
  }
  return Arithmetic::Add;
}

/// Registers of constants get their final number when the temporaries have been counted.
constexpr std::uint16_t constant_mark = 0x8000;
/// Of temporaries, of constants and of texts.
constexpr std::uint16_t most_registers = 0x7F00;

/// A value that has been read in the text: a register, or a computation that has not been emitted
/// yet, so that it can become part of a larger instruction.
struct Value {
  enum class Kind : std::uint8_t {
    Register, ///< x
    Calc,     ///< x op1 y
    Left,     ///< (x op1 y) op2 z
    Right,    ///< x op1 (y op2 z)
    Element,  ///< Z
    System,   ///< system variable x
    Sqrt,     ///< of x
    Rnd,
    Abs
  };
  Kind kind = Kind::Register;
  Arithmetic op1{};
  Arithmetic op2{};
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  std::uint16_t z = 0;

  bool is_register() const { return kind == Kind::Register; }
};

class Generator {
public:
  explicit Generator(const Program& program) : program_(program) {}

  Chunk run() {
    find_lines();
    begins_.assign(program_.lines.size() + 1, 0);
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      begins_[i] = here();
      if (!line.has_statement())
        continue;
      const auto number = line.number <= 0xFFFF ? line.number : 0;
      chunk_.lines.push_back({static_cast<std::uint16_t>(number), here()});
      if (!indexed_pair(i) && !counting_pair(i)) {
        statement(program_.statements[line.statement]);
        join_next(i);
      }
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
                     std::uint16_t d = 0, std::uint16_t e = 0) {
    chunk_.code.push_back({op, a, b, c, d, e, 0});
    return here() - 1;
  }

  void find_lines() {
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number())
        line_of_.try_emplace(program_.lines[i].number, i); // of duplicates the first counts, A-26
  }

  /// Leads instruction `at` to a line; false where there is none of that number.
  bool lead_to(std::uint32_t at, std::uint32_t number) {
    const auto found = line_of_.find(number);
    if (found == line_of_.end())
      return false;
    jumps_.push_back({at, found->second});
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
      place(instruction.e, operands[4]);
    }
  }

  /// No text that fits a ball runs out of registers; of one that does, the line is a trap.
  void give_up(std::uint32_t begin) {
    overflow_ = false;
    chunk_.code.resize(begin);
    while (!jumps_.empty() && jumps_.back().at >= begin)
      jumps_.pop_back();
    emit(Op::Trap, spec::code(BasicError::ExpressionTooComplex));
    if (begin == 0)
      return;
    auto& before = chunk_.code[begin - 1];
    if (before.op == Op::IndexLoad || before.op == Op::IndexStore) // its second line is gone
      before = {Op::AddLine, bytecode::index_variable, before.b, before.c, 0, 0, 0};
    else if (bytecode::info(before.op).ends == Ends::Lines)
      before = {Op::AddLine, before.a, before.b, before.c, 0, 0, 0};
  }

  // Registers.

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

  std::uint16_t temporary() {
    if (next_temporary_ >= most_registers) {
      overflow_ = true;
      return bytecode::first_temporary;
    }
    const std::uint16_t index = next_temporary_++;
    chunk_.temporaries =
        std::max(chunk_.temporaries,
                 static_cast<std::uint16_t>(next_temporary_ - bytecode::first_temporary));
    return index;
  }

  static bool is_temporary(std::uint16_t index) {
    return index >= bytecode::first_temporary && index < constant_mark;
  }

  // Values.

  /// Whether emitting it can stop the program, or clears what it reads.
  bool has_effect(const Value& value) const {
    const auto faults = [&](Arithmetic op, std::uint16_t right) {
      if (op == Arithmetic::Divide || op == Arithmetic::Remainder)
        return true;
      if (op == Arithmetic::ShiftLeft || op == Arithmetic::ShiftRight) {
        const auto count = constant_in(right);
        return !count || *count < 0 || *count > spec::value_of(spec::Limit::GreatestShift);
      }
      return false;
    };
    switch (value.kind) {
    case Value::Kind::Register:
    case Value::Kind::Left: // of operators that cannot fault
    case Value::Kind::Right:
    case Value::Kind::Abs: return false;
    case Value::Kind::Calc: return faults(value.op1, value.y);
    case Value::Kind::Element:
    case Value::Kind::System:
    case Value::Kind::Sqrt:
    case Value::Kind::Rnd: return true;
    }
    return true;
  }

  /// The cheapest way to compute a Calc: powers of two need no reciprocal.
  Arithmetic by_power(const Value& value) const {
    const auto divisor = constant_in(value.y);
    if (!divisor || *divisor < 2 || (*divisor & (*divisor - 1)) != 0)
      return value.op1;
    if (value.op1 == Arithmetic::DivideBy)
      return Arithmetic::DivideByPower;
    if (value.op1 == Arithmetic::RemainderBy)
      return Arithmetic::RemainderByPower;
    return value.op1;
  }

  /// A test of a Calc in one instruction, where there is one.
  std::optional<Op> fused_test(const Value& value, Relation relation, Then then) const {
    if (value.kind != Value::Kind::Calc)
      return std::nullopt;
    const auto best = calculated_test(by_power(value), relation, then);
    return best ? best : calculated_test(value.op1, relation, then);
  }

  void emit(const Value& value, std::uint16_t to, Ends ends) {
    const bool line = ends == Ends::Line;
    switch (value.kind) {
    case Value::Kind::Register: emit(line ? Op::CopyLine : Op::Copy, to, value.x); return;
    case Value::Kind::Calc: emit(*calculation(by_power(value), ends), to, value.x, value.y); return;
    case Value::Kind::Left:
      emit(*left_chain(value.op1, value.op2, ends), to, value.x, value.y, value.z);
      return;
    case Value::Kind::Right:
      emit(*right_chain(value.op1, value.op2, ends), to, value.x, value.y, value.z);
      return;
    case Value::Kind::Element: emit(line ? Op::LoadElementLine : Op::LoadElement, to); return;
    case Value::Kind::System: emit(Op::ReadSystem, to, value.x); break;
    case Value::Kind::Sqrt: emit(Op::Sqrt, to, value.x); break;
    case Value::Kind::Rnd: emit(Op::Rnd, to, value.x); break;
    case Value::Kind::Abs: emit(Op::Abs, to, value.x); break;
    }
    if (line)
      emit(Op::EndLine);
  }

  /// Everything on the stack below `top` that can be noticed happens first: values take effect in
  /// the order of the text.
  void settle_below(std::size_t top) {
    for (std::size_t i = 0; i < top; ++i)
      if (has_effect(stack_[i]))
        materialize(i);
  }

  /// Emits entry `i` of the stack into a register of its own.
  std::uint16_t materialize(std::size_t i) {
    if (stack_[i].is_register())
      return stack_[i].x;
    if (has_effect(stack_[i]))
      settle_below(i);
    const Value value = stack_[i];
    // Only the topmost value may take over its operands' temporary.
    std::uint16_t to = 0;
    for (const std::uint16_t operand : {value.x, value.y, value.z})
      if (i + 1 == stack_.size() && uses(value, operand) && is_temporary(operand) &&
          (to == 0 || operand < to))
        to = operand;
    if (to == 0) {
      to = temporary();
    } else {
      // Free are those behind it, and behind what settling put there for the values below.
      std::uint16_t last = to;
      for (std::size_t below = 0; below < i; ++below)
        for (const std::uint16_t operand : {stack_[below].x, stack_[below].y, stack_[below].z})
          if (uses(stack_[below], operand) && is_temporary(operand))
            last = std::max(last, operand);
      next_temporary_ = static_cast<std::uint16_t>(last + 1);
    }
    emit(value, to, Ends::Value);
    stack_[i] = {Value::Kind::Register, {}, {}, to, 0, 0};
    return to;
  }

  static bool uses(const Value& value, std::uint16_t index) {
    switch (value.kind) {
    case Value::Kind::Element:
    case Value::Kind::System: return false;
    case Value::Kind::Register:
    case Value::Kind::Sqrt:
    case Value::Kind::Rnd:
    case Value::Kind::Abs: return index == value.x;
    case Value::Kind::Calc: return index == value.x || index == value.y;
    case Value::Kind::Left:
    case Value::Kind::Right: return index == value.x || index == value.y || index == value.z;
    }
    return false;
  }

  void push_register(std::uint16_t index) {
    stack_.push_back({Value::Kind::Register, {}, {}, index, 0, 0});
  }

  void trap(BasicError error) {
    settle_below(stack_.size());
    emit(Op::Trap, spec::code(error));
  }

  std::optional<std::int32_t> folded(Operator op, std::int32_t x, std::int32_t y) const {
    switch (op) {
    case Operator::Multiply: return bytecode::multiply(x, y);
    case Operator::Add: return bytecode::add(x, y);
    case Operator::Subtract: return bytecode::subtract(x, y);
    case Operator::And: return x & y;
    case Operator::Or: return x | y;
    case Operator::Divide:
    case Operator::Remainder:
    case Operator::ShiftLeft:
    case Operator::ShiftRight: return std::nullopt; // may fault
    }
    return std::nullopt;
  }

  /// Combines the two topmost values.
  void combine(Operator written) {
    const std::size_t left = stack_.size() - 2;
    const std::size_t right = left + 1;
    Arithmetic op = arithmetic(written);

    if (stack_[left].is_register() && stack_[right].is_register()) {
      const auto x = constant_in(stack_[left].x);
      const auto y = constant_in(stack_[right].x);
      if (x && y) {
        if (const auto value = folded(written, *x, *y)) {
          stack_.resize(left);
          push_register(constant(*value));
          return;
        }
      }
    }
    if (stack_[right].is_register()) {
      const auto divisor = constant_in(stack_[right].x);
      if (divisor && *divisor > 1 && op == Arithmetic::Divide)
        op = Arithmetic::DivideBy;
      if (divisor && *divisor > 1 && op == Arithmetic::Remainder)
        op = Arithmetic::RemainderBy;
    }

    Value value{Value::Kind::Calc, op, {}, 0, 0, 0};
    if (stack_[left].kind == Value::Kind::Calc && stack_[right].is_register() &&
        left_chain(stack_[left].op1, op, Ends::Value)) {
      const auto& inner = stack_[left];
      value = {Value::Kind::Left, inner.op1, op, inner.x, inner.y, stack_[right].x};
    } else if (stack_[right].kind == Value::Kind::Calc &&
               right_chain(op, stack_[right].op1, Ends::Value)) {
      if (!stack_[left].is_register())
        materialize(left);
      const auto& inner = stack_[right];
      value = {Value::Kind::Right, op, inner.op1, stack_[left].x, inner.x, inner.y};
    } else {
      if (!stack_[left].is_register())
        materialize(left);
      if (!stack_[right].is_register())
        materialize(right);
      value.x = stack_[left].x;
      value.y = stack_[right].x;
    }
    stack_.resize(left);
    stack_.push_back(value);
  }

  /// Reads the expression whose root is `root` onto the stack. False when it traps.
  bool expression(std::uint32_t root) {
    const std::uint32_t first = program_.nodes[root].first;
    // Too many levels are noticed where the first level too many opens.
    std::uint32_t too_deep = none;
    for (std::uint32_t i = first; i <= root; ++i)
      if (program_.nodes[i].depth > spec::value_of(spec::Limit::ExpressionLevels))
        too_deep = std::min(too_deep, program_.nodes[i].first);

    for (std::uint32_t i = first; i <= root; ++i) {
      if (i == too_deep) {
        trap(BasicError::ExpressionTooComplex);
        return false;
      }
      const auto& node = program_.nodes[i];
      switch (node.kind) {
      case NodeKind::Number: push_register(constant(node.value)); break;
      case NodeKind::Letter: push_register(node.what); break;
      case NodeKind::Indexed: stack_.push_back({Value::Kind::Element, {}, {}, 0, 0, 0}); break;
      case NodeKind::System:
        stack_.push_back({Value::Kind::System, {}, {}, node.what, 0, 0});
        break;
      case NodeKind::Group: break;
      case NodeKind::Negate: negate(); break;
      case NodeKind::Binary: combine(static_cast<Operator>(node.what)); break;
      case NodeKind::Call: call(static_cast<Function>(node.what)); break;
      }
    }
    return true;
  }

  void negate() {
    const std::uint16_t operand = materialize(stack_.size() - 1);
    stack_.pop_back();
    if (const auto value = constant_in(operand))
      push_register(constant(bytecode::subtract(0, *value)));
    else
      stack_.push_back({Value::Kind::Calc, Arithmetic::Subtract, {}, constant(0), operand, 0});
  }

  void call(Function function) {
    const std::uint16_t operand = materialize(stack_.size() - 1);
    stack_.pop_back();
    const auto kind = function == Function::Sqrt  ? Value::Kind::Sqrt
                      : function == Function::Rnd ? Value::Kind::Rnd
                                                  : Value::Kind::Abs;
    stack_.push_back({kind, {}, {}, operand, 0, 0});
  }

  /// The value of an expression in whatever register it is in; nothing when it traps.
  std::optional<std::uint16_t> in_register(std::uint32_t root) {
    if (!expression(root))
      return std::nullopt;
    const std::uint16_t index = materialize(stack_.size() - 1);
    stack_.pop_back();
    return index;
  }

  /// Evaluates an expression into a given register. False when it traps.
  bool into(std::uint32_t root, std::uint16_t to, Ends ends) {
    const std::uint16_t free = next_temporary_;
    if (!expression(root))
      return false;
    emit(stack_.back(), to, ends);
    stack_.pop_back();
    next_temporary_ = free;
    return true;
  }

  // Lines.

  void statement(const StatementNode& node) {
    stack_.clear();
    next_temporary_ = bytecode::first_temporary;
    if (node.error) {
      emit(Op::Trap, spec::code(*node.error));
      return;
    }
    const auto items = program_.items_of(node);
    switch (node.kind) {
    case Statement::Let: assign(program_.as<LetView>(node)); return;
    case Statement::If: decide(node); return;
    case Statement::For: begin_loop(program_.as<ForView>(node)); return;
    case Statement::Next: end_loop(program_.as<NextView>(node).variable); return;
    case Statement::Goto: branch(Op::Goto, target_of(node)); return;
    case Statement::Gosub: branch(Op::Gosub, target_of(node)); return;
    case Statement::Return: emit(Op::Return); return;
    case Statement::On:
      choose(node.spelling == Spelling::OnGosub ? Op::OnGosub : Op::OnGoto,
             program_.as<OnView>(node));
      return;
    case Statement::Print: print(items); return;
    case Statement::Input: input(program_.as<InputView>(node)); return;
    case Statement::Delay:
      if (const auto time = in_register(items[0].value))
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
    case Statement::Rgb:
    case Statement::Ledc:
    case Statement::BackLed:
    case Statement::Goroll:
    case Statement::Heading:
    case Statement::Raw:
    case Statement::Locate:
    case Statement::Basflg:
    case Statement::Sleep:
    case Statement::Macrun:
    case Statement::Mackill: perform(node.kind, items); return;
    }
  }

  /// Sets a variable to a register, within the line.
  void store(const Item& variable, std::uint16_t from) {
    if (variable.kind == ItemKind::Letter)
      emit(Op::Copy, static_cast<std::uint16_t>(variable.value), from);
    else if (variable.kind == ItemKind::Indexed)
      emit(Op::StoreElement, from);
    else
      emit(Op::WriteSystem, static_cast<std::uint16_t>(variable.value), from);
  }

  void assign(const LetView& let) {
    const auto& variable = let.variable;
    const auto root = let.expression.value;
    if (variable.kind == ItemKind::Letter) {
      into(root, static_cast<std::uint16_t>(variable.value), Ends::Line);
      return;
    }
    const auto from = in_register(root);
    if (!from)
      return;
    if (variable.kind == ItemKind::Indexed) {
      emit(Op::StoreElementLine, *from);
    } else {
      store(variable, *from);
      emit(Op::EndLine);
    }
  }

  std::optional<std::uint16_t> leaf(std::uint32_t root) {
    const auto& node = program_.nodes[root];
    if (node.kind == NodeKind::Number)
      return constant(node.value);
    if (node.kind == NodeKind::Letter)
      return node.what;
    return std::nullopt;
  }

  struct Sum {
    std::uint16_t b = 0;
    std::uint16_t c = 0;
  };

  /// `b`, `b + c` or `b - 3`, of variables and numbers; everything as a sum.
  std::optional<Sum> sum(std::uint32_t root) {
    if (const auto b = leaf(root))
      return Sum{*b, constant(0)};
    const auto& node = program_.nodes[root];
    if (node.kind != NodeKind::Binary || root - node.first != 2)
      return std::nullopt;
    const auto b = leaf(node.first);
    const auto c = leaf(root - 1);
    if (!b || !c)
      return std::nullopt;
    const auto op = static_cast<Operator>(node.what);
    if (op == Operator::Add)
      return Sum{*b, *c};
    if (op == Operator::Subtract && constant_in(*c))
      return Sum{*b, constant(bytecode::subtract(0, *constant_in(*c)))};
    return std::nullopt;
  }

  /// The statement of `line`, when it is one of that kind that parsed.
  const StatementNode* statement_at(std::uint32_t line, Statement kind) const {
    if (line >= program_.lines.size() || !program_.lines[line].has_statement())
      return nullptr;
    const auto& node = program_.statements[program_.lines[line].statement];
    return node.kind == kind && !node.error ? &node : nullptr;
  }

  static Relation relation_of(const Comparison& comparison) {
    return static_cast<Relation>(comparison.relation.value);
  }

  /// The line number behind `goto` or `gosub`.
  std::uint32_t target_of(const StatementNode& node) const {
    return program_.as<BranchView>(node).target.value;
  }

  /// Whether it is a `goto` to a line that there is.
  bool leads_to_line(const StatementNode& node) const {
    return node.kind == Statement::Goto && !node.error && line_of_.contains(target_of(node));
  }

  std::uint32_t following(std::uint32_t line) const {
    do
      ++line;
    while (line < program_.lines.size() && !program_.lines[line].has_statement());
    return line;
  }

  // Two lines that often follow each other become one instruction. The second line is also
  // generated by itself: branches lead to it, and the machine may have to stop between the two.

  /// `Y = b + c`, then a line that moves Z.
  bool indexed_pair(std::uint32_t line) {
    const auto* first = statement_at(line, Statement::Let);
    const auto* second = statement_at(following(line), Statement::Let);
    if (!first || !second)
      return false;
    const auto y = program_.as<LetView>(*first);
    if (y.variable.kind != ItemKind::Letter || y.variable.value != bytecode::index_variable)
      return false;
    const auto z = program_.as<LetView>(*second);
    const bool loads = z.variable.kind == ItemKind::Letter &&
                       program_.nodes[z.expression.value].kind == NodeKind::Indexed;
    const bool stores = z.variable.kind == ItemKind::Indexed && leaf(z.expression.value);
    if (!loads && !stores)
      return false;
    const auto index = sum(y.expression.value);
    if (!index)
      return false;
    if (loads)
      emit(Op::IndexLoad, static_cast<std::uint16_t>(z.variable.value), index->b, index->c);
    else
      emit(Op::IndexStore, *leaf(z.expression.value), index->b, index->c);
    return true;
  }

  /// `v = b + c`, then `if d rel e then goto n`.
  bool counting_pair(std::uint32_t line) {
    const auto* first = statement_at(line, Statement::Let);
    const auto* second = statement_at(following(line), Statement::If);
    if (!first || !second || second->else_branch != none)
      return false;
    const auto& then = program_.statements[second->then_branch];
    const auto count = program_.as<LetView>(*first);
    const auto condition = program_.as<IfView>(*second);
    if (count.variable.kind != ItemKind::Letter || condition.second || !leads_to_line(then))
      return false;
    const auto left = leaf(condition.first.left.value);
    const auto right = leaf(condition.first.right.value);
    if (!left || !right)
      return false;
    const auto value = sum(count.expression.value);
    if (!value)
      return false;
    const auto at =
        emit(test(relation_of(condition.first), Then::AddGoto),
             static_cast<std::uint16_t>(count.variable.value), value->b, value->c, *left, *right);
    lead_to(at, target_of(then));
    return true;
  }

  /// An assignment that has just been generated, then `next`.
  void join_next(std::uint32_t line) {
    const auto* next = statement_at(following(line), Statement::Next);
    if (!next || !statement_at(line, Statement::Let))
      return;
    const auto& variable = program_.as<NextView>(*next).variable;
    const auto joined = with_next(chunk_.code.back().op);
    if (variable.kind != ItemKind::Letter || !joined)
      return;
    chunk_.code.back().op = *joined;
    chunk_.code.back().e = static_cast<std::uint16_t>(variable.value);
  }

  /// Whether evaluating can neither fail nor be noticed: numbers, A to Y, and what cannot go wrong.
  bool harmless(std::uint32_t root) const {
    for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i) {
      const auto& node = program_.nodes[i];
      if (node.depth > spec::value_of(spec::Limit::ExpressionLevels))
        return false;
      switch (node.kind) {
      case NodeKind::Number:
      case NodeKind::Letter:
      case NodeKind::Group:
      case NodeKind::Negate: break;
      case NodeKind::Indexed:
      case NodeKind::System:
      case NodeKind::Call: return false;
      case NodeKind::Binary: {
        const auto op = static_cast<Operator>(node.what);
        const auto& right = program_.nodes[i - 1];
        const bool by_constant = right.kind == NodeKind::Number && right.value > 1;
        if (op == Operator::ShiftLeft || op == Operator::ShiftRight ||
            ((op == Operator::Divide || op == Operator::Remainder) && !by_constant))
          return false;
        break;
      }
      }
    }
    return true;
  }

  /// `if … then v = x else v = y` where x and y are harmless: both are computed and one is taken,
  /// so that the processor has no jump to guess. The condition is on the stack.
  bool select(const StatementNode& node, Relation relation) {
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
        x.variable.value != y.variable.value || !harmless(x.expression.value) ||
        !harmless(y.expression.value))
      return false;
    const std::uint16_t pair = temporary();
    const std::uint16_t second = temporary();
    into(x.expression.value, pair, Ends::Value);
    into(y.expression.value, second, Ends::Value);
    const auto to = static_cast<std::uint16_t>(x.variable.value);
    const std::uint16_t right = stack_[1].x;
    const Value left = stack_[0];
    const auto fused = fused_test(left, relation, Then::Select);
    if (fused) {
      emit(*fused, to, left.x, left.y, right, pair);
    } else {
      const std::uint16_t condition = materialize(0);
      emit(test(relation, Then::Select), to, condition, right, pair);
    }
    return true;
  }

  void branch(Op op, std::uint32_t number) {
    const std::uint32_t at = emit(op);
    if (!lead_to(at, number))
      chunk_.code[at] = {Op::Trap, spec::code(BasicError::BadLineNumber), 0, 0, 0, 0, 0};
  }

  void choose(Op op, const OnView& on) {
    const auto index = in_register(on.selector.value);
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
    const auto step_of = [&]() -> std::optional<std::uint16_t> {
      return loop.step != nullptr ? in_register(loop.step->value) : constant(1);
    };
    const auto start = in_register(loop.start.value);
    if (!start)
      return;
    const bool letter = loop.variable.kind == ItemKind::Letter;
    const auto variable = static_cast<std::uint16_t>(loop.variable.value);
    const bool simple =
        letter && leaf(loop.end.value) && (loop.step == nullptr || leaf(loop.step->value));
    if (!simple) // the start is assigned before end and step are evaluated
      store(loop.variable, *start);
    const auto end = in_register(loop.end.value);
    const auto step = end ? step_of() : std::nullopt;
    if (!step)
      return;
    if (letter)
      emit(Op::For, variable, simple ? *start : variable, *end, *step);
    else
      emit(Op::ForElement, 0, *end, *step);
  }

  void end_loop(const Item& variable) {
    if (variable.kind == ItemKind::Letter)
      emit(Op::Next, static_cast<std::uint16_t>(variable.value));
    else
      emit(Op::NextElement);
  }

  void decide(const StatementNode& node) {
    const auto condition = program_.as<IfView>(node);
    const auto& then = program_.statements[node.then_branch];
    const bool has_else = node.else_branch != none;
    const auto kind = has_else ? Then::Unless : Then::If;
    std::uint32_t at = 0;
    if (!condition.second) {
      if (!expression(condition.first.left.value) || !expression(condition.first.right.value))
        return;
      const auto relation = relation_of(condition.first);
      materialize(1);
      if (select(node, relation))
        return;
      const std::uint16_t right = stack_[1].x;
      // `then goto` is part of the test where nothing else remains to be done.
      const bool jumps = !has_else && leads_to_line(then);
      const auto shape = jumps ? Then::Goto : kind;
      const Value left = stack_[0];
      const auto fused = fused_test(left, relation, shape);
      if (fused) {
        at = emit(*fused, left.x, left.y, right);
      } else {
        stack_.pop_back();
        const std::uint16_t x = materialize(0);
        at = emit(test(relation, shape), x, right);
      }
      if (jumps) {
        lead_to(at, target_of(then));
        return;
      }
    } else {
      // Both relations are evaluated.
      std::array<std::uint16_t, 4> values{};
      const std::array operands{&condition.first.left, &condition.first.right,
                                &condition.second->left, &condition.second->right};
      for (std::size_t i = 0; i < operands.size(); ++i) {
        const auto value = in_register_apart(operands[i]->value);
        if (!value)
          return;
        values[i] = *value;
      }
      const auto glue = condition.joint->kind == ItemKind::And ? Glue::And : Glue::Or;
      at = emit(two_tests(glue, relation_of(condition.first), relation_of(*condition.second), kind),
                values[0], values[1], values[2], values[3]);
    }
    statement(then);
    if (!has_else) {
      chunk_.code[at].target = here();
      return;
    }
    const std::uint32_t skip = emit(Op::Skip);
    chunk_.code[at].target = here();
    statement(program_.statements[node.else_branch]);
    chunk_.code[skip].target = here();
  }

  /// Like in_register, leaving the value on the stack so that later ones do not take its place.
  std::optional<std::uint16_t> in_register_apart(std::uint32_t root) {
    if (!expression(root))
      return std::nullopt;
    return materialize(stack_.size() - 1);
  }

  void print(std::span<const Item> items) {
    const bool open = !items.empty() && items.back().kind == ItemKind::Semicolon;
    for (const auto& item : items) {
      switch (item.kind) {
      case ItemKind::Expression:
      case ItemKind::Character: {
        next_temporary_ = bytecode::first_temporary;
        const auto value = in_register(item.value);
        if (!value)
          return;
        emit(item.kind == ItemKind::Character ? Op::PrintCharacter : Op::PrintNumber, *value);
        break;
      }
      case ItemKind::String: {
        const auto quoted = program_.text_of(item.span);
        if (chunk_.texts.size() >= most_registers) {
          overflow_ = true;
          return;
        }
        emit(Op::PrintText, static_cast<std::uint16_t>(chunk_.texts.size()));
        chunk_.texts.emplace_back(quoted.substr(1, quoted.size() - 2));
        break;
      }
      case ItemKind::Comma: emit(Op::PrintBlank); break;
      case ItemKind::Semicolon: // only the last one means something
      case ItemKind::Letter:
      case ItemKind::Indexed:
      case ItemKind::System:
      case ItemKind::Target:
      case ItemKind::Relation:
      case ItemKind::And:
      case ItemKind::Or: break;
      }
    }
    emit(open ? Op::PrintOpen : Op::PrintLine);
  }

  void input(const InputView& input) {
    const auto variable = input.variable.kind == ItemKind::Letter
                              ? static_cast<std::uint16_t>(input.variable.value)
                              : bytecode::element_by_index;
    if (input.milliseconds == nullptr) {
      emit(Op::Input, variable);
      return;
    }
    const auto time = in_register_apart(input.milliseconds->value);
    const auto fallback = time ? in_register_apart(input.fallback->value) : std::nullopt;
    if (fallback)
      emit(Op::InputTimed, variable, *time, *fallback);
  }

  /// Evaluates items into registers side by side; nothing when one traps.
  std::optional<std::uint16_t> side_by_side(std::span<const Item> items) {
    const std::uint16_t first = next_temporary_;
    for (std::size_t i = 0; i < items.size(); ++i)
      temporary();
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!into(items[i].value, static_cast<std::uint16_t>(first + i), Ends::Value))
        return std::nullopt;
    return first;
  }

  void data(std::span<const Item> items) {
    const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues));
    const auto kept = items.first(std::min(items.size(), most)); // more are ignored
    if (const auto first = side_by_side(kept))
      emit(Op::SetData, *first, static_cast<std::uint16_t>(kept.size()));
  }

  void read(std::span<const Item> items) {
    for (const auto& item : items) {
      if (item.kind == ItemKind::Letter) {
        emit(Op::ReadData, static_cast<std::uint16_t>(item.value));
      } else {
        next_temporary_ = bytecode::first_temporary;
        const std::uint16_t value = temporary();
        emit(Op::ReadData, value);
        store(item, value);
      }
    }
    emit(Op::EndLine);
  }

  void perform(Statement kind, std::span<const Item> items) {
    if (const auto first = side_by_side(items))
      emit(Op::Perform, static_cast<std::uint16_t>(kind), *first,
           static_cast<std::uint16_t>(items.size()));
  }

  struct Jump {
    std::uint32_t at;   ///< instruction
    std::uint32_t line; ///< index into the program's lines
  };

  const Program& program_;
  Chunk chunk_;
  std::unordered_map<std::uint32_t, std::uint32_t> line_of_;
  std::unordered_map<std::int32_t, std::uint16_t> constants_;
  std::vector<std::uint32_t> begins_; ///< by line of the program: its instruction, or the next one
  std::vector<Jump> jumps_;
  std::vector<Value> stack_;
  std::uint16_t next_temporary_ = bytecode::first_temporary;
  bool overflow_ = false;
};

} // namespace

bytecode::Chunk generate(const Program& program) {
  return Generator(program).run();
}

} // namespace orb::compiler
