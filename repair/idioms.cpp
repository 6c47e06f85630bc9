#include "repair/idioms.h"

#include "base/text/text.h"
#include "repair/fill.h"
#include "repair/matcher.h"
#include "repair/texts.h"

#include <algorithm>
#include <array>
#include <set>

namespace orb::repair {
namespace {

// The rows are stored as one text, column by column: pointers to each would double the size of the
// table. Every supported compiler accepts a literal of this length.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Woverlength-strings"
constexpr char word_rows[] =
#define ORB_WORD(meaning, patterns) meaning "\x1f" patterns "\x1e"
#include "repair/idioms.def"
    ;
constexpr char idiom_rows[] =
#define ORB_IDIOM(where, patterns, basic, structured, macro, test, ...)                            \
#where "\x1f" patterns "\x1f" basic "\x1f" structured "\x1f" macro "\x1f" test                   \
         "\x1f" __VA_OPT__("note") "\x1e"
#include "repair/idioms.def"
    ;
#pragma GCC diagnostic pop

/// The notes of the rows that have one, in order.
constexpr auto notes = std::to_array<const orb::Text*>({
#define ORB_IDIOM(where, patterns, basic, structured, macro, test, ...)                            \
  __VA_OPT__(&texts::__VA_ARGS__, )
#include "repair/idioms.def"
});

constexpr auto hints = std::to_array<Hint>({
#define ORB_HINT(patterns, text, basic, structured, ...)                                           \
  {patterns, &texts::text, basic, structured, "" __VA_ARGS__},
#include "repair/idioms.def"
});

/// Foreign words and the native replacement.
struct Whose {
  std::string_view patterns;
  std::string_view language;
  const orb::Text* text;
  std::string_view basic;
  std::string_view structured;
};
constexpr auto foreign = std::to_array<Whose>({
#define ORB_WHOSE(patterns, language, text, basic, structured)                                     \
  {patterns, language, &texts::text, basic, structured},
#include "repair/idioms.def"
});

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

/// Splits a text into rows and columns.
std::vector<std::vector<std::string_view>> rows_of(std::string_view text) {
  std::vector<std::vector<std::string_view>> rows;
  for (const auto row : pieces(text, "\x1e"))
    if (!row.empty())
      rows.push_back(pieces(row, "\x1f"));
  return rows;
}

const std::vector<Idiom>& idioms() {
  static const auto all = [] {
    std::vector<Idiom> rows;
    auto note = notes.begin();
    for (const auto& columns : rows_of(idiom_rows))
      rows.push_back({columns[0] == "Line" ? Where::Line : Where::Inside, columns[1], columns[2],
                      columns[3], columns[4], columns[5], columns[6].empty() ? nullptr : *note++});
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

/// The part that the fewest lines contain: a word if there is one. Optional commas of macros do not
/// count.
const Part* rarest_part(const Pattern& pattern) {
  const auto rank = [](const Part& part) {
    const bool sign = !is_letter(part.literals.front()[0]);
    return std::pair(sign, part.literals.size());
  };
  const Part* rarest = nullptr;
  for (const auto& part : pattern.parts)
    if (!part.literals.empty() && !part.may_lack && (!rarest || rank(part) < rank(*rarest)))
      rarest = &part;
  return rarest;
}

/// Patterns in table order, indexed by their rarest part.
struct Patterns {
  void index() {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const auto* const part = rarest_part(all[i]))
        for (const auto& literal : part->literals)
          having.add(literal, i);
      else
        without.push_back(i);
  }

  /// The patterns that may match a line: all others have a literal that it does not contain.
  std::vector<std::size_t> possible(const Tokens& line) const {
    auto found = without;
    for (const auto& token : line) {
      const auto& more = having.lists_of(token.text);
      found.insert(found.end(), more.begin(), more.end());
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  std::vector<Pattern> all;
  WordIndex having; ///< by their rarest part
  std::vector<std::size_t> without;
};

/// The patterns that have a form in a language.
const Patterns& patterns_of(Language language) {
  static const auto all = [] {
    std::array<Patterns, 4> each;
    for (std::size_t i = 0; i < each.size(); ++i) {
      for (const auto& word : rows_of(word_rows)) // its meaning, then patterns
        add_patterns(each[i].all, word[1], nullptr, word[0], static_cast<Language>(i));
      for (const auto& idiom : idioms())
        if (!form_of(idiom, static_cast<Language>(i)).empty())
          add_patterns(each[i].all, idiom.patterns, &idiom, {}, static_cast<Language>(i));
      each[i].index();
    }
    return each;
  }();
  return all[static_cast<std::size_t>(language)];
}

/// The patterns of hints for a language; the meaning fills the holes of the text.
std::vector<std::pair<const orb::Text*, std::vector<Pattern>>> read_hints(Language language) {
  std::vector<std::pair<const orb::Text*, std::vector<Pattern>>> all;
  for (const auto& hint : hints)
    if (const auto forms = language == Language::Basic        ? hint.basic
                           : language == Language::Structured ? hint.structured
                                                              : hint.macro;
        !forms.empty())
      add_patterns(all.emplace_back(hint.text, std::vector<Pattern>()).second, hint.patterns,
                   nullptr, forms, language);
  return all;
}

/// The patterns of words that a language lacks, with their rows.
struct ForeignPatterns : Patterns {
  explicit ForeignPatterns(Language language) {
    for (const auto& row : foreign)
      if (const auto form = language == Language::Basic ? row.basic : row.structured;
          !form.empty()) {
        add_patterns(all, row.patterns, nullptr, form, language);
        rows.resize(all.size(), &row);
      }
    index();
  }
  std::vector<const Whose*> rows;
};

struct Foreign {
  Span span;        ///< in the line
  std::string word; ///< if it is a single word
  Message message;
};

/// The first foreign words of a line; the longest match wins.
std::optional<Foreign> find_foreign(std::string_view text, Language language,
                                    const ForeignPatterns& patterns) {
  const auto tokens = split(text, language).tokens;
  if (tokens.size() > most_tokens)
    return std::nullopt;
  const MatchedLine line(tokens);
  Matcher matcher(line);
  std::size_t begin = tokens.size();
  std::size_t end = 0;
  std::size_t best = 0;
  for (const auto each : patterns.possible(tokens))
    for (std::size_t at = 0; at < tokens.size() && at <= begin; ++at)
      if (const auto stop = matcher.match(patterns.all[each], at);
          stop > at && (at < begin || stop > end)) {
        begin = at;
        end = stop;
        best = each;
      }
  if (end == 0)
    return std::nullopt;
  const auto& last = tokens[end - 1];
  const auto stop = std::min(last.at + last.text.size() + (last.is_text() ? 2 : 0), text.size());
  const Span span{tokens[begin].at, static_cast<std::uint32_t>(stop)};
  const auto& row = *patterns.rows[best];
  const auto form = patterns.all[best].meaning;
  std::vector<Message> fillers;
  if (form != "-")
    fillers.push_back(Message::as_is(std::string(form)));
  const auto word = text.substr(span.begin, span.size());
  Message what(*row.text, std::move(fillers));
  return Foreign{span, end == begin + 1 ? last.text : "",
                 row.language.empty() ? texts::IsForeign(word, std::move(what))
                                      : texts::IsWhose(word, row.language, std::move(what))};
}

/// True if a line assigns a variable of this name or jumps to it: then it belongs to the program.
bool is_own_word(const Source& source, std::string_view word, Language language) {
  for (std::uint32_t n = 1; !word.empty() && n <= source.line_count(); ++n) {
    const auto line = source.line(n);
    if (line.find(word) == std::string_view::npos)
      continue;
    const auto tokens = split(line, language).tokens;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
      if ((equal_words(tokens[i].text, word) && tokens[i + 1].is("=")) ||
          (equal_words(tokens[i + 1].text, word) && holds("goto gosub", tokens[i].text)))
        return true;
  }
  return false;
}

/// True if a finding says that a line, or a word in it, is not understood.
bool is_unreadable(const Diagnostic& finding) {
  constexpr auto troubles = std::to_array<Trouble>(
      {Trouble::Unreadable, Trouble::UnknownName, Trouble::ForeignWord, Trouble::MalformedLine});
  return is_error(finding) &&
         std::find(troubles.begin(), troubles.end(), finding.rule->trouble) != troubles.end();
}

/// True if a finding is a name that foreign words may begin with: `f"A is {A}"`.
bool is_unset(const Diagnostic& finding) {
  return !is_error(finding) && finding.rule->trouble == Trouble::UnknownName;
}

/// Fills the holes of a hint; nothing if a value does not have the required form.
std::optional<std::vector<Message>> fill_each(std::string_view forms, const Holes& holes,
                                              const Surroundings& around) {
  std::vector<Message> all;
  if (forms == "-")
    return all;
  for (const auto form : pieces(forms, " ;; ")) {
    auto text = fill(form, holes, around);
    if (!text)
      return std::nullopt;
    all.push_back(Message::as_is(*std::move(text)));
  }
  return all;
}

/// The statements of a line: the whole line, and the branches of an `if`.
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

/// Adds parentheses to a rewritten call if it is a sum next to a stronger operator.
std::string as_operand(const Tokens& line, std::size_t begin, std::size_t end, std::string form) {
  if (!line[end - 1].is(")"))
    return form;
  const auto binds = [&](std::size_t at) {
    return line[at].is("*") || line[at].is("/") || line[at].is("%");
  };
  if (!(begin > 0 && binds(begin - 1)) && !(end < line.size() && binds(end)))
    return form;
  int depth = 0;
  for (std::size_t i = 0; i + 2 < form.size(); ++i) {
    depth += form[i] == '(' ? 1 : form[i] == ')' ? -1 : 0;
    const auto sign = std::string_view(form).substr(i, 3);
    if (depth == 0 && (sign == " + " || sign == " - "))
      return "(" + form + ")";
  }
  return form;
}

/// True if a form is more than a guess: a short wait may have been meant in seconds.
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

/// True if a form has a number that was not written.
bool invents(std::string_view form) {
  for (std::size_t at = 1; at < form.size(); ++at)
    if (is_digit(form[at]) && (form[at - 1] == ' ' || form[at - 1] == '='))
      return true;
  return false;
}

/// True if the note fits the replacement: a macro drives without `goroll`.
bool fits(const orb::Text* note, std::string_view form) {
  const bool drives = note == &texts::DrivesWithGoroll || note == &texts::RollValues ||
                      note == &texts::RollThenDelay || note == &texts::DriveOrBrake;
  return !drives || form.find("goroll") != std::string_view::npos;
}

} // namespace

void rewrite(const Tokens& line, const Surroundings& around,
             const std::function<bool(const Candidate&)>& take) {
  std::uint64_t bits = 0;
  std::vector<std::uint64_t> bit(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    bit[i] = line[i].is_text() ? 0 : bit_of(line[i].text);
    bits |= bit[i];
  }
  const auto here = join(line);
  const MatchedLine all(line);
  const auto statements = statements_of(line);
  const auto& patterns = patterns_of(around.language);
  for (const auto each : patterns.possible(line)) {
    const auto& pattern = patterns.all[each];
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
        return false; // several lines are separate statements
      const bool inside = pattern.idiom != nullptr && pattern.idiom->where == Where::Inside;
      auto text =
          replaced(line, begin, end, inside ? as_operand(line, begin, end, *filled) : *filled);
      const auto* note = pattern.idiom == nullptr ? nullptr : pattern.idiom->note;
      return text != here &&
             take({std::move(text), 10, fits(note, form) ? note : nullptr,
                   is_sure(form, holes) && !(around.language == Language::Macro && invents(form))});
    };
    const auto begins = [&](std::size_t i) {
      return pattern.first == 0 || (pattern.first & bit[i]) != 0;
    };
    if (pattern.idiom != nullptr && pattern.idiom->where == Where::Line) {
      for (const auto& [begin, end] : statements) {
        Matcher matcher(all, end);
        if (end > begin && begins(begin) && matcher.match(pattern, begin) == end &&
            use(matcher, begin, end))
          return;
      }
      continue;
    }
    Matcher matcher(all);
    for (std::size_t begin = 0; begin < line.size(); ++begin) {
      const auto end = begins(begin) ? matcher.match(pattern, begin) : 0;
      if (end > begin && use(matcher, begin, end))
        return;
    }
  }
}

void explore(const std::string& line, const Surroundings& around, Bounds bounds,
             std::unordered_set<std::string>& seen, Rewrites& known,
             const std::function<bool(const Candidate&)>& take) {
  std::vector<std::pair<std::string, int>> open{{line, 0}};
  for (std::size_t next = 0; next < open.size(); ++next) {
    const auto [text, depth] = open[next];
    bool done = false;
    const auto look = [&, depth = depth](const Candidate& one) {
      if (!seen.insert(one.text).second)
        return false;
      if (take(one))
        return done = true;
      if (depth + 1 < bounds.deepest && one.text.find('\n') == std::string::npos)
        open.emplace_back(one.text, depth + 1);
      return seen.size() >= bounds.states;
    };
    if (const auto told = known.find(text); told != known.end()) {
      std::any_of(told->second.begin(), told->second.end(), look);
    } else if (const auto tokens = tokens_of(text, around.language); tokens.size() <= most_tokens) {
      std::vector<Candidate> all;
      bool whole = true;
      rewrite(tokens, around, [&](const Candidate& one) {
        all.push_back(one);
        whole = !look(one);
        return !whole;
      });
      if (whole)
        known.emplace(text, std::move(all));
    }
    if (done || seen.size() >= bounds.states)
      return;
  }
}

std::string word_at(const Tokens& line, std::size_t at) {
  if (at >= line.size())
    return {}; // `_` contains no word
  const MatchedLine all(line);
  Matcher matcher(all);
  std::size_t farthest = at;
  std::string_view meaning = line[at].text;
  for (const auto& pattern : patterns_of(Language::Structured).all) {
    if (pattern.idiom != nullptr)
      break; // the patterns of words come before those of idioms
    if ((pattern.first & bit_of(line[at].text)) == 0)
      continue;
    if (const auto end = matcher.match(pattern, at); end > farthest) {
      farthest = end;
      meaning = pattern.meaning;
    }
  }
  return lower(meaning);
}

std::vector<std::string_view> spoken_words() {
  std::vector<std::string_view> all;
  for (const auto& word : rows_of(word_rows))
    for (const auto pattern : pieces(word[1], " ;; "))
      for (const auto part : pieces(pattern, " "))
        for (const auto one : pieces(part, "|"))
          all.push_back(one);
  return all;
}

bool is_known_word(std::string_view word, Where where) {
  static const auto all = [] {
    std::array<std::set<std::string>, 2> each;
    for (const auto& pattern : patterns_of(Language::Structured).all)
      if (pattern.idiom != nullptr)
        for (const auto& one : pattern.parts.front().literals)
          if (is_letter(one[0]))
            each[static_cast<std::size_t>(pattern.idiom->where)].insert(lower(one));
    return each;
  }();
  return all[static_cast<std::size_t>(where)].contains(lower(word));
}

void say_foreign(std::string_view text, Language language, std::vector<Diagnostic>& findings) {
  static const ForeignPatterns basic(Language::Basic);
  static const ForeignPatterns structured(Language::Structured);
  const auto& patterns = language == Language::Basic ? basic : structured;
  const Source source({}, std::string(text));
  std::set<std::uint32_t> lines;
  for (auto& finding : findings) {
    const bool unset = is_unset(finding);
    const auto n = unset || is_unreadable(finding) ? source.position(finding.span.begin).line : 0;
    const auto found = n != 0 && lines.insert(n).second
                           ? find_foreign(source.line(n), language, patterns)
                           : std::nullopt;
    if (!found || is_own_word(source, found->word, language) ||
        (unset && source.line_start(n) + found->span.begin != finding.span.begin))
      continue;
    finding.span = {source.line_start(n) + found->span.begin,
                    source.line_start(n) + found->span.end};
    finding.message = found->message;
    if (!finding.fix && finding.help.is(texts::VariablesAreNamed))
      finding.help = {};
  }
}

Message advise(const Tokens& line, const Surroundings& around) {
  static const std::array all_hints{read_hints(Language::Basic), read_hints(Language::Structured),
                                    read_hints(Language::Macro)};
  if (line.empty() || around.language == Language::Test)
    return {};
  const MatchedLine all(line);
  for (const auto& [text, patterns] : all_hints[static_cast<std::size_t>(around.language)])
    for (const auto& pattern : patterns) {
      Matcher matcher(all, line.size());
      if (matcher.match(pattern, 0) != line.size())
        continue;
      if (auto fillers = fill_each(pattern.meaning, matcher.holes(), around))
        return {*text, *std::move(fillers)};
    }
  return {};
}

} // namespace orb::repair
