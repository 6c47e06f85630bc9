#include "run/cause.h"

#include "bytecode/op.h"
#include "compiler/check.h"
#include "run/run.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace orb::run {
namespace {

using bytecode::Op;
using compiler::Item;
using compiler::ItemKind;
using compiler::NodeKind;
using compiler::none;
using compiler::Program;
using compiler::StatementNode;
using spec::BasicError;
using spec::Statement;

constexpr std::int64_t unbounded = INT32_MAX;

/// What can be wrong with a number.
enum class Kind : std::uint8_t { Argument, Operand, Shift, Divisor, Timer, Index, Selector, Step };

/// A place in a line whose value can stop the program.
struct Suspect {
  Kind kind = Kind::Argument;
  Statement statement{};    ///< it is an argument of
  std::size_t argument = 0; ///< which
  spec::Function function{};
  std::string name = {};
  std::int64_t least = 0;
  std::int64_t greatest = 0;
  bool turns = false;        ///< a direction: one turn more is the same
  std::uint32_t root = none; ///< of its expression
};

// --- the places of a line, in the order in which it computes them ------------------------------

class Places {
public:
  explicit Places(const Program& program) : program_(program) {}

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

  const Program& program_;
  std::vector<Suspect> found_;
};

/// What balls do with the same value that programs were shown to work on; mostly nothing.
std::string elsewhere(const Suspect& suspect, std::int64_t value) {
  const auto is_colour = suspect.kind == Kind::Argument && suspect.statement == Statement::Rgb;
  if (!is_colour && !(suspect.turns && value < suspect.least))
    return "";
  const auto turn = suspect.greatest + 1;
  return fmt::format("some balls take it as {} and go on, as with `--lenient`",
                     is_colour ? std::clamp(value, suspect.least, suspect.greatest)
                               : (value % turn + turn) % turn);
}

/// Which kinds of places an error can come from.
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

// --- what the machine knows ---------------------------------------------------------------------

/// The place that a stopped machine was at, and the value there.
struct Stopped {
  Suspect at; ///< as far as an instruction tells: kind, statement, argument, function
  std::int64_t value = 0;
  std::size_t before = 0; ///< such places of the line that it had passed
  std::size_t all = 0;    ///< that the line has
};

/// The place that an instruction is; nothing where it cannot fail by a value.
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

/// The value of the place that stopped the machine; of a statement, its first bad argument, whose
/// number is put into `at`.
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
    stopped.at.kind = Kind::Index; // whatever touches Z
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

// --- words --------------------------------------------------------------------------------------

std::string range(std::int64_t least, std::int64_t greatest) {
  return greatest >= unbounded ? fmt::format("{} or more", least)
                               : fmt::format("{} to {}", least, greatest);
}

/// Of each letter the variable that the source has in its place; empty where it has none.
using LetterNames =
    std::array<std::string, static_cast<std::size_t>(spec::value_of(spec::Limit::DirectVariables))>;

class Teller {
public:
  /// `names` are those of a structured program; null where letters are the names.
  Teller(const Program& program, const compiler::Line& line, const vm::Machine* machine,
         const LetterNames* names)
      : program_(program), line_(line), statement_(program.statements[line.statement]),
        machine_(machine), names_(names) {}

  Cause value(BasicError error) const {
    auto suspects = Places(program_).of(statement_);
    std::erase_if(suspects, [&](const Suspect& one) { return !raises(one.kind, error); });
    const auto stopped = machine_ != nullptr ? where(*machine_, error) : std::nullopt;
    if (!stopped)
      return possible(suspects);
    std::erase_if(suspects, [&](const Suspect& one) { return !same_place(one, stopped->at); });
    if (suspects.empty())
      return {};
    const bool told_apart = suspects.size() == stopped->all;
    return found(suspects[told_apart ? stopped->before : 0], stopped->value);
  }

private:
  std::string name_of_letter(std::size_t letter) const {
    return names_ == nullptr ? std::string(1, spec::letter_name(letter)) : (*names_)[letter];
  }

