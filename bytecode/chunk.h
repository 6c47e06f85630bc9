#pragma once

#include "bytecode/op.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace orb::bytecode {

/// One instruction of the machine. Operands are registers unless the row in bytecode/op.def says
/// otherwise; `target` is the index of an instruction.
struct Instruction {
  Op op{};
  bool ends_line = false; ///< for an operation with Ends::Either
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  std::uint16_t c = 0;
  std::uint16_t d = 0;
  std::uint32_t target = 0;

  friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// A line of the program: its number and its first instruction.
struct Line {
  std::uint16_t number = 0;
  std::uint32_t begin = 0;

  friend bool operator==(const Line&, const Line&) = default;
};

// The layout of the register file: A to Y, the elements of Z, temporaries, constants.
inline constexpr std::uint16_t index_variable = 24; ///< Y
inline constexpr std::uint16_t first_element = 25;  ///< Z if Y is 1
inline constexpr std::uint16_t element_count = 25;
inline constexpr std::uint16_t first_temporary = 50;
/// Denotes Z as the variable of a loop, of `read` or of `input`: the element selected by Y at run
/// time.
inline constexpr std::uint16_t element_by_index = 0xFFFF;

/// A compiled program. The compiler makes it, the machine runs it, listing() prints it.
struct Chunk {
  std::vector<Instruction> code;       ///< ends with EndOfProgram
  std::vector<Line> lines;             ///< in text order, `begin` ascending
  std::vector<std::int32_t> constants; ///< registers from first_constant() on
  std::uint16_t temporaries = 0;
  std::vector<std::string> texts; ///< used by print

  std::uint16_t first_constant() const {
    return static_cast<std::uint16_t>(first_temporary + temporaries);
  }
  std::uint16_t register_count() const {
    return static_cast<std::uint16_t>(first_constant() + constants.size());
  }
  /// The index of the first instruction of a line (an index); after the last line, of EndOfProgram.
  std::uint32_t begin(std::size_t line) const {
    return line < lines.size() ? lines[line].begin : static_cast<std::uint32_t>(code.size() - 1);
  }
  std::span<const Instruction> instructions(std::size_t line) const {
    return std::span(code).subspan(begin(line), begin(line + 1) - begin(line));
  }

  friend bool operator==(const Chunk&, const Chunk&) = default;
};

/// Checks that the machine can run a chunk safely; returns the first problem: an operand out of
/// range, a target outside the code, lines out of order. Every chunk from the compiler passes.
std::optional<std::string> verify(const Chunk& chunk);

/// Prints the instructions of a line (an index), one per text line.
std::string listing(const Chunk& chunk, std::size_t line);

/// Prints the whole chunk: the number of each line, then its instructions.
std::string listing(const Chunk& chunk);

} // namespace orb::bytecode
