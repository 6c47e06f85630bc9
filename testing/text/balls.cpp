#include "testing/text/file_reader.h"

#include <algorithm>

// The balls of a room.

namespace orb::testing {

namespace {

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
  });
}

} // namespace

void FileReader::read_ball(Cursor& cursor) {
  TestBall ball;
  ball.name.span = cursor.peek_span();
  ball.name.text = std::string(cursor.word());
  if (cursor.at_end())
    return cursor.fail(rules::Syntax, "a ball needs a name and a program",
                       "write it like `ball red red.orb at 60,0`");
  if (!is_name(ball.name.text))
    return cursor.fail_at(ball.name.span, rules::Value,
                          "a ball name can only have letters, digits, `-` and `_`",
                          "write it like `ball red red.orb`");
  if (ball_called(ball.name.text))
    return cursor.fail_at(ball.name.span, rules::Name,
                          fmt::format("another ball is called `{}`", ball.name.text),
                          "each ball needs its own name");
  if (find_word<ExpectationInfo>(expectations, ball.name.text) != nullptr)
    return cursor.fail_at(ball.name.span, rules::Name,
                          fmt::format("`{}` is a reserved word in tests", ball.name.text),
                          "give the ball another name");
  read_file(cursor, ball.program);
  if (cursor.take_word("at")) {
    ball.start.place.x = cursor.number("x");
    cursor.character(',', "a place is written `X,Y`, in centimetres");
    ball.start.place.y = cursor.number("y");
  }
  if (!cursor.failed() && cursor.take_word("facing"))
    ball.start.facing_deg = cursor.number("heading");
  if (!cursor.failed())
    file_.balls.push_back(std::move(ball));
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
  cursor.fail(rules::Word, fmt::format("`{}` is not a ball of this room", cursor.peek()),
              did_you_mean(cursor.peek(), names,
                           fmt::format("say which ball: {}", fmt::join(names, ", "))));
  return false;
}

} // namespace orb::testing
