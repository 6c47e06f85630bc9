#include "run/cause/places.h"

#include "bytecode/op.h"
#include "spec/limits.h"

#include <fmt/format.h>
#include <vector>

namespace orb::run {
namespace {

using bytecode::Op;
using compiler::Item;
using compiler::ItemKind;
using compiler::NodeKind;
using compiler::StatementNode;
using spec::BasicError;
using spec::Statement;

using Kind = SuspectKind;

// --- places of a line, in order of evaluation ----------------------------------------------------

class Places {
public:
  explicit Places(const compiler::Program& program) : program_(program) {}

  std::vector<Suspect> of(const StatementNode& whole) {
    for (const auto& statement : program_.whole(whole))
      if (!statement.error)
        look(statement);
    return std::move(found_);
  }

private:
  void look(const StatementNode& statement) {
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind == ItemKind::Expression || item.kind == ItemKind::Character)
        look(item.value);
      else if (item.kind == ItemKind::Indexed)
        index();
    }
    if (statement.kind == Statement::Let)
      timer(program_.as<compiler::LetView>(statement));
    else if (statement.kind == Statement::On)
      selector(program_.as<compiler::OnView>(statement));
    else if (statement.kind == Statement::For)
      step(program_.as<compiler::ForView>(statement));
    else
      arguments(statement);
  }

  void look(std::uint32_t root) {
    for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i) {
      const auto& node = program_.nodes[i];
      if (node.kind == NodeKind::Indexed)
        index();
      else if (node.kind == NodeKind::Call)
        operand(static_cast<spec::Function>(node.what), i - 1);
      else if (node.kind == NodeKind::Binary)
        right_side(static_cast<spec::Operator>(node.what), i - 1);
    }
  }

  void index() {
    found_.push_back(
        {.kind = Kind::Index, .name = "Y", .least = 1, .greatest = bytecode::element_count});
  }

  void operand(spec::Function function, std::uint32_t root) {
    const auto& row = spec::info(function);
    if (row.least > INT32_MIN)
      found_.push_back({.kind = Kind::Operand,
                        .function = function,
                        .name = fmt::format("the operand of `{}`", row.word),
                        .least = row.least,
                        .greatest = row.greatest,
                        .root = root});
  }

  void right_side(spec::Operator op, std::uint32_t root) {
    const auto& node = program_.nodes[root];
    const bool safe = node.kind == NodeKind::Number && node.value > 1; // divides without a check
    if ((op == spec::Operator::Divide || op == spec::Operator::Remainder) && !safe)
      found_.push_back({.kind = Kind::Divisor, .name = "the divisor", .root = root});
    if (op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight)
      found_.push_back({.kind = Kind::Shift,
                        .name = "the shift",
                        .greatest = spec::value_of(spec::Limit::GreatestShift),
                        .root = root});
  }

  void timer(const compiler::LetView& let) {
    if (let.variable.kind != ItemKind::System)
      return;
    const auto& row = spec::info(static_cast<spec::Variable>(let.variable.value));
    if (row.access == spec::Access::ReadWrite)
      found_.push_back({.kind = Kind::Timer,
                        .name = std::string(row.word),
                        .least = row.least,
                        .greatest = row.greatest,
                        .root = let.expression.value});
  }

  void selector(const compiler::OnView& on) {
    found_.push_back({.kind = Kind::Selector,
                      .name = "the number after `on`",
                      .least = 1,
                      .greatest = static_cast<std::int64_t>(on.targets.size()),
                      .root = on.selector.value});
  }

  void step(const compiler::ForView& loop) {
    if (loop.step != nullptr)
      found_.push_back({.kind = Kind::Step, .name = "the step", .root = loop.step->value});
  }

  void arguments(const StatementNode& statement) {
    const auto parameters = spec::info(statement.kind).parameters();
    std::size_t n = 0;
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind != ItemKind::Expression || n == parameters.size())
        continue;
      const auto& row = parameters[n];
      found_.push_back({.kind = Kind::Argument,
                        .statement = statement.kind,
                        .argument = n,
                        .name = std::string(row.name),
                        .least = row.least,
                        .greatest = row.greatest,
                        .turns = row.unit == "deg",
                        .root = item.value});
      ++n;
    }
  }

  const compiler::Program& program_;
  std::vector<Suspect> found_;
};

// --- what the machine knows ----------------------------------------------------------------------

