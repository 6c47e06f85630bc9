#pragma once

#include "structured/text/program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace orb::structured {

enum class SymbolKind : std::uint8_t {
  Variable, ///< global
  Local,
  Parameter,
  Constant, ///< also the macros of `use`
  Array,
  Sub,
  Function,
};

struct Symbol {
  SymbolKind kind = SymbolKind::Variable;
  bool duration = false; ///< Constant: milliseconds
  bool read = false;
  bool used = false; ///< Sub, Function: called somewhere
  std::uint32_t name = none;
  std::uint32_t statement = none; ///< the declaration, or the first assignment
  std::uint32_t routine = 0;      ///< Local, Parameter: its routine; Sub, Function: itself
  std::int32_t value = 0;         ///< Constant: its value; Array: its size
  std::int32_t base = 0;          ///< Array: the number of elements before its first
  Span span;
};

/// The main program, a sub or a function.
struct Routine {
  std::uint32_t symbol = none; ///< none for the main program
  std::uint32_t statement = none;
  std::uint32_t first_parameter = 0; ///< its parameters are consecutive symbols
  std::uint32_t parameters = 0;
  std::vector<std::uint32_t> locals; ///< symbols
};

/// The meaning of the names of a program.
struct Names {
  std::vector<Symbol> symbols;
  std::vector<Routine> routines;           ///< the main program first
  std::vector<std::uint32_t> of_node;      ///< of Name, Element and Call nodes: a symbol or none
  std::vector<std::uint32_t> of_statement; ///< of calls, except labels: a symbol or none
  std::vector<std::uint32_t> routine_of;   ///< of each statement: the enclosing routine
  std::int32_t elements = 0;               ///< of all arrays together
};

struct Constant {
  std::int32_t value = 0;
  bool duration = false;
};

/// Resolves names; reports names that are unknown, already taken or used wrongly. Computes
/// constants and array sizes.
Names resolve(Program& program);

/// The value of an expression of literals and constants; nothing if it is not constant or divides
/// by zero.
std::optional<Constant> evaluate(const Program& program, const Names& names, std::uint32_t root);

/// True if a sub or function has a `return` with a value.
bool gives_value(const Program& program, const Names& names, std::uint32_t routine);

/// Offers to turn a sub into a function, or the reverse.
void turn(const Program& program, const Names& names, std::uint32_t routine, SymbolKind into,
          Diagnostic& finding);

/// True if a statement has an effect besides giving a value, and so must stay.
bool has_effects(const Program& program, const Statement& statement);

} // namespace orb::structured
