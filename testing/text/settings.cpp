#include "testing/text/file_reader.h"

#include "base/meant.h"

namespace orb::testing {

void FileReader::read_file(Cursor& cursor, const Slot& slot, std::optional<Named>& into) {
  const auto span = cursor.peek_span();
  if (into)
    return cursor.fail_at(span, rules::Place, file_texts::DuplicateSetting(),
                          file_texts::OnlyOneSetting());
  into = named(cursor.read(slot));
}

Named FileReader::named(const SlotValue& value) {
  const bool is_sign = value.text == "=" || value.text == ":";
  // what follows is unexpected, and a finding says so
  return {is_sign ? "" : value.text, value.span};
}

void FileReader::read_target(Cursor& cursor, const SlotValue& value) {
  const auto found = spec::find_version(value.text);
  const auto known = words_of(spec::basic_versions, &spec::BasicVersionInfo::text);
  if (!found)
    return cursor.fail_at(value.span, rules::Value, file_texts::NotAVersion(),
                          file_texts::Versions(listed(known)));
  file_.target.version = *found;
  file_.target_word = value.text;
}

void FileReader::read_firmware(Cursor& cursor, const SlotValue& value) {
  const auto* found = spec::find_firmware(value.text);
  const auto known = words_of(spec::firmwares, &spec::FirmwareInfo::name);
  if (found == nullptr)
    return cursor.fail_at(value.span, rules::Value, file_texts::NotAFirmware(value.text),
                          meant_or(value.text, known, file_texts::Firmwares(listed(known))));
  file_.firmware = found->firmware;
}

std::optional<Seeds> FileReader::read_seeds(Cursor& cursor, const SlotValue& value) {
  const auto found = parse_seeds(value.text);
  if (!found)
    cursor.fail_at(value.span, rules::Value, file_texts::NotSeeds(value.text),
                   file_texts::WriteLike(slot::seeds.usual));
  else if (found->count() > most_seeds)
    cursor.fail_at(value.span, rules::Value, file_texts::TooManySeeds(found->count()),
                   file_texts::MostSeeds(most_seeds, fmt::format("{}..{}", found->first,
                                                                 found->first + most_seeds - 1)));
  else
    return found;
  return std::nullopt;
}

std::optional<Duration> FileReader::read_bound(Cursor& cursor, const SlotValue& value) {
  if (value.is_given() && value.to == Duration{})
    cursor.fail_at(value.span, rules::Value, file_texts::RunNeedsTime(),
                   file_texts::WriteLike("for 30s"));
  return value.to == Duration{} ? std::nullopt : std::optional(value.to);
}

void FileReader::read_test(Cursor& cursor, Span span, std::uint32_t line) {
  auto test = new_test();
  test.line = line;
  if (cursor.peek_char() != '"')
    cursor.fail_at(span, rules::Name, file_texts::MissingTestName(), file_texts::NameInQuotes());
  const auto values = cursor.read(info(LineWord::Test).slots);
  const auto& name = values[0];
  test.name = {name.text, name.span};
  if (!cursor.failed() && trim(name.text).empty())
    cursor.fail_at(name.span, rules::Name, file_texts::MissingTestName(),
                   file_texts::NameInQuotes());
  for (const auto& other : file_.tests)
    if (other.name.text == name.text)
      cursor.fail_at(name.span, rules::Name, file_texts::DuplicateTestName(name.text),
                     file_texts::OtherOnLine(other.line));
  if (values[1].is_given())
    test.points = static_cast<int>(values[1].most);
  if (values[2].is_given())
    test.seeds = read_seeds(cursor, values[2]).value_or(test.seeds);
  test.bound = read_bound(cursor, values[3]).value_or(test.bound);
  if (!cursor.at_end())
    cursor.fail(rules::Syntax, file_texts::Unexpected(cursor.peek()),
                meant_or(cursor.peek(), std::vector<std::string_view>{"points", "seeds", "for"},
                         file_texts::BehindTestName()));
  file_.tests.push_back(std::move(test));
}

void FileReader::read_reach(Cursor& cursor, Span span, std::uint32_t line) {
  Expectation one;
  one.word = Word::Inside;
  if (!read_whose(cursor, one))
    return;
  read_operands(cursor, one);
  finish(cursor, one, span, line);
}

} // namespace orb::testing
