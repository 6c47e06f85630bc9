#include "structured/lift/letter_names.h"

#include "base/text/text.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::structured::lifting {
namespace {

/// Words that neither begin nor end a name.
bool is_article(std::string_view word) {
  return word == "a" || word == "an" || word == "the";
}
bool is_joint(std::string_view word) {
  static constexpr auto joints =
      std::to_array<std::string_view>({"and", "or", "of", "to", "in", "on", "at", "by", "with",
                                       "that", "which", "for", "from", "is", "as", "then", "so"});
  return is_article(word) || std::find(joints.begin(), joints.end(), word) != joints.end();
}

struct Phrase {
  std::vector<std::string> words; ///< in lower case
  bool whole = true;              ///< nothing follows them
};

/// The words at the start of a comment, up to the first punctuation.
Phrase phrase_of(std::string_view comment) {
  Phrase phrase;
  std::size_t i = 0;
  const auto skip = [&](auto fits) {
    while (i < comment.size() && fits(comment[i]))
      ++i;
  };
  skip([](char c) { return c == '\'' || is_blank(c); });
  const auto begin = i;
  skip(is_digit); // `2: a round`
  if (i > begin && i < comment.size() && (comment[i] == ':' || comment[i] == '.'))
    ++i;
  else
    i = begin;
  skip(is_blank);
  while (i < comment.size() && is_name_char(comment[i])) {
    auto& word = phrase.words.emplace_back();
    while (i < comment.size() && is_name_char(comment[i]))
      word += to_lower(comment[i++]);
    skip(is_blank);
  }
  phrase.whole = i == comment.size();
  return phrase;
}

/// Makes a name of at most `most` words, or nothing.
std::string name_from(Phrase phrase, std::size_t most) {
  auto& words = phrase.words;
  while (!words.empty() && is_article(words.front()))
    words.erase(words.begin());
  if (words.size() > most)
    words.resize(most);
  while (!words.empty() && is_joint(words.back()))
    words.pop_back();
  std::string name;
  for (const auto& word : words)
    name += (name.empty() ? "" : "_") + word;
  const bool fits = name.size() > 1 && name.size() <= longest_name && begins_name(name.front());
  return fits ? name : std::string();
}

} // namespace

Comments read_comments(const compiler::Program& program, ControlFlow& ways) {
  Comments comments;
  comments.before.resize(program.lines.size());
  std::vector<bool> reached(program.lines.size(), false);
  for (const auto& step : ways.steps)
    reached[step.line] = reached[step.line] || step.reached;
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    const auto& line = program.lines[i];
    if (!line.has_statement() && line.comment.size() > 0)
      comments.last.push_back(program.text_of(line.comment));
    if (reached[i])
      comments.before[i] = std::exchange(comments.last, {});
  }
  for (auto& step : ways.steps)
    step.remarked = step.begins_line && (!comments.before[step.line].empty() ||
                                         program.lines[step.line].comment.size() > 0);
  return comments;
}

LiftedNames::LiftedNames(const compiler::Program& program, const ControlFlow& ways,
                         const Comments& comments)
    : program_(program), ways_(ways), comments_(comments) {
  taken_.insert(std::string(elements()));
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    letters_[i] = std::string(1, static_cast<char>('a' + i));
    taken_.insert(letters_[i]);
  }
  for (const auto step : ways.subroutines) {
    const auto line = ways.steps[step].line;
    auto name = name_of_line(line);
    subs_.push_back(!name.empty() && take(name)
                        ? name
                        : fresh(fmt::format("routine_{}", program.lines[line].number)));
  }
  for (const auto& line : program.lines)
    take_letters(program.text_of(line.comment));
  name_letters_where_set();
}

bool LiftedNames::take(const std::string& name) {
  return find_word(name).kind == WordKind::Name && taken_.insert(name).second;
}

std::string LiftedNames::fresh(std::string_view wish) {
  std::string name(wish);
  for (int n = 2; !take(name); ++n)
    name = fmt::format("{}_{}", wish, n);
  return name;
}

/// Reads `A: the angle` and `A is the angle` as names of A.
void LiftedNames::take_letters(std::string_view comment) {
  for (std::size_t i = 1; i + 1 < comment.size(); ++i) {
    const bool alone = is_letter(comment[i]) && to_lower(comment[i]) != 'z' &&
                       !is_name_char(comment[i - 1]) && comment[i] >= 'A' && comment[i] <= 'Z' &&
                       !is_name_char(comment[i + 1]);
    if (!alone)
      continue;
    auto rest = comment.substr(i + 1);
    if (rest.starts_with(": "))
      rest.remove_prefix(2);
    else if (rest.starts_with(" is "))
      rest.remove_prefix(4);
    else
      continue;
    constexpr std::size_t most = 3;
    name_letter(static_cast<std::size_t>(to_lower(comment[i]) - 'a'),
                name_from(phrase_of(rest), most));
  }
}

/// Reads `A = 5 ' the angle` as a name of A.
void LiftedNames::name_letters_where_set() {
  for (const auto& step : ways_.steps) {
    const auto& statement = program_.statements[step.statement];
    const auto comment = program_.text_of(program_.lines[step.line].comment);
    if (statement.kind != spec::Statement::Let || !step.begins_line || comment.empty())
      continue;
    const auto& place = program_.items_of(statement).front();
    const auto phrase = phrase_of(comment);
    constexpr std::size_t most = 4;
    const bool clear = phrase.whole && phrase.words.size() <= most &&
                       std::none_of(comment.begin(), comment.end(), is_digit);
    if (place.kind == compiler::ItemKind::Letter && clear)
      name_letter(place.value, name_from(phrase, most));
  }
}

void LiftedNames::name_letter(std::size_t which, std::string name) {
  if (letters_[which].size() == 1 && !name.empty() && take(name))
    letters_[which] = std::move(name);
}

std::string LiftedNames::name_of_line(std::uint32_t line) const {
  constexpr std::size_t most = 4;
  const auto& above = comments_.before[line];
  return above.empty() ? std::string() : name_from(phrase_of(above.front()), most);
}

std::string LiftedNames::label(std::uint32_t line) {
  auto name = name_of_line(line);
  return !name.empty() && take(name) ? name
                                     : fresh(fmt::format("line_{}", program_.lines[line].number));
}

} // namespace orb::structured::lifting
