#pragma once

#include "base/diagnostic.h"
#include "base/message.h"
#include "repair/candidate.h"
#include "repair/tokens.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

// What people write who think in another language, as patterns with holes: the rows of
// repair/idioms.def.
//
// A pattern is literal words and signs (case does not count; `a|b`: one of them; ` ;; ` parts whole
// patterns) and holes: `$n $m` a number, `$q $p` a number with a unit or an operand, `$o` an
// operand, `$w` a word,
// `$v` a variable or element, `$t` a text, `$k` a colour, `$c $d` a condition, `$l` a list, `$r`
// anything or nothing, every other letter an expression. What is written instead names the holes in
// braces, perhaps through a function: `{sec:q}` (repair/fill.cpp).

namespace orb::repair {

enum class Where : std::uint8_t {
  Inside, ///< anywhere in a line
  Line,   ///< a whole statement: the line, or a branch of an `if`
};

struct Idiom {
  Where where;
  std::string_view patterns;
  std::string_view basic;
  std::string_view structured; ///< `=`: as in `basic`; empty: no way to write it
  std::string_view macro;
  std::string_view test;
  const orb::Text* note = nullptr; ///< what is said beside the line; null where nothing is
};

/// What a line is in, as far as a rewrite depends on it.
struct Surroundings {
  Language language = Language::Basic;
  std::string line_number;             ///< of an orbBasic line
  std::string first_number;            ///< of the program's first line, where it is not this one
  std::string free_letter;             ///< a variable that nobody uses; empty without one
  std::string loop;                    ///< the variable of the innermost `for` that is open
  int heading = 0;                     ///< of the last roll above, where it is a number
  std::string pace;                    ///< its speed; empty where the ball rests
  std::string label;                   ///< of a structured program, where it has only one
  bool in_function = false;            ///< of a structured program
  bool ends_sub = false;               ///< the last line of what `gosub` leads to, in orbBasic
  std::string closer;                  ///< what ends the innermost open block
  std::vector<std::string_view> names; ///< that other lines use, too; of orbBasic: that they set
  std::vector<std::string_view> elsewhere; ///< all words of other lines
};

/// What to do where no one line does it.
struct Hint {
  std::string_view patterns;
  const orb::Text* text;
  std::string_view basic;      ///< what fills the holes of the text; empty: no row for orbBasic
  std::string_view structured; ///< the same
  std::string_view macro;      ///< the same
};

/// The words of the languages that people speak, as far as they stand for one of a program.
std::vector<std::string_view> spoken_words();

/// Calls `take` with what each row that fits makes of a line, in the order of the table, until it
/// returns true.
void rewrite(const Tokens& line, const Surroundings& around,
             const std::function<bool(const Candidate&)>& take);

struct Bounds {
  int deepest = 0; ///< rows that are applied after each other
  std::size_t states = 0;
};

/// What the rows make of lines that have been looked at to the end, within the same surroundings.
using Rewrites = std::unordered_map<std::string, std::vector<Candidate>>;

/// Calls `take` with what the rows make of a line, one alone first, then two after each other, and
/// so on, until it returns true. What is in `seen` is not looked at again; what is in `known` need
/// not be computed, and what is looked at to the end is kept there.
void explore(const std::string& line, const Surroundings& around, Bounds bounds,
             std::unordered_set<std::string>& seen, Rewrites& known,
             const std::function<bool(const Candidate&)>& take);

/// The word that a line has at a place, as structured programs have it: `wenn` is `if`.
std::string word_at(const Tokens& line, std::size_t at);

/// Whether patterns of that kind begin with the word, in any case: people write it elsewhere.
bool is_known_word(std::string_view word, Where where);

/// What to do instead of a line that no one line replaces; empty where no row knows it.
Message advise(const Tokens& line, const Surroundings& around);

/// Says of lines that cannot be read which of their words belong to another language, and what ours
/// does instead: it is what the person did.
void say_foreign(std::string_view text, Language language, std::vector<Diagnostic>& findings);

/// A colour by its name in any of the languages, or `#RRGGBB`: 0xRRGGBB.
std::optional<std::uint32_t> find_colour(const Token& token);

} // namespace orb::repair