  /// An expression as the source may have it; empty where it holds what the source does not name,
  /// or writes otherwise.
  std::string text(std::uint32_t root) const {
    if (root == none)
      return "";
    const auto span = program_.nodes[root].span;
    if (names_ == nullptr)
      return std::string(program_.text_of(span));
    std::string said;
    auto at = span.begin;
    for (std::uint32_t i = program_.nodes[root].first; i <= root; ++i) {
      const auto& node = program_.nodes[i];
      if (node.kind == NodeKind::Call || node.kind == NodeKind::Indexed)
        return "";
      if (node.kind != NodeKind::Letter)
        continue;
      if ((*names_)[node.what].empty())
        return "";
      said += program_.text.substr(at, node.span.begin - at);
      said += (*names_)[node.what];
      at = node.span.end;
    }
    return said + std::string(program_.text.substr(at, span.end - at));
  }

  bool is_written_out(const Suspect& suspect) const {
    return suspect.root != none && program_.nodes[suspect.root].kind == NodeKind::Number;
  }

  /// The values of the letters in an expression.
  std::string letters(const Suspect& suspect) const {
    std::string list;
    std::vector<std::size_t> told;
    if (suspect.root == none || machine_ == nullptr)
      return list;
    for (std::uint32_t i = program_.nodes[suspect.root].first; i <= suspect.root; ++i) {
      const auto& node = program_.nodes[i];
      if (node.kind != NodeKind::Letter ||
          std::find(told.begin(), told.end(), node.what) != told.end())
        continue;
      told.push_back(node.what);
      if (const auto name = name_of_letter(node.what); !name.empty())
        list += fmt::format("{}{} is {}", list.empty() ? "" : ", ", name,
                            machine_->variable(node.what));
    }
    return list;
  }

  /// The expression that keeps a direction within one turn.
  std::string turned(const Suspect& suspect, bool negative) const {
    const auto& node = program_.nodes[suspect.root];
    const bool simple = node.kind != NodeKind::Binary && node.kind != NodeKind::Call &&
                        node.kind != NodeKind::Negate;
    const auto once = fmt::format(
        "{} % {}", simple ? text(suspect.root) : fmt::format("({})", text(suspect.root)),
        suspect.greatest + 1);
    return negative
               ? fmt::format("({} + {}) % {}", once, suspect.greatest + 1, suspect.greatest + 1)
               : once;
  }

  /// The line with another expression in place of the suspect's.
  std::string with(const Suspect& suspect, std::string_view expression) const {
    const auto span = program_.nodes[suspect.root].span;
    const auto before =
        program_.text.substr(statement_.span.begin, span.begin - statement_.span.begin);
    const auto after = program_.text.substr(span.end, statement_.span.end - span.end);
    return fmt::format("write `{} {}{}{}`", line_.number, before, expression, after);
  }

  /// The line after a condition; empty where the language has no place for one.
  std::string guarded(std::string_view condition) const {
    if (spec::info(statement_.kind).in_then == spec::InThen::Refused ||
        spec::info(statement_.kind).form == spec::Form::Loop)
      return "";
    return fmt::format("write `{} if {} then {}`", line_.number, condition,
                       program_.text_of(statement_.span));
  }

  /// A number for a line just before this one; nothing where none is free.
  std::optional<std::uint32_t> free_number() const {
    std::uint32_t before = 0;
    for (const auto& one : program_.lines)
      if (one.has_number() && one.number < line_.number)
        before = std::max(before, one.number);
    const auto middle = (before + line_.number) / 2;
    return middle > before && middle < line_.number ? std::optional(middle) : std::nullopt;
  }

  Cause found(const Suspect& suspect, std::int64_t value) const {
    Cause cause;
    cause.variables = letters(suspect);
    if (suspect.kind == Kind::Divisor || suspect.kind == Kind::Step) {
      const auto expression = is_written_out(suspect) ? "" : text(suspect.root);
      cause.seen = expression.empty() ? fmt::format("{} is 0", suspect.name)
                                      : fmt::format("{} `{}` is 0", suspect.name, expression);
      cause.help = remedy(suspect, value);
      return cause;
    }
    cause.parameter = suspect.name;
    cause.value = value;
    cause.aside = elsewhere(suspect, value);
    cause.least = suspect.least;
    cause.greatest = suspect.greatest;
    cause.seen = fmt::format("{} is {}, {} allowed", suspect.name, value,
                             range(suspect.least, suspect.greatest));
    if (suspect.turns && !is_written_out(suspect) && !text(suspect.root).empty()) {
      const auto use = turned(suspect, value < 0);
      cause.seen += fmt::format("; use {}", use);
      cause.help = with(suspect, use);
    } else {
      cause.help = remedy(suspect, value);
    }
    return cause;
  }

