#pragma once

#include "base/text/text.h"
#include "repair/fill.h"
#include "repair/idioms.h"
#include "repair/word_index.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// One element of a pattern.
struct Part {
  char hole = '\0';
  std::vector<std::string> literals; ///< alternatives, unless it is a hole
  bool may_lack = false;             ///< a comma of a macro
};

/// One pattern in its parts.
struct Pattern {
  std::vector<Part> parts;
  std::vector<std::uint64_t> needs; ///< a matching line has a bit of each of these
  std::uint64_t first = 0;          ///< the bits of the first part; 0 for a hole
  const Idiom* idiom = nullptr;
  std::string_view meaning; ///< for a word
};

/// Words that separate parts of a line and so never occur in a value.
inline bool parts_line(const Token& token) {
  constexpr auto parting = std::to_array<std::string_view>(
      {"then", "else", "to", "step", "and", "or", "if", "goto", "gosub", "do"});
  return token.is_word() && std::any_of(parting.begin(), parting.end(), [&](std::string_view word) {
           return word.size() == token.text.size() && equal_words(token.text, word);
         });
}

/// Facts about the tokens of a line, computed once for all patterns.
struct MatchedLine {
  explicit MatchedLine(const Tokens& given) : tokens(given), depth{0} {
    for (const auto& token : tokens) {
      const int step = token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
      depth.push_back(depth.back() + step);
      parts.push_back(parts_line(token));
      ends_value.push_back(token.is_text() || parts.back() || token.is(";") || token.is("{") ||
                           token.is("}") || token.is(":"));
      ends_condition.push_back(token.is("then") || token.is("else") || token.is_text() ||
                               token.is("goto") || token.is("{"));
    }
  }

  const Tokens& tokens;
  std::vector<int> depth;  ///< bracket depth before each token and after the last one
  std::vector<bool> parts; ///< as in parts_line()
  std::vector<bool> ends_value;
  std::vector<bool> ends_condition;
};

/// Matches a pattern against the tokens of a line.
class Matcher {
public:
  /// A match may end anywhere.
  explicit Matcher(const MatchedLine& line)
      : line_(line), tokens_(line.tokens), end_(line.tokens.size()), whole_(false) {}
  /// A match ends at `end`.
  Matcher(const MatchedLine& line, std::size_t end)
      : line_(line), tokens_(line.tokens), end_(end), whole_(true) {}

  /// The end of a match that begins at `at`; 0 if there is none.
  std::size_t match(const Pattern& pattern, std::size_t at) {
    spans_.clear();
    choice_ = {};
    steps_ = 0;
    return from(pattern, 0, at);
  }

  /// The contents of the holes of the last match.
  Holes holes() const {
    Holes holes;
    for (const auto& [hole, begin, end] : spans_)
      holes[hole] = slice(tokens_, begin, end);
    if (choice_.end > 0) {
      holes.choice = lower(tokens_[choice_.begin].text);
      holes.rest = slice(tokens_, choice_.begin, choice_.end);
    }
    return holes;
  }

private:
  static constexpr int most_steps = 1000;

  struct HoleSpan {
    char hole = '\0';
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  std::size_t from(const Pattern& pattern, std::size_t part, std::size_t at) {
    if (++steps_ > most_steps)
      return 0;
    if (part == pattern.parts.size())
      return !whole_ || at == end_ ? at : 0;
    const auto& here = pattern.parts[part];
    if (here.hole == '\0')
      return here.may_lack && at > 0 && at < end_ && tokens_[at].kind != Token::Kind::Sign
                 ? from(pattern, part + 1, at)
                 : literal(pattern, part, at);
    const auto most = extent(here.hole, at);
    const std::size_t least = here.hole == 'r' ? at : at + 1;
    const bool last = part + 1 == pattern.parts.size();
    if (most < least)
      return 0;
    for (std::size_t n = 0; n <= most - least; ++n) {
      const auto stop = last ? most - n : least + n;
      if (!balanced(at, stop) || !fits(here.hole, at, stop))
        continue;
      const auto found = from(pattern, part + 1, stop);
      if (found == 0 && !(here.hole == 'r' && stop == 0 && last && whole_ && end_ == 0))
        continue;
      spans_.push_back({here.hole, at, stop});
      return found;
    }
    return 0;
  }

