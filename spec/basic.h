#pragma once

// The orbBasic language of the robot as tables: statements, functions, system variables, operators,
// errors and flags. The rows and their columns are in spec/basic.def.

#include "spec/limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace orb::spec {

/// The versions of the interpreter that changed the language.
enum class BasicVersion : std::uint8_t {
#define ORB_BASIC_VERSION(name, ...) name,
#include "spec/basic.def"
};

struct BasicVersionInfo {
  BasicVersion version;
  std::string_view text; ///< as for `--target`
  Limit ram;             ///< the most bytes of the RAM area of a ball of that time
  std::string_view summary;
};

inline constexpr auto basic_versions = std::to_array<BasicVersionInfo>({
#define ORB_BASIC_VERSION(name, text, ram, summary) {BasicVersion::name, text, Limit::ram, summary},
#include "spec/basic.def"
});

/// The version assumed if none is given: the last one whose additions are known.
inline constexpr auto default_basic_version = BasicVersion::V1_7;

/// Later extensions of existing words.
enum class BasicGrowth : std::uint8_t {
#define ORB_BASIC_GROWTH(name, ...) name,
#include "spec/basic.def"
};

struct BasicGrowthInfo {
  BasicGrowth growth;
  BasicVersion since;
  std::string_view source;
  std::string_view what;
};

inline constexpr auto basic_growths = std::to_array<BasicGrowthInfo>({
#define ORB_BASIC_GROWTH(name, since, source, what)                                                \
  {BasicGrowth::name, BasicVersion::since, source, what},
#include "spec/basic.def"
});

enum class Statement : std::uint8_t {
#define ORB_STATEMENT(name, ...) name,
#include "spec/basic.def"
};

/// The syntax after a statement's word.
enum class Form : std::uint8_t {
  Assignment,    ///< `v = e`; the word may be omitted
  Conditional,   ///< `if`
  Loop,          ///< `for`
  LoopEnd,       ///< `next`
  Branch,        ///< one literal line number
  IndexedBranch, ///< `on`
  Output,        ///< `print`
  Entry,         ///< `input`
  Values,        ///< one or more expressions, without a limit
  Variables,     ///< one or more variables
  Arguments,     ///< comma-separated expressions, one per parameter
};

/// Tells if a statement may follow `then` and `else`.
enum class InThen : std::uint8_t {
  Listed,   ///< documented
  Unlisted, ///< works, but is missing from the documented list (A-44)
  Refused,  ///< a syntax error
};

/// Control flow after a statement.
enum class After : std::uint8_t {
  Falls,  ///< to the line below
  Waits,  ///< to the line below, after some time
  Steers, ///< to the line below or another one
  Jumps,  ///< to another line
  Ends,   ///< the program or the subroutine ends; the text gives no successor
};

/// A numeric argument. A value outside `least` to `greatest` stops the program with Bad numeric
/// parameter.
struct Parameter {
  std::string_view name;
  std::int32_t least = 0;
  std::int32_t greatest = 0;
  std::string_view unit; ///< may be empty
};

struct StatementInfo {
  Statement statement;
  std::string_view word;
  BasicVersion since;
  Form form;
  InThen in_then;
  After after;
  std::uint8_t required; ///< number of required arguments
  std::string_view source;
  std::string_view usage;
  std::string_view summary;
  std::string_view example; ///< a line to paste
  std::array<Parameter, 4> parameter_slots;

  constexpr std::span<const Parameter> parameters() const {
    std::size_t n = 0;
    for (const auto& slot : parameter_slots) // used slots come first
      n += slot.name.empty() ? 0 : 1;
    return {parameter_slots.data(), n};
  }
};

inline constexpr auto statements = std::to_array<StatementInfo>({
#define PARAMETER(name, least, greatest, unit)                                                     \
  Parameter {                                                                                      \
    name, least, greatest, unit                                                                    \
  }
#define PARAMETERS(...)                                                                            \
  std::array<Parameter, 4> {                                                                       \
    __VA_ARGS__                                                                                    \
  }
#define NO_PARAMETERS                                                                              \
  std::array<Parameter, 4> {}
#define ORB_STATEMENT(name, word, since, form, in_then, after, required, source, usage, summary,   \
                      example, parameters)                                                         \
  {Statement::name,                                                                                \
   word,                                                                                           \
   BasicVersion::since,                                                                            \
   Form::form,                                                                                     \
   InThen::in_then,                                                                                \
   After::after,                                                                                   \
   required,                                                                                       \
   source,                                                                                         \
   usage,                                                                                          \
   summary,                                                                                        \
   example,                                                                                        \
   parameters},
#include "spec/basic.def"
#undef PARAMETER
#undef PARAMETERS
#undef NO_PARAMETERS
});

