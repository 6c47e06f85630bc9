#include "testing/text/plain_line.h"

#include "base/text/text.h"
#include "testing/text/pieces.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace orb::testing {
namespace {

using repair::close_of;
using repair::Language;
using repair::Token;
using repair::Tokens;

bool says_print(const Token& token) {
  const auto all = token.is_word() ? meanings_of(token.text) : std::vector<std::string_view>();
  return std::find(all.begin(), all.end(), "print") != all.end();
}

Token text(std::string said) {
  return {Token::Kind::Text, std::move(said), true};
}

/// Replaces `count` tokens with others.
void replace(Tokens& line, std::size_t at, std::size_t count, Tokens by) {
  if (!by.empty() && at < line.size())
    by[0].gap = line[at].gap;
  const auto begin = line.begin() + static_cast<std::ptrdiff_t>(at);
  const auto next = line.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  line.insert(next, by.begin(), by.end());
}

void drop_objects(Tokens& line) {
  if (!line.empty() && holds("ball program with course target firmware", line[0].text))
    return; // file names contain points, too
  for (std::size_t i = 0; i + 2 < line.size(); ++i) {
    if (const auto end = file_end(line, i); end > i) {
      i = end - 1;
      continue;
    }
    std::size_t count = 0;
    if (line[i].is_word() && line[i + 1].is(".") && line[i + 2].is_word() && !line[i + 2].gap)
      count = 2;
    else if (i + 4 < line.size() && line[i].is_word() && line[i + 1].is("(") &&
             line[i + 2].is(")") && line[i + 3].is(".") && holds("x y", line[i + 4].text))
      count = 4;
    const auto means = meanings_of(line[i].text);
    const bool is_verb = (is_of_tests(line[i].text) && !equal_words(line[i].text, "program")) ||
                         std::any_of(means.begin(), means.end(), [](std::string_view one) {
                           return one == "expect" || one == "not";
                         });
    if (count > 0 && !is_verb)
      repair::take_out(line, i--, count);
  }
}

void join_texts(Tokens& line) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const bool last = i + 2 == line.size() && line[i].is(";"); // `"F(12) = "; 144`
    if ((line[i].is("+") || last) && line[i - 1].is_text() &&
        (line[i + 1].is_text() || line[i + 1].is_number())) {
      line[i - 1].text += line[i + 1].text;
      replace(line, i--, 2, {});
    }
  }
}

void quote_brackets(Tokens& line) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto close =
        line[i].is("[") && line[i].gap && (says_print(line[i - 1]) || line[i - 1].is("test"))
            ? close_of(line, i)
            : line.size();
    if (close >= line.size() || close == i + 1)
      continue;
    auto words = repair::slice(line, i + 1, close);
    words[0].gap = false;
    replace(line, i, close - i + 1, {text(repair::join(words))});
  }
}

void read_raw_patterns(Tokens& line) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    if (line[i].is("r") && line[i + 1].is_text() && !line[i + 1].gap)
      replace(line, i, 2, repair::tokens_of("/" + line[i + 1].text + "/", Language::Test));
}

void unquote(Tokens& line) {
  if (line.empty() || std::any_of(line.begin(), line.end(), says_print))
    return;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!line[i].is_text() || !line[i].closed)
      continue;
    const auto said = repair::tokens_of(line[i].text, Language::Test);
    const bool key = i + 1 < line.size() && line[i + 1].is(":");
    if (!said.empty() && (key || said[0].is_number() || (i > 0 && is_of_tests(line[i].text))))
      replace(line, i, 1, said);
  }
}

/// True if the rest continues an expectation after a text: `within 9s`, `and color green`, `3
/// times`.
bool goes_on(const Tokens& rest) {
  const auto pieces = pieces_of(rest);
  using Kind = Piece::Kind;
  if (pieces.empty() || !(pieces[0].is_count ||
                          (pieces.size() > 1 &&
                           pieces[0].means_any("within at during until seeds points and before"))))
    return false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool named = i > 0 && pieces[i - 1].means_any("inside reach");
    if (pieces[i].is(Kind::Sign) || pieces[i].is(Kind::Text) ||
        (pieces[i].is(Kind::Word) && !named && pieces[i].colour.empty() &&
         !is_of_tests(pieces[i].text) && !pieces[i].says_nothing()))
      return false;
  }
  return true;
}

