#include "run/cause/cause.h"

#include "run/cause/places.h"

#include "compiler/text/rules.h"
#include "run/run.h"
#include "run/texts.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace orb::run {
namespace {

using compiler::NodeKind;
using compiler::none;
using compiler::StatementNode;
using spec::BasicError;
using spec::Statement;

using Kind = SuspectKind;

// --- wording -------------------------------------------------------------------------------------

std::string range(std::int64_t least, std::int64_t greatest) {
  return greatest >= unbounded ? fmt::format("{} or more", least)
                               : fmt::format("{} to {}", least, greatest);
}

/// For each letter the source variable that it holds; empty if none.
using LetterNames =
    std::array<std::string, static_cast<std::size_t>(spec::value_of(spec::Limit::DirectVariables))>;

/// Says what other balls do with the value, on which programs rely; mostly empty.
std::string elsewhere(const Suspect& suspect, std::int64_t value) {
  const auto is_colour = suspect.kind == Kind::Argument && suspect.statement == Statement::Rgb;
  if (!is_colour && !(suspect.turns && value < suspect.least))
    return "";
  const auto turn = suspect.greatest + 1;
  return fmt::format("some balls treat it as {} and continue, as with `--lenient`",
                     is_colour ? std::clamp(value, suspect.least, suspect.greatest)
                               : (value % turn + turn) % turn);
}

class Teller {
public:
  /// `names` are the source names in a structured program; null if letters are the names.
  Teller(const compiler::Program& program, const compiler::Line& line, const vm::Machine* machine,
         const LetterNames* names)
      : program_(program), line_(line), statement_(program.statements[line.statement]),
        machine_(machine), names_(names) {}

  Cause value(BasicError error) const {
    auto suspects = places_of(program_, statement_);
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

  /// Returns an expression in the words of the source; empty if the source has no name for a part
  /// of it or writes it differently.
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

  /// Lists the letters of an expression with their values.
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

  /// Returns true if an expression contains something that can make it negative. A letter alone
  /// more likely grew too large.
  bool may_be_negative(std::uint32_t root) const {
    const auto begin = program_.nodes.begin();
    return std::any_of(begin + program_.nodes[root].first, begin + root + 1, [](const auto& node) {
      return node.kind == NodeKind::Negate ||
             (node.kind == NodeKind::Binary &&
              static_cast<spec::Operator>(node.what) == spec::Operator::Subtract) ||
             (node.kind == NodeKind::System && spec::variables[node.what].least < 0);
    });
  }

  /// Wraps the expression to one turn.
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

  /// The line with the suspect's expression replaced.
  Message with(const Suspect& suspect, std::string_view expression) const {
    const auto span = program_.nodes[suspect.root].span;
    const auto before =
        program_.text.substr(statement_.span.begin, span.begin - statement_.span.begin);
    const auto after = program_.text.substr(span.end, statement_.span.end - span.end);
    return texts::Write(fmt::format("{} {}{}{}", line_.number, before, expression, after));
  }

  /// The line with a condition in front; empty if the language does not allow one there.
  Message guarded(std::string_view condition) const {
    if (spec::info(statement_.kind).in_then == spec::InThen::Refused ||
        spec::info(statement_.kind).form == spec::Form::Loop)
      return {};
    return texts::Write(fmt::format("{} if {} then {}", line_.number, condition,
                                    program_.text_of(statement_.span)));
  }

  /// Returns a free line number just before this line; nullopt if there is none.
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
    cause.seen = fmt::format("{} is {}; it must be {}", suspect.name, value,
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

  /// Returns a line to write that keeps the value in range.
  Message remedy(const Suspect& suspect, std::optional<std::int64_t> value) const {
    if (suspect.kind == Kind::Index) {
      if (value && *value > suspect.greatest)
        return guarded(fmt::format("Y < {}", suspect.greatest + 1));
      const auto before = free_number();
      return before ? texts::SetIndexFirst(fmt::format("{} Y = 1", *before)) : Message();
    }
    if (is_written_out(suspect))
      return {};
    const auto expression = text(suspect.root);
    if (suspect.kind == Kind::Step) {
      const auto before = free_number();
      return before && program_.nodes[suspect.root].kind == NodeKind::Letter
                 ? texts::Write(fmt::format("{0} if {1} = 0 then {1} = 1", *before, expression))
                 : Message();
    }
    if (suspect.kind == Kind::Divisor)
      return guarded(fmt::format("{} ! 0", expression));
    const auto above = fmt::format("{} > {}", expression, suspect.least - 1);
    const auto below = fmt::format("{} < {}", expression, suspect.greatest + 1);
    if (suspect.greatest >= unbounded || (value && *value < suspect.least))
      return guarded(above);
    return guarded(value ? below : fmt::format("{} and {}", above, below));
  }

  /// Lists possible causes if the values are unknown.
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
      const auto within = turned(only, may_be_negative(only.root));
      cause.seen += fmt::format("; use {}", within);
      cause.help = with(only, within);
    } else {
      cause.help = remedy(only, std::nullopt);
    }
    return cause;
  }

public:
  // --- loops, calls, data ---------------------------------------------------------------------

