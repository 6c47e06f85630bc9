#include "repair/search.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/idioms.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace orb::repair {
namespace {

/// Collects the changes of one line. Large because each kind of change has its own member.
class ChangeCollector {
public:
  ChangeCollector(const Tokens& line, Language language, std::span<const std::string_view> words,
                  std::span<const std::string_view> names)
      : line_(line), language_(language), words_(words), names_(names) {
    for (const auto& token : line) {
      open_brackets_ += token.is("[") ? 1 : token.is("]") ? -1 : 0;
      commas_ += token.is(",") ? 1 : 0;
    }
  }

  std::vector<Candidate> all() {
    for (std::size_t i = 0; i < line_.size(); ++i) {
      near_words(i);
      near_number(i);
      unquoted(i);
      split(i);
      left_out(i);
      other_sign(i);
      if (i + 1 < line_.size()) {
        joined(i);
        swapped(i);
      }
    }
    for (std::size_t i = 1; i <= line_.size(); ++i)
      inserted(i);
    closed();
    prompt();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    return std::move(found_);
  }

private:
  void add(const Tokens& tokens, int cost) { found_.push_back({join(tokens), cost}); }

  bool is_known(std::string_view word) const {
    const auto same = [&](std::string_view one) {
      return language_ == Language::Basic ? one == word : equal_words(one, word);
    };
    return std::any_of(words_.begin(), words_.end(), same) ||
           std::any_of(names_.begin(), names_.end(), same);
  }

  /// The set of letters in a word, one bit each.
  static std::uint32_t letters_of(std::string_view word) {
    std::uint32_t all = 0;
    for (const char c : word)
      all |= 1U << (static_cast<unsigned char>(to_lower(c)) & 31U);
    return all;
  }

  /// True if two words have the same letters, and the same first one: `daley` and `delay`.
  static bool is_anagram(std::string_view word, std::string_view other) {
    constexpr std::size_t shortest = 4;
    auto a = lower(word);
    auto b = lower(other);
    if (a.size() < shortest || a.size() != b.size() || a[0] != b[0])
      return false;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  }

  void near_words(std::size_t i) {
    const auto& word = line_[i];
    if (!word.is_word() || word.text.size() < 2 || word.text.size() > 31 || is_known(word.text) ||
        looks_like_digits(word.text)) // `3OO`
      return;
    const bool elsewhere = i == 0 && language_ == Language::Basic && // not misspelt: `wend`
                           is_known_word(word.text, Where::Line);
    const auto letters = letters_of(word.text);
    const auto bare = word.text.substr(0, word.text.find_last_not_of("0123456789") + 1);
    for (const auto& list : {words_, names_})
      for (const auto other : list) {
        if (other.size() < 2 || other.size() > word.text.size() + 2 ||
            word.text.size() > other.size() + 2 ||
            std::popcount(letters ^ letters_of(other)) > 4 || // each edit changes two at most
            (bare.size() < word.text.size() && equal_words(bare, other))) // `delay9` has a value
          continue;
        const auto distance =
            is_anagram(word.text, other) ? std::size_t{1} : edit_distance(word.text, other);
        const auto size = std::max(word.text.size(), other.size());
        if ((elsewhere && distance > 0 && list.data() == words_.data()) || distance > 2 ||
            distance * 3 > size + (size == 2 ? 1 : 0))
          continue;
        const bool initial = to_lower(word.text[0]) == to_lower(other[0]);
        auto changed = line_;
        changed[i].text = other;
        add(changed, static_cast<int>(distance == 0 ? 1 : distance * 6 + (initial ? 0 : 3)));
      }
  }

  /// Replaces some tokens by a number.
  void number_instead(std::size_t i, std::string text, std::size_t tokens, int cost) {
    auto changed = line_;
    changed[i].kind = Token::Kind::Number;
    changed[i].text = std::move(text);
    const auto next = changed.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    changed.erase(next, next + static_cast<std::ptrdiff_t>(tokens) - 1);
    add(changed, cost);
  }

