#pragma once

// Private to repair/.

#include "base/source.h"
#include "repair/idioms.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// Longer lines are skipped.
inline constexpr std::size_t longest_line = 240;

/// The number of values inside the parentheses opened at token `open`; 0 if there are none.
std::size_t values_between(const Tokens& line, std::size_t open);

/// The context of the lines of a text: names, open loops, free letters. Large because each question
/// that a repair asks about the rest of the text has its own member.
class Scenery {
public:
  Scenery(const Source& source, Language language);

  /// Multi-letter words that other lines contain, too.
  std::vector<std::string_view> words_without(const Tokens& line) const;

  /// Multi-letter words that other lines assign: `count = 0`.
  std::vector<std::string_view> set_without(const Tokens& line) const;

  /// A name that occurs once and is close to `word`, or means the same: its misspelt definition.
  std::optional<std::string> misspelt(std::string_view word,
                                      const std::vector<std::string_view>& known) const;

  /// The number of the line that begins with `name:`, as a label or in a comment, or of the next
  /// line if it has nothing else; empty if there is none.
  std::string number_of(std::string_view name) const;

  /// The number of an orbBasic line, and of the first line below with a number and a statement;
  /// empty if there is none.
  std::string number(std::uint32_t line) const;
  std::string number_below(std::uint32_t line) const;

  /// The number of the nearest numbered line above; empty if there is none.
  std::string number_above(std::uint32_t line) const;

  /// The jumps of other orbBasic lines to a number.
  std::vector<Span> jumps_to(std::string_view number) const;

  /// True if a structured program has a sub or function of this name.
  bool is_sub(std::string_view word) const;

  /// True if a structured program declares an array of this name.
  bool is_array(std::string_view word) const;

  /// The sub or function that a line of a structured program calls, correctly or not: by its first
  /// word, its second (`call drive`), or all words (`wait for shake`); empty if there is none.
  std::string sub_of(const Tokens& line) const;

  /// The sub whose name means the same as a foreign word; empty if there is none.
  std::string sub_like(std::string_view word) const;

  /// The only uncalled sub, if it takes this many values and `word` is called elsewhere, too: it
  /// was meant to have that name. Empty otherwise.
  std::string sub_for(std::string_view word, std::size_t values) const;

  /// The only possible sub for a call with this many values, whatever its name: the only uncalled
  /// one, or the only one with that many; empty if ambiguous.
  std::string sub_meant(std::size_t values) const;

  Surroundings around(std::uint32_t line, const SplitLine& parts) const;

  /// Unused variables, first those that only a `next` names.
  std::vector<std::string> free_letters() const;

private:
  struct Jump {
    std::string to;
    std::uint32_t begin = 0; ///< the offset of the number
    bool calls = false;      ///< `gosub`
  };
  /// Records the jumps of a line of orbBasic.
  void note_jumps(std::uint32_t line, const Tokens& tokens);
  /// True if a line ends a subroutine: one begins above without an exit before the line, and
  /// another one or nothing follows.
  bool ends_sub(std::uint32_t line) const;

  struct Sub {
    std::string name;
    std::size_t takes = 0; ///< number of values
  };
  /// The only sub for which `fits` is true; null if there are none or several.
  const Sub* only_sub(const std::function<bool(const Sub&)>& fits) const;
  /// The only uncalled sub; null if there are none or several.
  const Sub* uncalled() const;

  struct Roll {
    std::uint32_t line = 0;
    int heading = 0;      ///< 0 if it is not a number
    std::string steering; ///< the variable that is its heading; empty if it is none
    std::string pace;     ///< empty if the ball rests
  };
  /// Records the values of a drive command.
  void note_roll(std::uint32_t line, Tokens tokens);

  /// Tracks the blocks that a line opens or closes, in structured programs and macros.
  void open_or_close(const Tokens& line);

  const Source& source_;
  Language language_;
  std::vector<std::string> open_;     ///< the ends of the open blocks, innermost last
  std::vector<std::string> closers_;  ///< by line: the end of the enclosing block
  std::vector<bool> in_function_;     ///< by line
  std::vector<std::string> counting_; ///< variables of the open loops
  std::vector<std::string> loops_;    ///< by line: the variable of the innermost loop
  std::vector<Roll> rolls_;           ///< top down
  std::vector<std::string> labels_;   ///< of a structured program
  std::vector<Jump> jumps_;           ///< of a numbered program
  std::vector<Sub> subs_;             ///< of a structured program, with its functions
  std::set<std::string> arrays_;      ///< in lower case
  std::map<std::string, std::size_t> words_;
  std::map<std::string, std::size_t> set_; ///< assigned names and how often
};

} // namespace orb::repair