  std::size_t literal(const Pattern& pattern, std::size_t part, std::size_t at) {
    if (at >= end_ || tokens_[at].is_text())
      return 0;
    const auto& literals = pattern.parts[part].literals;
    const auto found = std::find_if(literals.begin(), literals.end(), [&](const std::string& one) {
      return equal_words(one, tokens_[at].text);
    });
    if (found == literals.end())
      return 0;
    const auto stop = from(pattern, part + 1, at + 1);
    if (stop != 0 && literals.size() > 1) // the first literal is found last
      choice_ = {'\0', at, stop};
    return stop;
  }

  /// The maximum end of a hole: before an unbalanced closing bracket and before the end of its
  /// kind.
  std::size_t extent(char hole, std::size_t at) const {
    if (is_among("nmwtk", hole))
      return std::min(end_, at + 1);
    const bool condition = is_among("cd", hole);
    const bool value = !condition && !is_among("rljopv", hole);
    auto end = at;
    while (end < end_ && line_.depth[end + 1] >= line_.depth[at] &&
           !(condition && line_.ends_condition[end]) && !(value && line_.ends_value[end]))
      ++end;
    return end;
  }

  static bool is_among(std::string_view holes, char hole) {
    return holes.find(hole) != std::string_view::npos;
  }

  /// True for `step()`, a common name of a sub or a macro.
  bool is_called_step(std::size_t at) const {
    return at == 0 && tokens_.size() > 2 && tokens_[0].is("step") && tokens_[1].is("(");
  }

  /// Requires a range within extent().
  bool balanced(std::size_t begin, std::size_t end) const {
    return line_.depth[begin] == line_.depth[end];
  }

  bool is_operand(std::size_t begin, std::size_t end) const {
    const auto& first = tokens_[begin];
    if (end == begin + 1)
      return first.is_word() ? !line_.parts[begin] : first.is_number();
    return (first.is("(") || (first.is_word() && !line_.parts[begin] &&
                              (tokens_[begin + 1].is("(") || tokens_[begin + 1].is("[")))) &&
           (tokens_[end - 1].is(")") || tokens_[end - 1].is("]"));
  }

  /// True for a value within extent(): no commas or comparisons outside parentheses, and no two
  /// adjacent values.
  bool is_value(std::size_t begin, std::size_t end) const {
    int depth = 0;
    for (auto i = begin; i < end; ++i) {
      const auto& token = tokens_[i];
      depth += token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
      if (depth == 0 && (token.is(",") || token.is_relation()))
        return false;
      const bool value = token.is_word() || token.is_number();
      const bool before = i > begin && tokens_[i - 1].is_number();
      if (value && before)
        return false;
    }
    const auto& last = tokens_[end - 1];
    return last.kind != Token::Kind::Sign || last.is(")") || last.is("]");
  }

  /// True if a hole can hold this range within its extent().
  bool fits(char hole, std::size_t begin, std::size_t end) const {
    if (hole == 'r')
      return true;
    const auto& first = tokens_[begin];
    switch (hole) {
    case 'n':
    case 'm': return first.is_number();
    case 'w': return first.is_word() && (!line_.parts[begin] || is_called_step(begin));
    case 't': return first.is_text();
    case 'k': return find_colour(first).has_value();
    case 'o':
    case 'p': return (hole == 'p' && is_time(begin, end)) || is_operand(begin, end);
    case 'q': return is_time(begin, end) || is_value(begin, end);
    case 'v':
      return first.is_word() && !line_.parts[begin] &&
             (end == begin + 1 || (tokens_[begin + 1].is("[") && tokens_[end - 1].is("]")));
    case 'c':
    case 'd':
    case 'l': return true;
    case 'j': // a single word is a label
      return end > begin + 1 && !line_.parts[begin] && !first.is("for") && !first.is("while") &&
             !first.is("}");
    default: return is_value(begin, end);
    }
  }

  /// True for a number with a unit, or with a decimal comma.
  bool is_time(std::size_t begin, std::size_t end) const {
    if (!tokens_[begin].is_number())
      return false;
    auto at = begin + 1;
    if (at + 1 < end && tokens_[at].is(",") && tokens_[at + 1].is_number() && !tokens_[at + 1].gap)
      at += 2;
    return at == end || (at + 1 == end && tokens_[at].is_word());
  }

  const MatchedLine& line_;
  const Tokens& tokens_;
  std::size_t end_;
  bool whole_;
  std::vector<HoleSpan> spans_;
  HoleSpan choice_;
  int steps_ = 0;
};

} // namespace orb::repair
