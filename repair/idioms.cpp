#include "repair/idioms.h"

#include "base/text.h"
#include "repair/fill.h"

#include <algorithm>
#include <array>
#include <set>

namespace orb::repair {
namespace {

struct ForeignWord {
  std::string_view meaning;
  std::string_view patterns;
};
constexpr auto words = std::to_array<ForeignWord>({
#define ORB_WORD(meaning, patterns) {meaning, patterns},
#include "repair/idioms.def"
});
/// The columns of a row lie in one text: an address of each would be as long as the table again.
constexpr auto idiom_rows = std::to_array<std::string_view>({
#define ORB_IDIOM(where, patterns, basic, structured, macro, test, note)                           \
#where "\x1f" patterns "\x1f" basic "\x1f" structured "\x1f" macro "\x1f" test "\x1f" note,
#include "repair/idioms.def"
});

constexpr auto hints = std::to_array<Hint>({
#define ORB_HINT(patterns, basic, structured) {patterns, basic, structured},
#include "repair/idioms.def"
});

/// One place of a pattern.
struct Part {
  char hole = '\0';
  std::vector<std::string> literals; ///< one of these, where it is no hole
  bool may_lack = false;             ///< a comma of a macro
};

struct Pattern {
  std::vector<Part> parts;
  std::vector<std::uint64_t> needs; ///< a line without a bit of each of these cannot fit
  std::uint64_t first = 0;          ///< the bits of what it begins with; 0 for a hole
  const Idiom* idiom = nullptr;
  std::string_view meaning; ///< of a word
};

std::uint64_t bit_of(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(to_lower(c))) * 16777619U;
  return std::uint64_t{1} << (hash >> 26);
}

std::vector<std::string_view> pieces(std::string_view text, std::string_view between) {
  std::vector<std::string_view> all;
  while (true) {
    const auto end = text.find(between);
    all.push_back(text.substr(0, end));
    if (end == std::string_view::npos)
      return all;
    text.remove_prefix(end + between.size());
  }
}

const std::vector<Idiom>& idioms() {
  static const auto all = [] {
    std::vector<Idiom> rows;
    for (const auto row : idiom_rows) {
      const auto columns = pieces(row, "\x1f");
      rows.push_back({columns[0] == "Line" ? Where::Line : Where::Inside, columns[1], columns[2],
                      columns[3], columns[4], columns[5], columns[6]});
    }
    return rows;
  }();
  return all;
}

Part part_of(std::string_view text) {
  Part part;
  if (text.size() == 2 && text[0] == '$' && is_letter(text[1])) {
    part.hole = text[1];
    return part;
  }
  if (text.find_first_not_of('|') == std::string_view::npos)
    part.literals.emplace_back(text);
  else
    for (const auto one : pieces(text, "|"))
      part.literals.emplace_back(one);
  return part;
}

void add_patterns(std::vector<Pattern>& all, std::string_view patterns, const Idiom* idiom,
                  std::string_view meaning, Language language) {
  for (const auto text : pieces(patterns, " ;; ")) {
    Pattern pattern;
    pattern.idiom = idiom;
    pattern.meaning = meaning;
    for (const auto one : pieces(text, " "))
      if (!one.empty())
        pattern.parts.push_back(part_of(one));
    for (std::size_t i = 0; i < pattern.parts.size(); ++i) {
      auto& part = pattern.parts[i];
      part.may_lack = language == Language::Macro && part.literals == std::vector<std::string>{","};
      std::uint64_t bits = 0;
      for (const auto& literal : part.literals)
        bits |= bit_of(literal);
      if (bits != 0 && !part.may_lack)
        pattern.needs.push_back(bits);
      if (i == 0)
        pattern.first = bits;
    }
    all.push_back(std::move(pattern));
  }
}

std::string_view form_of(const Idiom& idiom, Language language) {
  const auto form = language == Language::Basic        ? idiom.basic
                    : language == Language::Structured ? idiom.structured
                    : language == Language::Macro      ? idiom.macro
                                                       : idiom.test;
  return form == "=" ? idiom.basic : form;
}

/// The patterns that a language has an answer to.
const std::vector<Pattern>& patterns_of(Language language) {
  static const auto all = [] {
    std::array<std::vector<Pattern>, 4> each;
    for (std::size_t i = 0; i < each.size(); ++i) {
      for (const auto& word : words)
        add_patterns(each[i], word.patterns, nullptr, word.meaning, static_cast<Language>(i));
      for (const auto& idiom : idioms())
        if (!form_of(idiom, static_cast<Language>(i)).empty())
          add_patterns(each[i], idiom.patterns, &idiom, {}, static_cast<Language>(i));
    }
    return each;
  }();
  return all[static_cast<std::size_t>(language)];
}

/// The patterns of hints that a language has, each with its text as the meaning.
const std::vector<Pattern>& hints_of(Language language) {
  static const auto all = [] {
    std::array<std::vector<Pattern>, 2> each;
    for (const auto& hint : hints) {
      if (!hint.basic.empty())
        add_patterns(each[0], hint.patterns, nullptr, hint.basic, Language::Basic);
      if (!hint.structured.empty())
        add_patterns(each[1], hint.patterns, nullptr, hint.structured, Language::Structured);
    }
    return each;
  }();
  static const std::vector<Pattern> none;
  return language == Language::Basic ? all[0] : language == Language::Structured ? all[1] : none;
}

std::string lower(std::string_view word) {
  std::string small(word);
  std::transform(small.begin(), small.end(), small.begin(), to_lower);
  return small;
}

/// Words that part a line, and so are in no value.
bool parts_line(const Token& token) {
  constexpr auto parting = std::to_array<std::string_view>(
      {"then", "else", "to", "step", "and", "or", "if", "goto", "gosub", "do"});
  return token.is_word() && std::any_of(parting.begin(), parting.end(), [&](std::string_view word) {
           return word.size() == token.text.size() && equal_words(token.text, word);
         });
}

/// What all patterns ask of the tokens of a line, told once.
struct Line {
  explicit Line(const Tokens& given) : tokens(given), depth{0} {
    for (const auto& token : tokens) {
      const int step = token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
      depth.push_back(depth.back() + step);
      ends_value.push_back(token.is_text() || parts_line(token) || token.is(";") || token.is("{") ||
                           token.is("}") || token.is(":"));
      ends_condition.push_back(token.is("then") || token.is("else") || token.is_text() ||
                               token.is("goto") || token.is("{"));
    }
  }