  /// Proposes numbers for a malformed one.
  void near_number(std::size_t i) {
    const auto& text = line_[i].text;
    const bool number = line_[i].is_number();
    const bool goes_on = i + 1 < line_.size() && line_[i + 1].is_word() && !line_[i + 1].gap;
    if (line_[i].is_word() && text.size() > 1 && to_lower(text[0]) == 'x' &&
        is_count(std::string_view(text).substr(1)))
      number_instead(i, text.substr(1), 1, 3); // `x2`: twice
    const auto point = text.find('.');
    constexpr auto of_several = std::to_array<std::string_view>(
        {"RGB", "goroll", "roll", "fade", "raw", "locate", "data"}); // they take several values
    const bool several = std::any_of(of_several.begin(), of_several.end(),
                                     [&](auto word) { return equal_words(line_[0].text, word); });
    if (number && several && point != std::string::npos && point > 0 && point + 1 < text.size())
      two_numbers(i, point);
    if (number && point != std::string::npos &&
        text.find_first_not_of('0', point + 1) == std::string::npos)
      number_instead(i, text.substr(0, point), 1, 8); // `3.0`, which of times is in seconds
    if (number && i + 1 < line_.size() && line_[i + 1].is_number() && text[0] != '0' &&
        (line_[i + 1].text.find_first_not_of('0') == std::string::npos || commas_ > 1) &&
        !line_[0].is("data"))
      number_instead(i, text + line_[i + 1].text, 2, 5); // `70 0`, and `0,2 55,U` of a list
    if (number && goes_on)
      wrong_ending(i);
    letters_for_digits(i, number && goes_on);
  }

  /// `40.140` for `40,140`.
  void two_numbers(std::size_t i, std::size_t point) {
    auto changed = line_;
    changed[i].text = line_[i].text.substr(0, point);
    Token comma;
    comma.kind = Token::Kind::Sign;
    comma.text = ",";
    auto second = line_[i];
    second.text = line_[i].text.substr(point + 1);
    second.gap = true;
    const auto next = changed.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    changed.insert(next, {comma, second});
    add(changed, 10);
  }

  /// `1ss`, `20mss`, `500sm`, and C suffixes: `1000UL`.
  void wrong_ending(std::size_t i) {
    const auto& ending = line_[i + 1].text;
    if (ending.size() > 2 && ending[0] == '_' && is_count(std::string_view(ending).substr(1)))
      number_instead(i, line_[i].text + ending.substr(1), 2, 3); // `1_280ms`
    if (ending.size() == 2 && to_lower(ending[0]) == 'e' && ending[1] > '0' && ending[1] < '7')
      number_instead(i, line_[i].text + std::string(static_cast<std::size_t>(ending[1] - '0'), '0'),
                     2, 3); // `1e3`
    if (ending.find_first_not_of("uUlLfF") == std::string::npos)
      number_instead(i, line_[i].text, 2, 3);
    if (language_ == Language::Basic)
      return;
    auto unit = ending;
    if (unit == "sm" || unit == "mc") // exchanged
      return number_instead(i, line_[i].text + std::string(unit.rbegin(), unit.rend()), 2, 6);
    while (unit.size() > 1 && milliseconds_of(unit) == 0)
      unit.pop_back();
    if (milliseconds_of(unit) > 0)
      number_instead(i, line_[i].text + unit, 2, 6);
  }

  /// `l00`, `2O0`, `7O0ms` and `ls`: letters that look like digits; a single `O`.
  void letters_for_digits(std::size_t i, bool goes_on) {
    const auto& text = line_[i].text;
    const bool units = language_ != Language::Basic;
    if (i > 0 && units && (text == "O" || text == "o" || text == "l") && !is_known(text))
      number_instead(i, as_digits(text), 1, 6);
    if (i > 0 && units && (text == "ls" || text == "Is" || text == "lm") && !is_known(text))
      number_instead(i, as_digits(text.substr(0, 1)) + text[1], 1, 6);
    if (line_[i].is_number() ? !goes_on : !line_[i].is_word() || text.size() < 2)
      return;
    auto written = text + (goes_on ? line_[i + 1].text : "");
    std::string unit;
    if (const auto end = written.find_last_of("0123456789oOIl") + 1;
        units && milliseconds_of(std::string_view(written).substr(end)) > 0) {
      unit = written.substr(end);
      written.resize(end);
    }
    const auto digits = as_digits(written);
    if (std::any_of(text.begin(), text.end(), is_digit) &&
        std::all_of(digits.begin(), digits.end(), is_digit))
      number_instead(i, digits + unit, goes_on ? 2 : 1, 3);
  }