/// Returns the place that an instruction implements; nullopt if no value can make it fail.
std::optional<Suspect> place_of(const bytecode::Instruction& instruction) {
  const auto argument_of = [](Statement statement) {
    return Suspect{.kind = Kind::Argument, .statement = statement};
  };
  // clang-format off
  if (instruction.op == Op::Perform) return argument_of(static_cast<Statement>(instruction.a));
  if (instruction.op == Op::Delay) return argument_of(Statement::Delay);
  if (instruction.op == Op::InputTimed) return argument_of(Statement::Input);
  if (instruction.op == Op::Sqrt) return Suspect{.kind = Kind::Operand, .function = spec::Function::Sqrt};
  if (instruction.op == Op::Rnd) return Suspect{.kind = Kind::Operand, .function = spec::Function::Rnd};
  if (instruction.op == Op::ShiftLeft || instruction.op == Op::ShiftRight) return Suspect{.kind = Kind::Shift};
  if (instruction.op == Op::Divide || instruction.op == Op::Remainder) return Suspect{.kind = Kind::Divisor};
  if (instruction.op == Op::WriteSystem) return Suspect{.kind = Kind::Timer};
  if (instruction.op == Op::OnGoto || instruction.op == Op::OnGosub) return Suspect{.kind = Kind::Selector};
  if (instruction.op == Op::For || instruction.op == Op::ForElement) return Suspect{.kind = Kind::Step};
  // clang-format on
  return std::nullopt;
}

/// Returns the value that stopped the machine. For a statement, the first bad argument, whose
/// number goes into `at`.
std::int64_t value_of(const vm::Core& core, const bytecode::Instruction& instruction, Suspect& at) {
  const auto& r = core.registers;
  switch (at.kind) {
  case Kind::Argument: {
    if (instruction.op != Op::Perform)
      return r[instruction.op == Op::Delay ? instruction.a : instruction.b];
    const auto parameters = spec::info(at.statement).parameters();
    for (std::size_t i = 0; i < instruction.c && i < parameters.size(); ++i)
      if (const auto value = r[instruction.b + i];
          value < parameters[i].least || value > parameters[i].greatest) {
        at.argument = i;
        return value;
      }
    return 0;
  }
  case Kind::Operand:
  case Kind::Timer: return r[instruction.b];
  case Kind::Shift: return r[instruction.c];
  case Kind::Selector: return r[instruction.a];
  case Kind::Index: return r[bytecode::index_variable];
  case Kind::Divisor:
  case Kind::Step: return 0;
  }
  return 0;
}

} // namespace

std::vector<Suspect> places_of(const compiler::Program& program, const StatementNode& statement) {
  return Places(program).of(statement);
}

std::optional<Stopped> where(const vm::Machine& machine, BasicError error) {
  const auto& core = machine.core();
  const auto index = core.index_of(core.at);
  const auto* line = line_of(core.chunk, index);
  if (line == nullptr)
    return std::nullopt;
  const auto& code = core.chunk.code;
  const auto place = place_of(code[index]);
  Stopped stopped;
  if (place && raises(place->kind, error))
    stopped.at = *place;
  else if (error == BasicError::IllegalIndex)
    stopped.at.kind = Kind::Index; // any access to Z
  else
    return std::nullopt;
  for (std::uint32_t i = line->begin; i < code.size() && line_of(core.chunk, i) == line; ++i)
    if (const auto other = place_of(code[i]); other && same_place(*other, stopped.at)) {
      stopped.before += i < index ? 1 : 0;
      ++stopped.all;
    }
  stopped.value = value_of(core, code[index], stopped.at);
  return stopped;
}

bool raises(Kind kind, BasicError error) {
  switch (kind) {
  case Kind::Argument:
  case Kind::Operand:
  case Kind::Shift:
  case Kind::Timer: return error == BasicError::BadNumericParameter;
  case Kind::Divisor: return error == BasicError::DivideByZero;
  case Kind::Index:
  case Kind::Selector: return error == BasicError::IllegalIndex;
  case Kind::Step: return error == BasicError::BadStepValue;
  }
  return false;
}

bool same_place(const Suspect& a, const Suspect& b) {
  return a.kind == b.kind && a.statement == b.statement && a.argument == b.argument &&
         a.function == b.function;
}

const bytecode::Line* line_of(const bytecode::Chunk& chunk, std::uint32_t index) {
  const auto after =
      std::upper_bound(chunk.lines.begin(), chunk.lines.end(), index,
                       [](std::uint32_t place, const auto& line) { return place < line.begin; });
  return after == chunk.lines.begin() ? nullptr : &*std::prev(after);
}

} // namespace orb::run
