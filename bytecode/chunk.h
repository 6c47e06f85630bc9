#pragma once

#include "bytecode/op.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace orb::bytecode {

/// One step of the machine. Operands are registers unless the row in bytecode/op.def says
/// otherwise; `target` is the index of an instruction.
struct Instruction {
  Op op{};
  bool ends_line = false; ///< of an operation whose row says Ends::Either
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

// The register file: A to Y, the elements of Z, temporaries, constants.
inline constexpr std::uint16_t index_variable = 24; ///< Y
inline constexpr std::uint16_t first_element = 25;  ///< Z where Y is 1
inline constexpr std::uint16_t element_count = 25;
inline constexpr std::uint16_t first_temporary = 50;
/// Stands for Z as the variable of a loop, of `read` or of `input`: the element that Y names then.
inline constexpr std::uint16_t element_by_index = 0xFFFF;

/// A compiled program. Made by the compiler, run by the machine, printed by listing().
struct Chunk {
  std::vector<Instruction> code;       ///< ends with EndOfProgram
  std::vector<Line> lines;             ///< in text order, `begin` ascending
  std::vector<std::int32_t> constants; ///< registers from first_constant() on
  std::uint16_t temporaries = 0;
  std::vector<std::string> texts; ///< of print

  std::uint16_t first_constant() const {
    return static_cast<std::uint16_t>(first_temporary + temporaries);
  }
  std::uint16_t register_count() const {
    return static_cast<std::uint16_t>(first_constant() + constants.size());
  }
  /// Where the instructions of a line (an index) begin; after the last line, EndOfProgram.
  std::uint32_t begin(std::size_t line) const {
    return line < lines.size() ? lines[line].begin : static_cast<std::uint32_t>(code.size() - 1);
  }
  std::span<const Instruction> instructions(std::size_t line) const {
    return std::span(code).subspan(begin(line), begin(line + 1) - begin(line));
  }

  friend bool operator==(const Chunk&, const Chunk&) = default;
};

/// What is wrong with a chunk that the machine could not run safely: an operand outside its range,
/// a target outside the code, lines out of order. Nothing for every chunk that the compiler makes.
std::optional<std::string> verify(const Chunk& chunk);

/// The instructions of a line (an index) as text, a line each.
std::string listing(const Chunk& chunk, std::size_t line);

/// The whole chunk as text: the number of each line, then its instructions.
std::string listing(const Chunk& chunk);

} // namespace orb::bytecode