  /// `"7"` and `"500ms"` in place of a value.
  void unquoted(std::size_t i) {
    const auto& token = line_[i];
    if (!token.is_text() || token.text.empty() || line_[0].is("print") || !is_count(token.text))
      return;
    auto changed = line_;
    changed[i].kind = Token::Kind::Number;
    add(changed, 4);
  }

  /// True for digits, with a unit if the language has units: `1s`.
  bool is_count(std::string_view text) const {
    const auto unit = text.find_first_not_of("0123456789");
    return unit == std::string_view::npos ||
           (unit > 0 && language_ != Language::Basic && milliseconds_of(text.substr(unit)) > 0);
  }

  void split(std::size_t i) {
    const auto& word = line_[i];
    if (!word.is_word() || is_known(word.text))
      return;
    for (std::size_t n = 2; n < word.text.size(); ++n) {
      const auto left = std::string_view(word.text).substr(0, n);
      auto right = std::string_view(word.text).substr(n);
      if (right.size() > 1 && right[0] == '_')
        right.remove_prefix(1);
      const bool value = is_count(right) || is_known(right) ||
                         (right.size() == 1 && is_letter(right[0]) &&
                          (language_ == Language::Structured ||
                           (language_ == Language::Basic && to_lower(right[0]) != right[0])));
      const auto meant = value ? statement_called(left, is_count(right)) : std::string_view();
      if (meant.empty())
        continue;
      auto changed = line_;
      changed[i].text = meant;
      Token rest;
      rest.kind = is_digit(right[0]) ? Token::Kind::Number : Token::Kind::Word;
      rest.text = right;
      rest.gap = true;
      changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
      add(changed, 1);
    }
  }

  /// The word of the language equal to `left`, or close to it before a number: `dleay2s`.
  std::string_view statement_called(std::string_view left, bool nearly) const {
    for (const auto one : words_)
      if (equal_words(one, left))
        return one;
    constexpr std::size_t shortest = 4;
    if (nearly && left.size() >= shortest)
      for (const auto one : words_)
        if (one.size() >= shortest && edit_distance(one, left) == 1)
          return one;
    return {};
  }

  void joined(std::size_t i) {
    const auto& a = line_[i];
    const auto& b = line_[i + 1];
    if (!a.is_word() || !(b.is_word() || b.is("_") || b.is("-")))
      return;
    if (language_ == Language::Structured && b.is("-") && !b.gap && i + 2 < line_.size() &&
        line_[i + 2].is_word() && !line_[i + 2].gap &&
        (!is_known(a.text) || is_known(a.text + "_" + line_[i + 2].text))) {
      auto changed = line_; // a name with a hyphen
      changed[i].text = a.text + "_" + line_[i + 2].text;
      const auto next = changed.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      changed.erase(next, next + 2);
      add(changed, 5);
    }
    for (const auto* between : {"", "_"})
      joined_by(between, i);
  }

  /// `sub wait for shake` if other lines call it `wait_for_shake`.
  void joined_by(std::string_view between, std::size_t first) {
    constexpr std::size_t most_words = 4;
    const auto end = std::min(line_.size(), first + most_words);
    auto name = line_[first].text;
    for (auto i = first + 1; i < end && line_[i].is_word(); ++i) {
      name += std::string(between) + line_[i].text;
      auto known = spelling_of(name);
      if (known.empty() && i == first + 1 && !is_known(line_[i].text)) // `go ot 20`
        known = word_exchanged(name);
      if (known.empty())
        continue;
      auto changed = line_;
      changed[first].text = known;
      const auto next = changed.begin() + static_cast<std::ptrdiff_t>(first) + 1;
      changed.erase(next, next + static_cast<std::ptrdiff_t>(i - first));
      add(changed, 3);
    }
  }