  /// A line that keeps the value from doing harm.
  std::string remedy(const Suspect& suspect, std::optional<std::int64_t> value) const {
    if (suspect.kind == Kind::Index) {
      if (value && *value > suspect.greatest)
        return guarded(fmt::format("Y < {}", suspect.greatest + 1));
      const auto before = free_number();
      return before ? fmt::format("set `Y` first: write `{} Y = 1`", *before) : "";
    }
    if (is_written_out(suspect))
      return "";
    const auto expression = text(suspect.root);
    if (suspect.kind == Kind::Step) {
      const auto before = free_number();
      return before && program_.nodes[suspect.root].kind == NodeKind::Letter
                 ? fmt::format("write `{} if {} = 0 then {} = 1`", *before, expression, expression)
                 : "";
    }
    if (suspect.kind == Kind::Divisor)
      return guarded(fmt::format("{} ! 0", expression));
    const auto above = fmt::format("{} > {}", expression, suspect.least - 1);
    const auto below = fmt::format("{} < {}", expression, suspect.greatest + 1);
    if (suspect.greatest >= unbounded || (value && *value < suspect.least))
      return guarded(above);
    return guarded(value ? below : fmt::format("{} and {}", above, below));
  }

  /// What it may have been, where nobody saw the values.
  Cause possible(std::vector<Suspect> suspects) const {
    std::erase_if(suspects, [&](const Suspect& one) {
      return is_written_out(one) && program_.nodes[one.root].value >= one.least &&
             program_.nodes[one.root].value <= one.greatest && one.kind != Kind::Divisor;
    });
    Cause cause;
    for (const auto& suspect : suspects) {
      const auto expression = text(suspect.root);
      const auto what = suspect.root == none ? fmt::format("`{}`", suspect.name)
                        : expression.empty() ? suspect.name
                                             : fmt::format("{} `{}`", suspect.name, expression);
      cause.seen += cause.seen.empty() ? "" : ", or ";
      cause.seen +=
          suspect.kind == Kind::Divisor || suspect.kind == Kind::Step
              ? fmt::format("{} was 0", what)
              : fmt::format("{} was not {}", what, range(suspect.least, suspect.greatest));
    }
    if (suspects.size() != 1)
      return cause;
    const auto& only = suspects.front();
    if (only.turns && !is_written_out(only) && !text(only.root).empty()) {
      cause.seen += fmt::format("; use {}", turned(only, false));
      cause.help = with(only, turned(only, false));
    } else {
      cause.help = remedy(only, std::nullopt);
    }
    return cause;
  }

public:
  // --- loops, calls, data ---------------------------------------------------------------------

  /// `called in lines 20, 40`.
  Cause too_many_calls() const {
    if (machine_ == nullptr)
      return {};
    const auto& core = machine_->core();
    Cause cause;
    std::string lines;
    bool calls_itself = false;
    for (std::uint32_t i = 0; i < core.frames.call_depth; ++i) {
      const auto* from = line_of(core.chunk, core.frames.calls[i] - 1);
      lines += fmt::format("{}{}", lines.empty() ? "" : ", ", from == nullptr ? 0 : from->number);
      calls_itself |= from != nullptr && from->number == line_.number;
    }
    cause.seen =
        fmt::format("{} subroutines are open, called in lines {}", core.frames.call_depth, lines);
    if (calls_itself && statement_.kind == Statement::Gosub)
      cause.help = fmt::format("to go round again, write `{} goto {}`", line_.number,
                               program_.as<compiler::BranchView>(statement_).target.value);
    else
      cause.help = "a subroutine ends at its `return`; a `goto` out of it leaves it open";
    return cause;
  }