/// Prefix functions. The operand is the whole expression that follows.
enum class Function : std::uint8_t {
#define ORB_FUNCTION(name, ...) name,
#include "spec/basic.def"
};

struct FunctionInfo {
  Function function;
  std::string_view word;
  std::int64_t least; ///< a lesser operand stops the program with Bad numeric parameter
  std::int64_t greatest;
  std::string_view source;
  std::string_view summary;
  std::string_view example;
};

inline constexpr auto functions = std::to_array<FunctionInfo>({
#define ORB_FUNCTION(name, word, least, greatest, source, summary, example)                        \
  {Function::name, word, least, greatest, source, summary, example},
#include "spec/basic.def"
});

/// System variables: timers, switches and sensors.
enum class Variable : std::uint8_t {
#define ORB_VARIABLE(name, ...) name,
#include "spec/basic.def"
};

enum class Access : std::uint8_t {
  Read,
  ReadWrite,
  ReadClears, ///< reading sets it to 0
};

struct VariableInfo {
  Variable variable;
  std::string_view word;
  std::string_view old_word; ///< its name before `since`; empty if it was never renamed
  BasicVersion since;
  Access access;
  std::int32_t least; ///< the least value that it can read
  std::int32_t greatest;
  std::string_view unit; ///< may be empty
  std::string_view source;
  std::string_view summary;
};

inline constexpr auto variables = std::to_array<VariableInfo>({
#define ORB_VARIABLE(name, word, old, since, access, least, greatest, unit, source, summary)       \
  {Variable::name, word,   old,    BasicVersion::since, Access::access, least, greatest,           \
   unit,           source, summary},
#include "spec/basic.def"
});

/// A unit that people rarely use, such as milliseconds, with the everyday one, seconds.
struct SmallUnit {
  std::string_view unit;
  std::int32_t in_whole; ///< how many make one `whole`
  std::string_view whole;
  std::int32_t least_meant; ///< a smaller number without a unit counts in `whole`
};

inline constexpr auto small_units = std::to_array<SmallUnit>({
#define ORB_UNIT(unit, in_whole, whole, least_meant) {unit, in_whole, whole, least_meant},
#include "spec/basic.def"
});

enum class Operator : std::uint8_t {
#define ORB_OPERATOR(name, ...) name,
#include "spec/basic.def"
};

/// The precedence of an operator; equals associate to the left.
enum class Level : std::uint8_t { Low, Medium };

struct OperatorInfo {
  Operator op;
  char symbol;
  Level level;
  std::string_view example;
  std::string_view summary;
};

inline constexpr auto operators = std::to_array<OperatorInfo>({
#define ORB_OPERATOR(name, symbol, level, example, summary)                                        \
  {Operator::name, symbol, Level::level, example, summary},
#include "spec/basic.def"
});

enum class Relation : std::uint8_t {
#define ORB_RELATION(name, ...) name,
#include "spec/basic.def"
};

struct RelationInfo {
  Relation relation;
  char symbol;
  std::string_view summary;
};

inline constexpr auto relations = std::to_array<RelationInfo>({
#define ORB_RELATION(name, symbol, summary) {Relation::name, symbol, summary},
#include "spec/basic.def"
});

/// Errors that stop a program. The values are the robot's error numbers.
enum class BasicError : std::uint8_t {
#define ORB_BASIC_ERROR(name, code, text, summary) name = code,
#include "spec/basic.def"
};

struct BasicErrorInfo {
  BasicError error;
  std::string_view text; ///< the robot's wording
  std::string_view summary;
};

inline constexpr auto basic_errors = std::to_array<BasicErrorInfo>({
#define ORB_BASIC_ERROR(name, code, text, summary) {BasicError::name, text, summary},
#include "spec/basic.def"
});

/// The bits of `basflg`.
enum class BasicFlag : std::uint8_t {
#define ORB_BASIC_FLAG(name, value, since, symbol, summary) name = value,
#include "spec/basic.def"
};

struct BasicFlagInfo {
  BasicFlag flag;
  BasicVersion since;
  std::string_view symbol; ///< its name in the document
  std::string_view summary;
};

