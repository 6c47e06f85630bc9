#pragma once

#include "structured/text/program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace orb::structured {

enum class SymbolKind : std::uint8_t {
  Variable, ///< shared by the whole program
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
  std::uint32_t routine = 0;      ///< Local, Parameter: whose; Sub, Function: the routine itself
  std::int32_t value = 0;         ///< Constant: its value; Array: its size
  std::int32_t base = 0;          ///< Array: the elements before its first
  Span span;
};

/// The main program, a sub or a function.
struct Routine {
  std::uint32_t symbol = none; ///< none for the main program
  std::uint32_t statement = none;
  std::uint32_t first_parameter = 0; ///< its parameters are symbols one after the other
  std::uint32_t parameters = 0;
  std::vector<std::uint32_t> locals; ///< symbols
};

/// What the names of a program stand for.
struct Names {
  std::vector<Symbol> symbols;
  std::vector<Routine> routines;           ///< the main program first
  std::vector<std::uint32_t> of_node;      ///< of Name, Element and Call nodes: a symbol or none
  std::vector<std::uint32_t> of_statement; ///< of calls, labels excepted: a symbol or none
  std::vector<std::uint32_t> routine_of;   ///< of each statement: the routine it stands in
  std::int32_t elements = 0;               ///< of all arrays together
};

struct Constant {
  std::int32_t value = 0;
  bool duration = false;
};

/// Finds what each name stands for; reports names that are unknown, taken or used for what they are
/// not. Constants and array sizes are computed here.
Names resolve(Program& program);

/// The value of an expression of literals and constants, or nothing. A division by zero is nothing.
std::optional<Constant> evaluate(const Program& program, const Names& names, std::uint32_t root);

/// Whether a sub or function has a `return` with a value.
bool gives_value(const Program& program, const Names& names, std::uint32_t routine);

/// Offers to make a function of a sub, or the other way round.
void turn(const Program& program, const Names& names, std::uint32_t routine, SymbolKind into,
          Diagnostic& finding);

/// Whether a statement does something besides giving a value, and so must stay.
bool has_effects(const Program& program, const Statement& statement);

} // namespace orb::structured