void close_text(Tokens& line) {
  if (line.size() < 2 || !line.back().is_text() || line.back().closed)
    return;
  const auto said = line.back().text;
  auto whole = repair::tokens_of(said, Language::Test);
  const auto& before = line[line.size() - 2];
  const bool is_quoted = says_print(before) || before.is("~") || line[0].is("test");
  if (!is_quoted && !whole.empty() && whole[0].is_word()) { // Logo's quote: `color "red`
    line.pop_back();
    whole[0].gap = true;
    return repair::append(line, whole);
  }
  for (auto blank = said.find(' '); blank != std::string::npos; blank = said.find(' ', blank + 1)) {
    const auto rest = repair::tokens_of(std::string_view(said).substr(blank), Language::Test);
    if (!goes_on(rest))
      continue;
    line.back().text = said.substr(0, blank);
    line.back().closed = true;
    return repair::append(line, rest);
  }
}

void name_test(Tokens& line) {
  if (line.size() > 1 && line[0].is("to") && line[1].is_text())
    line[0].text = "test";
  if (line.size() > 2 && (line[0].is("to") || line[0].is("when")) && line[1].is("test"))
    line.erase(line.begin());
  if (line.size() < 3 || !line[0].is("test"))
    return;
  if (line[2].is("starts"))
    line.erase(line.begin() + 2);
  const auto quoted =
      std::find_if(line.begin(), line.end(), [](const Token& token) { return token.is_text(); });
  if (quoted != line.end() && quoted->closed) { // `test if it "finds 25"`
    if (!has_token(Tokens(line.begin(), quoted), "seeds"))
      line.erase(line.begin() + 1, quoted);
    return;
  }
  const bool clause = holds("that if whether dass ob que si che", line[1].text);
  const std::size_t begin = !clause ? 1 : line.size() > 2 && line[2].is("it") ? 3 : 2;
  auto end = begin;
  const auto ends = [&](std::size_t at) {
    return line[at].is_text() || line[at].is("(") || line[at].is("seeds") ||
           ((line[at].is("points") || line[at].is("for")) && at + 1 < line.size() &&
            line[at + 1].is_number());
  };
  while (end < line.size() && !ends(end))
    ++end;
  auto said = repair::slice(line, begin, end);
  if (said.empty() || !said[0].is_word())
    return;
  said[0].gap = false;
  auto rest = repair::slice(line, end);
  if (end < line.size() && line[end].is_text()) // `test rolls a die" seeds 1..50`
    rest = repair::tokens_of(line[end].text, Language::Test);
  if (!rest.empty())
    rest[0].gap = true;
  line = {line[0], text(repair::join(said))};
  repair::append(line, rest);
}

void quote_printed(Tokens& line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i].is("print") && line[i - 1].is_text())
      std::swap(line[i], line[i - 1]); // `"25" print`
  const auto print = std::find_if(line.begin(), line.end(), says_print);
  if (print == line.end() || print + 1 == line.end() || !(print + 1)->gap)
    return;
  const auto begin = print + 1;
  const auto all = static_cast<std::size_t>(begin - line.begin());
  auto end = all;
  for (; end < line.size(); ++end) {
    const bool counted =
        line[end].is_number() && end + 1 < line.size() && line[end + 1].is("times");
    if (is_of_tests(line[end].text) || counted || !(line[end].is_word() || line[end].is_number()))
      break;
  }
  const auto said = repair::slice(line, all, end);
  const bool says_something = std::any_of(said.begin(), said.end(), [](const Token& token) {
    const auto means = meanings_of(token.text);
    return token.is_number() || means.empty() || !means[0].empty();
  });
  if (says_something)
    replace(line, all, end - all, {text(repair::join(said))});
}

constexpr auto rows = std::to_array<Plainer>({
    {"drops the object of a call", drop_objects, "expect Program.End() within 5s",
     "expect End() within 5s"},
    {"joins texts", join_texts, "expect print \"5\" + \" corners\"", "expect print \"5 corners\""},
    {"quotes what stands in brackets", quote_brackets, "expect print [yes! in 5 tries]",
     "expect print \"yes! in 5 tries\""},
    {"reads a pattern of Python", read_raw_patterns, "expect print r\"^a$\"", "expect print /^a$/"},
    {"quotes the name of a test", name_test, "test that it draws a star", "test \"draws a star\""},
    {"ends a text before what no text says", close_text, "expect print \"hi within 2s",
     "expect print \"hi\" within 2s"},
    {"takes keys and numbers out of quotes", unquote, "{\"at\": \"2s\", \"push\": [90, 120]}",
     "{at: 2s, push: [90, 120]}"},
    {"quotes what is printed", quote_printed, "expect print 25 primes",
     "expect print \"25 primes\""},
});

} // namespace

std::span<const Plainer> plainers() {
  return rows;
}

Tokens plain_line(Tokens line) {
  for (const auto& row : rows)
    row.apply(line);
  return line;
}

} // namespace orb::testing