  /// The word of the language that has the same letters as a word; empty if there is none.
  std::string_view word_exchanged(std::string_view word) const {
    const auto found = std::find_if(words_.begin(), words_.end(),
                                    [&](std::string_view one) { return is_anagram(word, one); });
    return found == words_.end() ? std::string_view() : *found;
  }

  /// The spelling of a word of the language or of other lines; empty if it is unknown.
  std::string_view spelling_of(std::string_view word) const {
    for (const auto& list : {words_, names_})
      for (const auto one : list)
        if (equal_words(one, word))
          return one;
    return {};
  }

  void left_out(std::size_t i) {
    const auto& token = line_[i];
    const bool twice = i > 0 && !token.is_number() && line_[i - 1].text == token.text;
    const std::string_view idle = // signs without a computation
        language_ == Language::Basic ? "()[]{},;:.'#@\\_" : "()[],;:.'#@\\_";
    constexpr std::string_view kinds = "%!&"; // type suffixes of a name
    const bool one = token.kind == Token::Kind::Sign && token.text.size() == 1;
    const bool is_kind = one && i > 0 && line_[i - 1].is_word() && !token.gap &&
                         (kinds.find(token.text[0]) != std::string_view::npos ||
                          (token.is("$") && !line_[0].is("print"))); // prints as a text
    const bool indexes = token.is("[") && i > 0 && line_[i - 1].is_word() && !token.gap;
    const bool is_idle =
        (one && !indexes && idle.find(token.text[0]) != std::string_view::npos) || is_kind;
    // Fewer values are never intended: remove a comma only if no value follows it.
    const bool parts_values = token.is(",") && i > 1 && i + 1 < line_.size() &&
                              (line_[i + 1].is_number() || line_[i + 1].text.size() == 1) &&
                              !line_[i - 1].is(",") && !line_[i + 1].is(",") &&
                              !line_[i + 1].is(")");
    const bool parts_numbers = !token.is("(") && !token.is(")") && i > 0 && i + 1 < line_.size() &&
                               line_[i - 1].is_number() && line_[i + 1].is_number();
    if (token.is_text() || parts_numbers || parts_values || (!twice && !is_idle))
      return;
    auto changed = line_;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
    if (i < changed.size() && i > 0)
      changed[i].gap = changed[i].gap || token.gap;
    add(changed, twice ? 4 : token.is("(") || token.is(")") ? 11 : 9);
  }

  void other_sign(std::size_t i) {
    const auto& token = line_[i];
    const auto become = [&](std::string_view other, int cost) {
      auto changed = line_;
      changed[i].text = other;
      add(changed, cost);
    };
    if (token.is(";") || token.is(".") || token.is(":") || token.is("/"))
      become(",", 8);
    else if (token.is("[") || token.is("{"))
      become("(", 8);
    else if (token.is("]") || token.is("}"))
      become(")", 8);
    else if (token.is("-") || token.is(":"))
      become("=", 14);
  }

  void swapped(std::size_t i) {
    if ((line_[i].is_number() && line_[i + 1].is_number()) || line_[i].is("$") ||
        line_[i + 1].is("$"))
      return; // `A$` is a text elsewhere
    const auto parts_numbers = [&](std::size_t at) {
      return line_[at].is(",") && at > 0 && at + 1 < line_.size() && line_[at - 1].is_number() &&
             line_[at + 1].is_number();
    };
    if (parts_numbers(i) || parts_numbers(i + 1))
      return;
    if (!(line_[i].kind == Token::Kind::Sign) == !(line_[i + 1].kind == Token::Kind::Sign) &&
        line_[i].kind != Token::Kind::Sign)
      return;
    auto changed = line_;
    std::swap(changed[i], changed[i + 1]);
    std::swap(changed[i].gap, changed[i + 1].gap);
    add(changed, 13);
  }

  void insert(std::size_t at, std::string_view text, int cost, Token::Kind kind) {
    auto changed = line_;
    Token token;
    token.kind = kind;
    token.text = text;
    token.gap = kind == Token::Kind::Word || text == "=";
    if (at < changed.size() && (token.gap || text == ","))
      changed[at].gap = true;
    else if (at < changed.size() && text == "(")
      std::swap(token.gap, changed[at].gap);
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(at), token);
    add(changed, cost);
  }