  const Tokens& tokens;
  std::vector<int> depth; ///< of brackets, before each token and after the last one
  std::vector<bool> ends_value;
  std::vector<bool> ends_condition;
};

class Matcher {
public:
  Matcher(const Line& line, std::size_t end, bool whole)
      : line_(line), tokens_(line.tokens), end_(end), whole_(whole) {}

  /// Where the pattern ends that begins at `at`; 0 where it does not fit.
  std::size_t match(const Pattern& pattern, std::size_t at) {
    spans_.clear();
    choice_ = {};
    steps_ = 0;
    return from(pattern, 0, at);
  }

  /// What the holes of the last match hold.
  Holes holes() const {
    Holes holes;
    for (const auto& [hole, begin, end] : spans_)
      holes[hole] = part(begin, end);
    if (choice_.end > 0) {
      holes.choice = lower(tokens_[choice_.begin].text);
      holes.rest = part(choice_.begin, choice_.end);
    }
    return holes;
  }

private:
  static constexpr int most_steps = 1000;

  struct Held {
    char hole = '\0';
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  Tokens part(std::size_t begin, std::size_t end) const {
    return {tokens_.begin() + static_cast<std::ptrdiff_t>(begin),
            tokens_.begin() + static_cast<std::ptrdiff_t>(end)};
  }

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
    if (stop != 0 && literals.size() > 1) // the first one is found last
      choice_ = {'\0', at, stop};
    return stop;
  }

  /// How far a hole can go: not past what closes more than it opens, nor what ends its kind.
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

  /// Within extent().
  bool balanced(std::size_t begin, std::size_t end) const {
    return line_.depth[begin] == line_.depth[end];
  }

  bool is_operand(std::size_t begin, std::size_t end) const {
    const auto& first = tokens_[begin];
    if (end == begin + 1)
      return first.is_word() ? !parts_line(first) : first.is_number();
    return (first.is("(") || (first.is_word() && !parts_line(first) &&
                              (tokens_[begin + 1].is("(") || tokens_[begin + 1].is("[")))) &&
           (tokens_[end - 1].is(")") || tokens_[end - 1].is("]"));
  }

