#include "testing/text/file_reader.h"

#include "base/meant.h"

#include <algorithm>

// The balls of a room.

namespace orb::testing {
namespace {

/// True if a word of the test language could appear where a ball's name does.
bool is_reserved(std::string_view word) {
  const auto words = operand_words();
  return find_word<ExpectationInfo>(expectations, word) != nullptr ||
         find_word<WordInfo>(when_words, word) != nullptr ||
         find_word<WordInfo>(join_words, word) != nullptr ||
         std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

namespace {

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
  });
}

} // namespace

void FileReader::read_ball(Cursor& cursor) {
  const auto span = cursor.peek_span();
  const auto name = std::string(cursor.word());
  if (cursor.at_end())
    return cursor.fail(rules::Syntax, file_texts::BallTakes(),
                       file_texts::WriteLike("ball red red.orb at 60,0"));
  if (!is_name(name))
    return cursor.fail_at(span, rules::Value, file_texts::BallNameLetters(),
                          file_texts::WriteLike("ball red red.orb"));
  if (ball_called(name))
    return cursor.fail_at(span, rules::Name, file_texts::OtherBallCalled(name),
                          file_texts::OwnName());
  if (is_reserved(name))
    return cursor.fail_at(span, rules::Name, file_texts::ReservedInTests(name),
                          file_texts::OtherBallName());
  const auto& slots = info(LineWord::Ball).slots;
  const auto values = cursor.read(std::span(slots.data() + 1, slots.size() - 1));
  if (!cursor.failed())
    file_.balls.push_back(
        {{name, span}, named(values[0]), {{values[1].least, values[1].most}, values[2].most}});
}

std::optional<std::size_t> FileReader::ball_called(std::string_view name) const {
  for (std::size_t i = 0; i < file_.balls.size(); ++i)
    if (file_.balls[i].name.text == name)
      return i;
  return std::nullopt;
}

bool FileReader::read_whose(Cursor& cursor, Expectation& one) {
  if (file_.balls.empty())
    return true;
  one.ball = ball_called(cursor.peek());
  if (one.ball) {
    cursor.word();
    return true;
  }
  std::vector<std::string_view> names;
  for (const auto& ball : file_.balls)
    names.push_back(ball.name.text);
  cursor.fail(rules::Word, file_texts::NotABallHere(cursor.peek()),
              meant_or(cursor.peek(), names, file_texts::SayWhichBall(listed(names))));
  return false;
}

} // namespace orb::testing
