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

/// Longer lines are not looked at.
inline constexpr std::size_t longest_line = 240;

/// How many values stand between the parentheses that token `open` of a line opens; 0 without.
std::size_t values_between(const Tokens& line, std::size_t open);

/// What is around the lines of a text: names, open loops, free letters.
class Scenery {
public:
  Scenery(const Source& source, Language language);

  /// Words of several letters that stand in other lines, too.
  std::vector<std::string_view> words_without(const Tokens& line) const;

  /// Words of several letters that other lines set: `count = 0`.
  std::vector<std::string_view> set_without(const Tokens& line) const;

  /// Variables of one letter that other lines of an orbBasic program use.
  std::vector<std::string_view> letters_without(const Tokens& line) const;

  /// A name that is written once and is near `word`, or means the same: its wrong definition.
  std::optional<std::string> misspelt(std::string_view word,
                                      const std::vector<std::string_view>& known) const;

  /// The number of the line that begins with `name:`, as a label or in a comment, or of the one
  /// below it where that is all; empty without.
  std::string number_of(std::string_view name) const;

  /// The number of an orbBasic line, and of the first one below that has a number and a statement;
  /// empty without.
  std::string number(std::uint32_t line) const;
  std::string number_below(std::uint32_t line) const;

  /// Where other lines of an orbBasic program jump to a number.
  std::vector<Span> jumps_to(std::string_view number) const;

  /// Whether a structured program has a sub or function of that name.
  bool is_sub(std::string_view word) const;

  /// Whether a structured program declares an array of that name.
  bool is_array(std::string_view word) const;

  /// The sub or function of a structured program that a line calls, rightly or not: its first word,
  /// or its second (`call drive`), or all its words (`wait for shake`); empty without.
  std::string sub_of(const Tokens& line) const;

  /// The sub whose name means the same as a word of another language; empty without.
  std::string sub_like(std::string_view word) const;

  /// The only sub that nobody calls, if it takes so many values and `word` is called elsewhere,
  /// too: it was meant to have that name. Empty without.
  std::string sub_for(std::string_view word, std::size_t values) const;

  /// The sub that a call with so many values can only mean, whatever it says: the only one that
  /// nobody calls yet, or the only one that takes as many; empty without.
  std::string sub_meant(std::size_t values) const;

  Surroundings around(std::uint32_t line, const SplitLine& parts) const;

  /// Variables that nobody uses; first those that only a `next` names.
  std::vector<std::string> free_letters() const;

private:
  struct Jump {
    std::string to;
    std::uint32_t begin = 0; ///< where the number stands
    bool calls = false;      ///< `gosub`
  };
  /// Keeps where a line of orbBasic leads.
  void note_jumps(std::uint32_t line, const Tokens& tokens);
  /// Whether a subroutine begins above a line, without a way out before it, and another one or
  /// nothing stands below.
  bool ends_sub(std::uint32_t line) const;

  /// Words that other lines have: those of one letter, or of several.
  std::vector<std::string_view> others(const Tokens& line, bool letters) const;

  struct Sub {
    std::string name;
    std::size_t takes = 0; ///< values
  };
  /// The one sub for which `fits` is true; null where it is true for none or for several.
  const Sub* only_sub(const std::function<bool(const Sub&)>& fits) const;
  /// The one sub that nobody calls; null without, or with several.
  const Sub* uncalled() const;

  struct Roll {
    std::uint32_t line = 0;
    int heading = 0;  ///< 0 where it is no number
    std::string pace; ///< empty where the ball rests
  };
  /// Keeps what a line that drives sets.
  void note_roll(std::uint32_t line, Tokens tokens);

  /// What a line begins or ends, to structured programs and macros.
  void open_or_close(const Tokens& line);

  const Source& source_;
  Language language_;
  std::vector<std::string> open_;     ///< what ends the blocks that are open, the innermost last
  std::vector<std::string> closers_;  ///< of each line: what ends the block that it is in
  std::vector<bool> in_function_;     ///< of each line
  std::vector<std::string> counting_; ///< the variables of loops that are open
  std::vector<std::string> loops_;    ///< of each line: that of the innermost loop that it is in
  std::vector<Roll> rolls_;           ///< from the top
  std::vector<std::string> labels_;   ///< of a structured program
  std::vector<Jump> jumps_;           ///< of orbBasic
  std::vector<Sub> subs_;             ///< and its subs and functions
  std::set<std::string> arrays_;      ///< in lower case
  std::map<std::string, std::size_t> words_;
  std::map<std::string, std::size_t> set_; ///< those before a `=`, with how often
};

} // namespace orb::repair
