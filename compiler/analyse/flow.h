#pragma once

#include "compiler/text/program.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orb::compiler {

/// Where the lines of a program can go: its lines that hold a statement, in the order of the text,
/// and the jumps between them.
struct Flow {
  struct Jump {
    std::uint32_t from = 0;    ///< index into `code`
    std::uint32_t to = none;   ///< index into `code`; `none` where there is no such line
    std::uint32_t item = none; ///< the Target that names it
    bool call = false;         ///< by gosub
  };

  struct Code {
    std::uint32_t line = 0;      ///< index into Program::lines
    std::uint32_t statement = 0; ///< index into Program::statements
    std::uint32_t jumps_begin = 0;
    std::uint32_t jumps_end = 0;
    bool falls = true;   ///< the line below can be next, also after a gosub has returned
    bool target = false; ///< something jumps here
    bool called = false; ///< something calls this line
    // Whether a statement of the line, or one in its branches, does this:
    bool loops = false; ///< `for` or `next`
    bool waits = false; ///< spec::After::Waits
    bool ends = false;  ///< spec::After::Ends
  };

  struct Number {
    std::uint32_t number;
    std::uint32_t line; ///< index into Program::lines
    std::uint32_t code; ///< index into `code`; `none` for a line without a statement
  };

  /// A statement that has no error, on a line or in a branch.
  struct Place {
    std::uint32_t statement; ///< index into Program::statements
    std::uint32_t code;      ///< index into `code`
  };

  std::vector<Code> code;
  std::vector<Jump> jumps;     ///< ascending by `from`
  std::vector<Number> numbers; ///< ascending; of equals the first in the text comes first
  std::vector<Place> places;   ///< by kind
  std::array<std::uint32_t, spec::statements.size() + 1> begins{}; ///< of each kind in `places`
  bool orderly = true; ///< each line number is above those before it and has a statement

  std::span<const Jump> jumps_of(const Code& from) const {
    return {jumps.data() + from.jumps_begin, jumps.data() + from.jumps_end};
  }
  /// All statements of a kind, in the order of the text. Most rules are about a few kinds only.
  std::span<const Place> all(spec::Statement kind) const {
    const auto begin = begins[static_cast<std::size_t>(kind)];
    return {places.data() + begin, places.data() + begins[static_cast<std::size_t>(kind) + 1]};
  }
  /// Whether a statement is a whole line, not a branch.
  bool is_line(const Place& place) const { return code[place.code].statement == place.statement; }
  /// The first line of that number, as `goto` finds it, or null.
  const Number* find(std::uint32_t number) const;
  /// Whether a line above this one has its number already.
  bool is_taken(std::uint32_t number, std::uint32_t line) const {
    const auto* first = find(number);
    return first != nullptr && first->line < line;
  }
};

/// Reads the jumps of a program; linear in its size.
Flow read_flow(const Program& program);

} // namespace orb::compiler