  void inserted(std::size_t at) {
    const auto& before = line_[at - 1];
    const bool value_before = before.is_number() || before.is(")") || before.is_word();
    if (at < line_.size()) {
      const auto& after = line_[at];
      const bool value_after = after.is_number() || after.is_word() || after.is("(");
      if (value_before && value_after) {
        insert(at, ",", 9, Token::Kind::Sign);
        const bool calls = after.is("(") && !after.gap;
        const bool sets = at > 1 || before.text.size() == 1 ||
                          (is_known(before.text) && !is_known_word(before.text, Where::Line));
        if (wants_relation(at) && sets && !calls)
          insert(at, "=", 14, Token::Kind::Sign);
        insert(at, "to", 14, Token::Kind::Word);
      }
      if ((value_before) && after.is_word() && line_[0].is("if"))
        insert(at, "then", 8, Token::Kind::Word);
      if (value_after || after.is("-"))
        insert(at, "(", 12, Token::Kind::Sign);
    }
    if (value_before)
      insert(at, ")",
             at == line_.size()  ? 8
             : ends_sum(at)      ? 5
             : line_[at].is(",") ? 7
                                 : 11,
             Token::Kind::Sign);
    if (value_before && open_brackets_ > 0)
      insert(at, "]", at == line_.size() ? 8 : 11, Token::Kind::Sign);
  }

  /// True if the next operator needs an unclosed sum in parentheses: `(H + 90 % 360`.
  bool ends_sum(std::size_t at) const {
    if (at == line_.size() || !(line_[at].is("%") || line_[at].is("*") || line_[at].is("/")))
      return false;
    int closed = 0;
    bool sum = false;
    for (auto i = at; i-- > 0 && closed >= 0;) {
      closed += line_[i].is(")") ? 1 : line_[i].is("(") ? -1 : 0;
      sum = sum || (closed == 0 && (line_[i].is("+") || line_[i].is("-")));
      if (line_[i].is(","))
        return false;
    }
    return sum && closed < 0;
  }

  /// True if a `=` may be missing: an assignment and a `for` have one, a condition has its own.
  bool wants_relation(std::size_t at) const {
    const bool condition =
        line_[0].is("if") || line_[0].is("while") || line_[0].is("until") || line_[0].is("elseif");
    const bool related = std::any_of(line_.begin(), line_.begin() + static_cast<std::ptrdiff_t>(at),
                                     [](const Token& token) { return token.is_relation(); });
    return condition || !related;
  }

  /// `> 10 LEDC 1`: copied from an interactive prompt.
  void prompt() {
    if (language_ == Language::Basic && line_.size() > 2 && line_[0].is(">") &&
        line_[1].is_number())
      add(slice(line_, 1), 1);
  }

  /// `print hello"`: the opening quote is missing, or the closing one is extra.
  void closed() {
    if (line_.empty() || !line_.back().is_text() || line_.back().closed ||
        !line_.back().text.empty())
      return;
    add(Tokens(line_.begin(), line_.end() - 1), 6);
    const std::size_t most = language_ == Language::Test ? 2 : 1; // words before a text
    for (std::size_t i = 1; i + 1 < line_.size() && i <= most; ++i) {
      auto changed = slice(line_, 0, i);
      Token token;
      token.kind = Token::Kind::Text;
      token.text = join(slice(line_, i, line_.size() - 1));
      token.gap = true;
      changed.push_back(token);
      add(changed, 5);
    }
  }

  const Tokens& line_;
  Language language_;
  std::span<const std::string_view> words_;
  std::span<const std::string_view> names_;
  int open_brackets_ = 0; ///< `[` without a `]`
  int commas_ = 0;
  std::vector<Candidate> found_;
};

} // namespace

std::vector<Candidate> changes(const Tokens& line, Language language,
                               std::span<const std::string_view> words,
                               std::span<const std::string_view> names) {
  return ChangeCollector(line, language, words, names).all();
}

} // namespace orb::repair