  /// Returns for example `called in lines 20, 40`.
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
        fmt::format("{} subroutines are open, called on lines {}", core.frames.call_depth, lines);
    if (calls_itself && statement_.kind == Statement::Gosub)
      cause.help = texts::ToRepeat(fmt::format(
          "{} goto {}", line_.number, program_.as<compiler::BranchView>(statement_).target.value));
    else
      cause.help = texts::GotoOutOfSubroutine();
    return cause;
  }

  Cause return_without_call() const {
    Cause cause{.seen = "no subroutine is open"};
    std::uint32_t start = 0; // the nearest gosub target above
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
      cause.help = texts::EndBeforeSubroutine(fmt::format("{} end", *before));
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
      return {.seen = "no loop is open", .help = texts::GotoIntoLoop()};
    const auto name = name_of(*frames.loop);
    return {.seen = fmt::format("the open loop counts with `{}`", name),
            .help = texts::Write(fmt::format("{} next {}", line_.number, name))};
  }

  Cause too_many_loops() const {
    if (machine_ == nullptr)
      return {};
    const auto& frames = machine_->core().frames;
    Cause cause;
    for (const auto* loop = &frames.loops[1]; loop <= frames.loop; ++loop)
      cause.seen += fmt::format("{}{}", cause.seen.empty() ? "" : ", ", name_of(*loop));
    cause.seen = fmt::format("the loops that count with {} are open", cause.seen);
    cause.help = texts::GotoOutOfLoop();
    return cause;
  }

  Cause out_of_data() const {
    if (machine_ == nullptr)
      return {};
    const auto count = machine_->core().data_count;
    const auto before = free_number();
    if (count == 0)
      return {.seen = "no `data` line has run yet",
              .help = before ? texts::Write(fmt::format("{} data 1,2,3", *before)) : Message()};
    return {.seen = fmt::format("all {} values in `data` have been read", count),
            .help = before ? texts::ToReadAgain(fmt::format("{} rstr", *before)) : Message()};
  }

private:
  const compiler::Program& program_;
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

/// Adds the linter's finding for the line, if its rule predicts this error.
void add_finding(ProgramError& fault, const Input& input) {
  const auto& all = findings(input).front().diagnostics;
  const auto stops_so = [&](const Diagnostic& one) {
    return one.rule->robot_error == spec::code(fault.code) ||
           (one.rule == &compiler::rules::NewerThanTarget && fault.code == BasicError::SyntaxError);
  };
  const auto found = std::find_if(all.begin(), all.end(), [&](const Diagnostic& one) {
    return stops_so(one) && input.source->position(one.span.begin).line == fault.place.line;
  });
  if (found == all.end())
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

// --- structured programs -------------------------------------------------------------------------

/// Sets the place of a fault in a structured program.
void put_place(ProgramError& fault, const LineMap& lines) {
  fault.file = lines.files.front();
  const auto place = lines.places.find(fault.robot_line);
  if (place == lines.places.end())
    return;
  fault.file = lines.files[place->second.file];
  fault.place = {place->second.line, place->second.column};
}

/// Returns the array that a statement uses; null if it uses none or several.
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

/// The robot has a single array; by the time the fault is detected, a bad index has become 0.
Cause wrong_index(const structured::Compiled& compiled, const structured::Statement& statement) {
  const auto* array = only_array(compiled, statement);
  if (array == nullptr)
    return {.seen = "array index out of bounds"};
  const auto name = compiled.program.name(array->name);
  return {.seen = fmt::format("the index is outside `{0}`, which has elements 1 to {1}", name,
                              array->value)};
}

/// Describes a fault in the names of a structured program, without suggesting robot lines.
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
  cause.help = code == BasicError::OutOfData ? texts::RstrReadsAgain() : Message();
  return cause;
}

} // namespace

ProgramError explain(const Input& input, int robot_line, BasicError code,
                     const vm::Machine* machine) {
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
  add_finding(fault, input);
  return fault;
}

} // namespace orb::run