  Cause return_without_call() const {
    Cause cause{.seen = "no subroutine is open"};
    std::uint32_t start = 0; // the nearest line above that a gosub leads to
    for (const auto& statement : program_.statements)
      if (statement.kind == Statement::Gosub && !statement.error)
        if (const auto target = program_.as<compiler::BranchView>(statement).target.value;
            target <= line_.number)
          start = std::max(start, target);
    const auto line = std::find_if(program_.lines.begin(), program_.lines.end(),
                                   [&](const auto& one) { return one.number == start; });
    if (line == program_.lines.end())
      return cause;
    if (const auto before = Teller(program_, *line, nullptr, names_).free_number())
      cause.help = fmt::format("end the program before the subroutine: write `{} end`", *before);
    return cause;
  }

  static std::string name_of(const vm::Loop& loop) {
    return loop.variable == bytecode::element_by_index
               ? "Z"
               : std::string(1, spec::letter_name(loop.variable));
  }

  Cause next_without_loop() const {
    if (machine_ == nullptr)
      return {};
    const auto& frames = machine_->core().frames;
    if (frames.loop == frames.loops.data())
      return {.seen = "no loop is open", .help = "a `goto` into a loop misses its `for`"};
    const auto name = name_of(*frames.loop);
    return {.seen = fmt::format("the loop that is open counts `{}`", name),
            .help = fmt::format("write `{} next {}`", line_.number, name)};
  }

  Cause too_many_loops() const {
    if (machine_ == nullptr)
      return {};
    const auto& frames = machine_->core().frames;
    Cause cause;
    for (const auto* loop = &frames.loops[1]; loop <= frames.loop; ++loop)
      cause.seen += fmt::format("{}{}", cause.seen.empty() ? "" : ", ", name_of(*loop));
    cause.seen = fmt::format("the loops of {} are open", cause.seen);
    cause.help = "a loop ends at its `next`; a `goto` out of it leaves it open";
    return cause;
  }

  Cause out_of_data() const {
    if (machine_ == nullptr)
      return {};
    const auto count = machine_->core().data_count;
    const auto before = free_number();
    if (count == 0)
      return {.seen = "no `data` has run yet",
              .help = before ? fmt::format("write `{} data 1,2,3`", *before) : ""};
    return {.seen = fmt::format("all {} values of `data` are read", count),
            .help = before ? fmt::format("to begin again, write `{} rstr`", *before) : ""};
  }

private:
  const Program& program_;
  const compiler::Line& line_;
  const StatementNode& statement_;
  const vm::Machine* machine_;
  const LetterNames* names_;
};

Cause cause_of(const compiler::Program& program, const compiler::Line& line, BasicError error,
               const vm::Machine* machine, const LetterNames* names) {
  const Teller teller(program, line, machine, names);
  switch (error) {
  case BasicError::BadNumericParameter:
  case BasicError::DivideByZero:
  case BasicError::IllegalIndex:
  case BasicError::BadStepValue: return teller.value(error);
  case BasicError::GosubDepthExceeded: return teller.too_many_calls();
  case BasicError::ReturnWithoutGosub: return teller.return_without_call();
  case BasicError::NextWithoutFor: return teller.next_without_loop();
  case BasicError::ForDepthExceeded: return teller.too_many_loops();
  case BasicError::OutOfData: return teller.out_of_data();
  case BasicError::SyntaxError:
  case BasicError::UnknownStatement:
  case BasicError::BadLineNumber:
  case BasicError::ExpressionTooComplex:
  case BasicError::UserAbort: return {};
  }
  return {};
}

} // namespace

Cause cause_of(const compiler::Program& program, const compiler::Line& line, BasicError error,
               const vm::Machine* machine) {
  return cause_of(program, line, error, machine, nullptr);
}