inline constexpr auto basic_flags = std::to_array<BasicFlagInfo>({
#define ORB_BASIC_FLAG(name, value, since, symbol, summary)                                        \
  {BasicFlag::name, BasicVersion::since, symbol, summary},
#include "spec/basic.def"
});

/// Words inside other statements.
inline constexpr auto particles =
    std::to_array<std::string_view>({"then", "else", "and", "or", "to", "step"});

constexpr const BasicVersionInfo& info(BasicVersion version) {
  return basic_versions[static_cast<std::size_t>(version)];
}
constexpr const BasicGrowthInfo& info(BasicGrowth growth) {
  return basic_growths[static_cast<std::size_t>(growth)];
}
constexpr const StatementInfo& info(Statement statement) {
  return statements[static_cast<std::size_t>(statement)];
}
constexpr const FunctionInfo& info(Function function) {
  return functions[static_cast<std::size_t>(function)];
}
constexpr const VariableInfo& info(Variable variable) {
  return variables[static_cast<std::size_t>(variable)];
}
constexpr const OperatorInfo& info(Operator op) {
  return operators[static_cast<std::size_t>(op)];
}
constexpr const RelationInfo& info(Relation relation) {
  return relations[static_cast<std::size_t>(relation)];
}
constexpr const BasicErrorInfo& info(BasicError error) {
  return basic_errors[static_cast<std::size_t>(error) - 1]; // numbered from 1
}

/// Finds the row of a unit; null for an everyday unit.
constexpr const SmallUnit* find_small_unit(std::string_view unit) {
  for (const auto& row : small_units)
    if (row.unit == unit)
      return &row;
  return nullptr;
}

/// Finds the row of exactly this word. Case counts: `rgb` is not a statement.
constexpr std::optional<BasicVersion> find_version(std::string_view text) {
  for (const auto& row : basic_versions)
    if (row.text == text)
      return row.version;
  return std::nullopt;
}
constexpr std::optional<Statement> find_statement(std::string_view word) {
  for (const auto& row : statements)
    if (row.word == word)
      return row.statement;
  return std::nullopt;
}
constexpr std::optional<Function> find_function(std::string_view word) {
  for (const auto& row : functions)
    if (row.word == word)
      return row.function;
  return std::nullopt;
}
/// Finds a system variable by its current or former name.
constexpr std::optional<Variable> find_variable(std::string_view word) {
  for (const auto& row : variables)
    if (row.word == word || (!row.old_word.empty() && row.old_word == word))
      return row.variable;
  return std::nullopt;
}
constexpr std::optional<Operator> find_operator(char symbol) {
  for (const auto& row : operators)
    if (row.symbol == symbol)
      return row.op;
  return std::nullopt;
}
constexpr std::optional<Relation> find_relation(char symbol) {
  for (const auto& row : relations)
    if (row.symbol == symbol)
      return row.relation;
  return std::nullopt;
}
/// Finds an error by the number that the robot reports.
constexpr std::optional<BasicError> find_error(std::uint32_t code) {
  if (code < 1 || code > basic_errors.size())
    return std::nullopt;
  return basic_errors[code - 1].error;
}

constexpr std::uint8_t code(BasicError error) {
  return static_cast<std::uint8_t>(error);
}

// Check the properties of the rows that the lookups above rely on.
consteval bool basic_words_are_unique() {
  std::array<std::string_view,
             statements.size() + functions.size() + 2 * variables.size() + particles.size()>
      words{};
  std::size_t n = 0;
  for (const auto& row : statements)
    words[n++] = row.word;
  for (const auto& row : functions)
    words[n++] = row.word;
  for (const auto& row : variables)
    words[n++] = row.word;
  for (const auto& row : variables)
    if (!row.old_word.empty())
      words[n++] = row.old_word;
  for (const auto word : particles)
    words[n++] = word;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (words[i] == words[j] || words[i].empty())
        return false;
  return true;
}
static_assert(basic_words_are_unique());

consteval bool basic_codes_ascend() {
  for (std::size_t i = 0; i < basic_errors.size(); ++i)
    if (static_cast<std::size_t>(basic_errors[i].error) != i + 1)
      return false;
  return true;
}
static_assert(basic_codes_ascend());

consteval bool basic_parameters_make_sense() {
  for (const auto& row : statements)
    for (const auto& parameter : row.parameters())
      if (parameter.least >= parameter.greatest)
        return false;
  return true;
}
static_assert(basic_parameters_make_sense());

} // namespace orb::spec
