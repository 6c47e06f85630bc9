#include "repair/line.h"

#include "base/text/text.h"
#include "repair/called.h"

#include <algorithm>

namespace orb::repair {

namespace {

/// Replaces characters that only look like spaces by spaces.
std::string with_blanks(std::string_view head) {
  std::string plain;
  for (const char c : head)
    if (!is_utf8_tail(c))
      plain += is_digit(c) || is_blank(c) ? c : ' ';
  return plain;
}

} // namespace

bool has_word(std::span<const std::string_view> words, std::string_view word) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view one) { return equal_words(one, word); });
}

bool negates(const Token& token) {
  return token.is_word() &&
         (token.is("not") || is_called("never", token.text) || mean_the_same("not", token.text));
}

bool Line::is_foreign(std::string_view word) const {
  return word.size() > 1 && !knows(word) && !is_elsewhere(word);
}

bool Line::has_foreign(std::string_view text) const {
  const auto all = split(text, language()).tokens;
  return std::any_of(all.begin(), all.end(),
                     [&](const Token& token) { return token.is_word() && is_foreign(token.text); });
}

bool Line::is_unknown(const Token& token) const {
  const bool article = language() != Language::Basic && token.is("a") && !is_elsewhere("a");
  return token.is_word() && (article || is_foreign(token.text)) && !negates(token);
}

bool Line::is_variable(const Token& token) const {
  return token.is_word() && !knows(token.text) && (token.text.size() == 1 || has_name(token.text));
}

std::ptrdiff_t Line::count_of(std::string_view sign) const {
  return std::count_if(tokens.begin(), tokens.end(),
                       [&](const Token& token) { return token.is(sign); });
}

std::string Line::with(std::string_view statement) const {
  if (statement.empty() && comment.empty())
    return {};
  auto text = head;
  const auto behind = written.substr(head_size);
  if (!head.empty() && is_digit(head.back()) && !statement.empty() && !behind.empty() &&
      !is_letter(behind[0]))
    text += ' '; // `10) LEDC 1`
  text += statement;
  if (!comment.empty())
    text += (statement.empty() ? "" : " ") + comment;
  return text;
}

Line look_at(const Source& source, const Dialect& dialect, const Scenery& scenery,
             std::uint32_t number) {
  const auto written = source.line(number);
  Line line;
  static_cast<SplitLine&>(line) = split(written, dialect.language);
  line.head_size = line.head.size();
  line.head = with_blanks(line.head);
  line.dialect = &dialect;
  line.scenery = &scenery;
  line.written = written;
  line.begin = source.line_start(number);
  line.around = scenery.around(number, line);
  line.around.elsewhere = scenery.words_without(line.tokens);
  line.sub = scenery.sub_of(line.tokens);
  line.like = line.tokens.empty() ? "" : scenery.sub_like(line.tokens[0].text);
  line.meant = scenery.sub_meant(values_between(line.tokens, 1));
  if (dialect.language == Language::Basic) {
    line.is_target = !scenery.jumps_to(scenery.number(number)).empty();
    line.number_above = scenery.number_above(number);
    line.around.names = scenery.set_without(line.tokens);
    return line;
  }
  line.names = line.around.elsewhere;
  for (const auto name : line.names)
    if (!line.knows(name))
      line.around.names.push_back(name);
  return line;
}

} // namespace orb::repair