  /// A value, within extent(): neither commas nor comparisons outside of its parentheses, no two
  /// values side by side.
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

  /// Whether a hole can hold what lies within its extent().
  bool fits(char hole, std::size_t begin, std::size_t end) const {
    if (hole == 'r')
      return true;
    const auto& first = tokens_[begin];
    switch (hole) {
    case 'n':
    case 'm': return first.is_number();
    case 'w': return first.is_word() && !parts_line(first);
    case 't': return first.is_text();
    case 'k': return find_colour(first).has_value();
    case 'o':
    case 'p': return (hole == 'p' && is_time(begin, end)) || is_operand(begin, end);
    case 'q': return is_time(begin, end) || is_value(begin, end);
    case 'v':
      return first.is_word() && !parts_line(first) &&
             (end == begin + 1 || (tokens_[begin + 1].is("[") && tokens_[end - 1].is("]")));
    case 'c':
    case 'd':
    case 'l': return true;
    case 'j': // one word is a label
      return end > begin + 1 && !parts_line(first) && !first.is("for") && !first.is("while") &&
             !first.is("}");
    default: return is_value(begin, end);
    }
  }

  /// A number with a unit, or with a decimal comma.
  bool is_time(std::size_t begin, std::size_t end) const {
    if (!tokens_[begin].is_number())
      return false;
    auto at = begin + 1;
    if (at + 1 < end && tokens_[at].is(",") && tokens_[at + 1].is_number() && !tokens_[at + 1].gap)
      at += 2;
    return at == end || (at + 1 == end && tokens_[at].is_word());
  }

  const Line& line_;
  const Tokens& tokens_;
  std::size_t end_;
  bool whole_;
  std::vector<Held> spans_;
  Held choice_;
  int steps_ = 0;
};

/// The statements of a line: all of it, and the branches of an `if`.
std::vector<std::pair<std::size_t, std::size_t>> statements_of(const Tokens& line) {
  std::vector<std::pair<std::size_t, std::size_t>> all{{0, line.size()}};
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i].is_word() &&
        (equal_words(line[i].text, "then") || (i > 0 && equal_words(line[i].text, "else")))) {
      auto end = i + 1;
      while (end < line.size() && !(line[end].is_word() && equal_words(line[end].text, "else")))
        ++end;
      if (end > i + 1)
        all.emplace_back(i + 1, end);
    }
  return all;
}

std::string replaced(const Tokens& line, std::size_t begin, std::size_t end,
                     std::string_view form) {
  const auto before = join(Tokens(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(begin)));
  const auto after = join(Tokens(line.begin() + static_cast<std::ptrdiff_t>(end), line.end()));
  const auto tight = [](char c) { return c == '(' || c == '['; };
  const bool left = !before.empty() && !tight(before.back()) && !form.empty();
  const bool right =
      !after.empty() && std::string_view("),];").find(after[0]) == std::string_view::npos;
  return before + (left ? " " : "") + std::string(form) +
         (right && !(before.empty() && form.empty()) ? " " : "") + after;
}

/// Whether a form is more than a guess: a short wait may have been meant in seconds.
bool is_sure(std::string_view form, const Holes& holes) {
  const auto& time = holes['q'];
  if (form.find("{wait:") != std::string_view::npos && time.size() == 1 && time[0].text.size() < 3)
    return false;
  for (const auto* guess : {"{known:", "comment {", "{still}", "{nought}", "{second}", "{free}",
                            "{brake}", "yaw", "100"})
    if (form.find(guess) != std::string_view::npos)
      return false;
  return true;
}

/// Whether what a row says is about what it writes: a macro drives without `goroll`.
bool fits(std::string_view note, std::string_view form) {
  const bool drives = note.find("goroll") != std::string_view::npos ||
                      note.find("1 to drive") != std::string_view::npos;
  return !drives || form.find("goroll") != std::string_view::npos;
}

} // namespace

