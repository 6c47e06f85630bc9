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

// Idioms of other languages, as patterns with holes: the rows of repair/idioms.def.
//
// A pattern is literal words and signs (case does not count; `a|b`: one of them; ` ;; ` separates
// whole patterns) and holes: `$n $m` a number, `$q $p` a number with a unit or an operand, `$o` an
// operand, `$w` a word,
// `$v` a variable or element, `$t` a text, `$k` a colour, `$c $d` a condition, `$l` a list, `$r`
// anything or nothing, every other letter an expression. The replacement names the holes in braces,
// optionally through a function: `{sec:q}` (repair/fill.cpp).

namespace orb::repair {

enum class Where : std::uint8_t {
  Inside, ///< anywhere in a line
  Line,   ///< a whole statement: the line, or a branch of an `if`
};

struct Idiom {
  Where where;
  std::string_view patterns;
  std::string_view basic;
  std::string_view structured; ///< `=`: as in `basic`; empty: it cannot be expressed
  std::string_view macro;
  std::string_view test;
  const orb::Text* note = nullptr; ///< a remark shown beside the line; null: none
};

/// The context of a line, as far as rewrites depend on it.
struct Surroundings {
  Language language = Language::Basic;
  std::string line_number;             ///< of an orbBasic line
  std::string first_number;            ///< of the program's first line, if it is another one
  std::string free_letter;             ///< an unused variable; empty: none
  std::string loop;                    ///< the variable of the innermost open `for`
  std::string number_below;            ///< of the next line; empty if it is the last
  int heading = 0;                     ///< of the last roll above, if it is a number
  std::string steering;                ///< its variable; empty if it is none
  std::string pace;                    ///< its speed; empty if the ball rests
  std::string label;                   ///< of a structured program, if it has exactly one
  bool in_function = false;            ///< of a structured program
  bool ends_sub = false;               ///< the last line of a `gosub` target, in orbBasic
  std::string closer;                  ///< the end of the innermost open block
  std::vector<std::string_view> names; ///< used by other lines, too; in orbBasic: assigned by them
  std::vector<std::string_view> elsewhere; ///< all words of other lines
};

/// Advice if no single line is enough.
struct Hint {
  std::string_view patterns;
  const orb::Text* text;
  std::string_view basic;      ///< fillers of the text's holes; empty: no row for orbBasic
  std::string_view structured; ///< the same
  std::string_view macro;      ///< the same
};

/// Words of natural languages that stand for a word of a program.
std::vector<std::string_view> spoken_words();

/// Calls `take` with the rewrite of a line by each matching row, in table order, until it returns
/// true.
void rewrite(const Tokens& line, const Surroundings& around,
             const std::function<bool(const Candidate&)>& take);

struct Bounds {
  int deepest = 0; ///< rows applied in sequence
  std::size_t states = 0;
};

/// The rewrites of fully explored lines, for the same context.
using Rewrites = std::unordered_map<std::string, std::vector<Candidate>>;

/// Calls `take` with rewrites of a line, first by single rows, then by two in sequence, and so on,
/// until it returns true. Skips lines in `seen`; uses and extends the cache `known` of fully
/// explored lines.
void explore(const std::string& line, const Surroundings& around, Bounds bounds,
             std::unordered_set<std::string>& seen, Rewrites& known,
             const std::function<bool(const Candidate&)>& take);

/// The word at a position of a line, as in structured programs: `wenn` is `if`.
std::string word_at(const Tokens& line, std::size_t at);

/// True if patterns of this kind begin with the word, ignoring case.
bool is_known_word(std::string_view word, Where where);

/// Advice for a line that no single line replaces; empty if no row matches.
Message advise(const Tokens& line, const Surroundings& around);

/// Adds to findings about unreadable lines which words belong to another language, and the native
/// replacement.
void say_foreign(std::string_view text, Language language, std::vector<Diagnostic>& findings);

/// Finds a colour by its name in any of the languages, or by `#RRGGBB`, as 0xRRGGBB.
std::optional<std::uint32_t> find_colour(const Token& token);

} // namespace orb::repair
