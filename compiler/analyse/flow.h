#pragma once

#include "compiler/text/program.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orb::compiler {

/// The control flow of a program: its lines with a statement, in text order, and the jumps between
/// them.
struct Flow {
  struct Jump {
    std::uint32_t from = 0;    ///< index into `code`
    std::uint32_t to = none;   ///< index into `code`; `none` if the line does not exist
    std::uint32_t item = none; ///< the Target item of the jump
    bool call = false;         ///< by gosub
  };

  struct Code {
    std::uint32_t line = 0;      ///< index into Program::lines
    std::uint32_t statement = 0; ///< index into Program::statements
    std::uint32_t jumps_begin = 0;
    std::uint32_t jumps_end = 0;
    bool falls = true;   ///< the line below can follow, also after the return of a gosub
    bool target = false; ///< the target of a jump
    bool called = false; ///< the target of a call
    // True if a statement of the line or of its branches does this:
    bool loops = false; ///< `for` or `next`
    bool waits = false; ///< spec::After::Waits
    bool ends = false;  ///< spec::After::Ends
  };

  struct Number {
    std::uint32_t number;
    std::uint32_t line; ///< index into Program::lines
    std::uint32_t code; ///< index into `code`; `none` for a line without a statement
  };

  /// A statement without an error, on a line or in a branch.
  struct Place {
    std::uint32_t statement; ///< index into Program::statements
    std::uint32_t code;      ///< index into `code`
  };

  std::vector<Code> code;
  std::vector<Jump> jumps;     ///< ascending by `from`
  std::vector<Number> numbers; ///< ascending; the first in the text comes first among equals
  std::vector<Place> places;   ///< by kind
  std::array<std::uint32_t, spec::statements.size() + 1> begins{}; ///< start of each kind in
                                                                   ///< `places`
  bool orderly = true; ///< line numbers ascend strictly and every numbered line has a statement

  std::span<const Jump> jumps_of(const Code& from) const {
    return {jumps.data() + from.jumps_begin, jumps.data() + from.jumps_end};
  }
  /// All statements of a kind, in text order. Most rules concern only a few kinds.
  std::span<const Place> all(spec::Statement kind) const {
    const auto begin = begins[static_cast<std::size_t>(kind)];
    return {places.data() + begin, places.data() + begins[static_cast<std::size_t>(kind) + 1]};
  }
  /// True if the statement is a whole line, not a branch.
  bool is_line(const Place& place) const { return code[place.code].statement == place.statement; }
  /// Finds the first line with this number, as `goto` does; null if there is none.
  const Number* find(std::uint32_t number) const;
  /// True if an earlier line already has this number.
  bool is_taken(std::uint32_t number, std::uint32_t line) const {
    const auto* first = find(number);
    return first != nullptr && first->line < line;
  }
};

/// Computes the control flow of a program in linear time.
Flow read_flow(const Program& program);

} // namespace orb::compiler