void rewrite(const Tokens& line, const Surroundings& around,
             const std::function<bool(const Rewritten&)>& take) {
  std::uint64_t bits = 0;
  std::vector<std::uint64_t> bit(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    bit[i] = line[i].is_text() ? 0 : bit_of(line[i].text);
    bits |= bit[i];
  }
  const auto here = join(line);
  const Line all(line);
  const auto statements = statements_of(line);
  for (const auto& pattern : patterns_of(around.language)) {
    if (std::any_of(pattern.needs.begin(), pattern.needs.end(),
                    [bits](std::uint64_t one) { return (one & bits) == 0; }))
      continue;
    const auto form =
        pattern.idiom == nullptr ? pattern.meaning : form_of(*pattern.idiom, around.language);
    const auto use = [&](const Matcher& matcher, std::size_t begin, std::size_t end) {
      const auto holes = matcher.holes();
      const auto filled = form == "-" ? std::optional(std::string()) : fill(form, holes, around);
      if (!filled)
        return false;
      const bool whole = begin == 0 && end == line.size();
      if (!whole && filled->find('\n') != std::string::npos)
        return false; // several lines stand by themselves
      auto text = replaced(line, begin, end, *filled);
      const auto note = pattern.idiom == nullptr ? std::string_view() : pattern.idiom->note;
      return text != here && take({std::move(text), fits(note, form) ? note : std::string_view(),
                                   is_sure(form, holes)});
    };
    const auto begins = [&](std::size_t i) {
      return pattern.first == 0 || (pattern.first & bit[i]) != 0;
    };
    if (pattern.idiom != nullptr && pattern.idiom->where == Where::Line) {
      for (const auto& [begin, end] : statements) {
        Matcher matcher(all, end, true);
        if (end > begin && begins(begin) && matcher.match(pattern, begin) == end &&
            use(matcher, begin, end))
          return;
      }
      continue;
    }
    Matcher matcher(all, line.size(), false);
    for (std::size_t begin = 0; begin < line.size(); ++begin) {
      const auto end = begins(begin) ? matcher.match(pattern, begin) : 0;
      if (end > begin && use(matcher, begin, end))
        return;
    }
  }
}

void explore(const std::string& line, const Surroundings& around, Bounds bounds,
             std::unordered_set<std::string>& seen,
             const std::function<bool(const Rewritten&)>& take) {
  std::vector<std::pair<std::string, int>> open{{line, 0}};
  for (std::size_t next = 0; next < open.size(); ++next) {
    const auto [text, depth] = open[next];
    const auto tokens = tokens_of(text, around.language);
    if (tokens.size() > most_tokens)
      continue;
    bool done = false;
    rewrite(tokens, around, [&, depth = depth](const Rewritten& one) {
      if (!seen.insert(one.text).second)
        return false;
      if (take(one))
        return done = true;
      if (depth + 1 < bounds.deepest && one.text.find('\n') == std::string::npos)
        open.emplace_back(one.text, depth + 1);
      return seen.size() >= bounds.states;
    });
    if (done || seen.size() >= bounds.states)
      return;
  }
}

std::string word_at(const Tokens& line, std::size_t at) {
  const Line all(line);
  Matcher matcher(all, line.size(), false);
  std::size_t farthest = at;
  std::string_view meaning = line[at].text;
  for (const auto& pattern : patterns_of(Language::Structured)) {
    if (pattern.idiom != nullptr)
      break; // the words come first
    if ((pattern.first & bit_of(line[at].text)) == 0)
      continue;
    if (const auto end = matcher.match(pattern, at); end > farthest) {
      farthest = end;
      meaning = pattern.meaning;
    }
  }
  return lower(meaning);
}

bool is_known_word(std::string_view word, Where where) {
  static const auto all = [] {
    std::array<std::set<std::string>, 2> each;
    for (const auto& pattern : patterns_of(Language::Structured))
      if (pattern.idiom != nullptr)
        for (const auto& one : pattern.parts.front().literals)
          if (is_letter(one[0]))
            each[static_cast<std::size_t>(pattern.idiom->where)].insert(lower(one));
    return each;
  }();
  return all[static_cast<std::size_t>(where)].contains(lower(word));
}

std::string advise(const Tokens& line, const Surroundings& around) {
  const Line all(line);
  for (const auto& pattern : hints_of(around.language)) {
    Matcher matcher(all, line.size(), true);
    if (line.empty() || matcher.match(pattern, 0) != line.size())
      continue;
    if (auto text = fill(pattern.meaning, matcher.holes(), around))
      return *std::move(text);
  }
  return {};
}

} // namespace orb::repair
