#include "testing/text/file_reader.h"

namespace orb::testing {

namespace {

constexpr int most_points = 1000;

} // namespace

void FileReader::read_file(Cursor& cursor, std::optional<Named>& into) {
  const auto span = cursor.peek_span();
  if (into)
    return cursor.fail_at(span, rules::Place, "duplicate setting", "a test file can have only one");
  Named file;
  read_file(cursor, file);
  into = std::move(file);
}

void FileReader::read_file(Cursor& cursor, Named& into) {
  const auto from = cursor.offset();
  into.text = cursor.file_name();
  into.span = cursor.span_from(from);
  if (into.text == "=" || into.text == ":")
    into.text.clear(); // what follows is unexpected, and that is said
}

void FileReader::read_target(Cursor& cursor) {
  const auto found = spec::find_version(cursor.peek());
  std::vector<std::string_view> known;
  for (const auto& row : spec::basic_versions)
    known.push_back(row.text);
  if (!found)
    return cursor.fail(rules::Value, "the target must be an orbBasic version",
                       fmt::format("the versions are {}", fmt::join(known, ", ")));
  file_.target.version = *found;
  file_.target_word = cursor.word();
}

void FileReader::read_firmware(Cursor& cursor) {
  const auto* found = spec::find_firmware(cursor.peek());
  std::vector<std::string_view> known;
  for (const auto& row : spec::firmwares)
    known.push_back(row.name);
  if (found == nullptr)
    return cursor.fail(
        rules::Value, fmt::format("`{}` is not a firmware", cursor.peek()),
        did_you_mean(cursor.peek(), known,
                     fmt::format("the firmware versions are {}", fmt::join(known, ", "))));
  file_.firmware = found->firmware;
  cursor.word();
}

void FileReader::read_area(Cursor& cursor) {
  if (cursor.take_word("flash"))
    file_.target.area = spec::Area::Flash;
  else if (!cursor.take_word("ram"))
    cursor.fail(rules::Value, "the area must be `ram` or `flash`");
}

std::optional<Seeds> FileReader::read_seeds(Cursor& cursor) {
  const auto found = parse_seeds(cursor.peek());
  if (!found)
    cursor.fail(rules::Value,
                cursor.at_end() ? std::string("missing seeds")
                                : fmt::format("`{}` is not a range of seeds", cursor.peek()),
                "write it like `1..20`");
  else if (found->count() > most_seeds)
    cursor.fail(rules::Value, fmt::format("{} seeds are too many", found->count()),
                fmt::format("a test takes up to {}; write `{}..{}`", most_seeds, found->first,
                            found->first + most_seeds - 1));
  else {
    cursor.word();
    return found;
  }
  return std::nullopt;
}

std::optional<Duration> FileReader::read_bound(Cursor& cursor) {
  const auto time = cursor.time();
  if (!cursor.failed() && time == Duration{})
    cursor.fail(rules::Value, "a run needs a time greater than 0", "write it like `for 30s`");
  return time == Duration{} ? std::nullopt : std::optional(time);
}

void FileReader::read_test(Cursor& cursor, Span span, std::uint32_t line) {
  auto test = new_test();
  test.line = line;
  const auto from = cursor.offset();
  test.name.text = cursor.peek_char() == '"' ? cursor.quoted() : std::string();
  test.name.span = cursor.span_from(from);
  if (!cursor.failed() && trim(test.name.text).empty())
    cursor.fail_at(test.name.span.size() == 0 ? span : test.name.span, rules::Name,
                   "missing test name", "give it in quotes: `test \"stops at the wall\"`");
  for (const auto& other : file_.tests)
    if (other.name.text == test.name.text && !cursor.failed())
      cursor.fail_at(test.name.span, rules::Name,
                     fmt::format("duplicate test name \"{}\"", test.name.text),
                     fmt::format("the other one is on line {}", other.line));
  while (!cursor.failed() && !cursor.at_end())
    read_test_option(cursor, test);
  file_.tests.push_back(std::move(test));
}

void FileReader::read_test_option(Cursor& cursor, Test& test) {
  if (cursor.take_word("points"))
    test.points = static_cast<int>(cursor.whole("number of points", 0, most_points));
  else if (cursor.take_word("seeds"))
    test.seeds = read_seeds(cursor).value_or(test.seeds);
  else if (cursor.take_word("for"))
    test.bound = read_bound(cursor).value_or(test.bound);
  else
    cursor.fail(
        rules::Syntax, fmt::format("unexpected `{}`", cursor.peek()),
        did_you_mean(cursor.peek(), std::vector<std::string_view>{"points", "seeds", "for"},
                     "after the name you can write `points N`, `seeds A..B` and `for TIME`"));
}

void FileReader::read_reach(Cursor& cursor, Span span, std::uint32_t line) {
  Expectation one;
  one.word = Word::Inside;
  if (!read_whose(cursor, one))
    return;
  read_name(cursor, one, "zone");
  finish(cursor, one, span, line);
}

} // namespace orb::testing