namespace {

/// Takes over what the linter says of the line, where it knows that it stops the program so.
void add_finding(ProgramError& fault, const Source& source, std::string_view text,
                 const compiler::Target& target) {
  const auto checked = compiler::check(text, target);
  const auto found = std::find_if(checked.diagnostics.begin(), checked.diagnostics.end(),
                                  [&](const Diagnostic& one) {
                                    return one.rule->robot_error == spec::code(fault.code) &&
                                           source.position(one.span.begin).line == fault.place.line;
                                  });
  if (found == checked.diagnostics.end())
    return;
  fault.finding = found->message;
  fault.help = found->help;
}

const compiler::Line* find_line(const compiler::Program& program, std::uint32_t number) {
  const auto line = std::find_if(program.lines.begin(), program.lines.end(), [&](const auto& one) {
    return one.number == number && one.has_statement();
  });
  return line == program.lines.end() ? nullptr : &*line;
}

// --- structured programs ------------------------------------------------------------------------

/// Where a fault is in a structured program.
void put_place(ProgramError& fault, const LineMap& lines) {
  fault.file = lines.files.front();
  const auto place = lines.places.find(fault.robot_line);
  if (place == lines.places.end())
    return;
  fault.file = lines.files[place->second.file];
  fault.place = {place->second.line, place->second.column};
}

/// The array that a statement uses; null where it uses none or several.
const structured::Symbol* only_array(const structured::Compiled& compiled,
                                     const structured::Statement& statement) {
  const structured::Symbol* found = nullptr;
  for (std::size_t n = 0; n < compiled.program.nodes.size(); ++n) {
    const auto span = compiled.program.nodes[n].span;
    const auto symbol = compiled.names.of_node[n];
    if (span.begin < statement.span.begin || span.end > statement.span.end ||
        symbol == structured::none)
      continue;
    const auto& one = compiled.names.symbols[symbol];
    if (one.kind != structured::SymbolKind::Array)
      continue;
    if (found != nullptr && found != &one)
      return nullptr;
    found = &one;
  }
  return found;
}

/// The robot has one array, and a wrong index is 0 when it gets there.
Cause wrong_index(const structured::Compiled& compiled, const structured::Statement& statement) {
  const auto* array = only_array(compiled, statement);
  if (array == nullptr)
    return {.seen = "an index is outside of its array"};
  const auto name = compiled.program.name(array->name);
  return {.seen =
              fmt::format("the index is outside of `{0}[1]` to `{0}[{1}]`", name, array->value)};
}

/// The cause of a fault in the words of a structured program: with its names, and without lines of
/// the robot to write.
Cause structured_cause(const structured::Compiled& compiled, const compiler::Program& program,
                       const compiler::Line& line, BasicError code, const vm::Machine* machine) {
  const auto& robot = compiled.robot;
  const auto found = std::lower_bound(
      robot.lines.begin(), robot.lines.end(), line.number,
      [](const structured::RobotLine& one, std::uint32_t number) { return one.number < number; });
  if (found == robot.lines.end())
    return {};
  if (code == BasicError::IllegalIndex)
    return wrong_index(compiled, compiled.program.statements[found->statement]);
  LetterNames names;
  for (auto n = found->names_begin; n < found->names_end; ++n)
    names[robot.names[n].letter] =
        compiled.program.name(compiled.names.symbols[robot.names[n].symbol].name);
  auto cause = cause_of(program, line, code, machine, &names);
  cause.help = code == BasicError::OutOfData ? "`rstr` begins with the first value again" : "";
  return cause;
}

} // namespace

ProgramError explain(const Input& input, const compiler::Target& target, int robot_line,
                     BasicError code, const vm::Machine* machine) {
  const auto& program = input.program->parsed;
  ProgramError fault;
  fault.robot_line = static_cast<std::uint32_t>(robot_line);
  fault.numbered = input.program->compiled == nullptr;
  fault.code = code;
  fault.file = input.source->name();
  const auto* line = find_line(program, fault.robot_line);
  if (!fault.numbered) {
    put_place(fault, input.program->lines);
    if (line != nullptr)
      fault.cause = structured_cause(*input.program->compiled, program, *line, code, machine);
    return fault;
  }
  if (line == nullptr) {
    fault.cause.seen = fmt::format("the program has no line {}", robot_line);
    return fault;
  }
  fault.cause = cause_of(program, *line, code, machine);
  fault.place = input.source->position(program.statements[line->statement].span.begin);
  add_finding(fault, *input.source, program.text, target);
  return fault;
}

} // namespace orb::run
