#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace orb::bytecode {

/// The instructions. bytecode/op.def documents each.
enum class Op : std::uint16_t {
#define ORB_OP(name, ...) name,
#include "bytecode/op.def"
};

/// Tells if the line continues after an instruction.
enum class Ends : std::uint8_t { Value, Either, Line };

/// The share of an instruction that machine code handles.
enum class Compiled : std::uint8_t { Wholly, Mostly, Never };

struct OpInfo {
  std::string_view name;
  Ends ends;
  Compiled compiled;
  std::string_view operands; ///< a letter for each of a to d, then t for a target

  constexpr bool has_target() const { return operands.size() == 5; }
};

inline constexpr auto ops = std::to_array<OpInfo>({
#define ORB_OP(name, ends, compiled, operands, effect)                                             \
  {#name, Ends::ends, Compiled::compiled, operands},
#include "bytecode/op.def"
});

constexpr const OpInfo& info(Op op) {
  return ops[static_cast<std::size_t>(op)];
}

} // namespace orb::bytecode
