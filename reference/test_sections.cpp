// The words of tests and stimulus scripts.

#include "reference/sections.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

/// A word with its syntax and an example.
template <class Row>
Entry entry_of(const Row& row, std::string_view before) {
  Entry entry;
  entry.name = row.word;
  entry.summary = row.summary;
  entry.facts.emplace_back("usage", fmt::format("{}{}", before, usage(row.word, row.slots)));
  entry.facts.emplace_back("example", row.example);
  return entry;
}

/// The times at which an expectation can be judged.
std::string_view times_of(testing::Kind kind) {
  using testing::Kind;
  switch (kind) {
  case Kind::State: return "within, at, at end, during; else at some moment";
  case Kind::Stay: return "during; else in the whole run";
  case Kind::Event: return "within, during; else in the whole run";
  case Kind::Output: return "the whole run";
  case Kind::End: return "within";
  case Kind::Final: return "at end";
  }
  return {};
}

std::string words_of_expectations() {
  std::string text;
  for (const auto& row : testing::expectations)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", row.word);
  return text;
}

} // namespace

Section stimulus_section() {
  Section section{"stimuli", "Words of stimulus scripts", "stimulus", {}};
  for (const auto& row : vm::stimulus_words)
    section.entries.push_back(entry_of(row, row.word == "wall" ? "" : "at TIME "));
  return section;
}

Section test_lines_section() {
  Section section{"test-lines", "Lines of a test file", "line of a test file", {}};
  for (const auto& row : testing::line_words) {
    auto entry = entry_of(row, "");
    if (usage(row.slots).starts_with("WHAT"))
      entry.facts.emplace_back("what", words_of_expectations());
    if (&row == &testing::info(testing::LineWord::For)) {
      const auto& lasts = testing::info(testing::JoinWord::Lasts);
      entry.facts.emplace_back("after a state", lasts.summary);
      entry.facts.emplace_back("then", lasts.example);
    }
    section.entries.push_back(std::move(entry));
  }
  for (const auto& row : testing::when_words)
    section.entries.push_back(entry_of(row, "expect WHAT "));
  for (const auto& row : testing::join_words)
    if (&row != &testing::info(testing::JoinWord::Lasts)) // `for` is listed as a line
      section.entries.push_back(entry_of(row, "expect WHAT "));
  return section;
}

Section expectations_section() {
  Section section{"expectations", "What a test can expect", "expectation", {}};
  for (const auto& row : testing::expectations) {
    auto entry = entry_of(row, "expect ");
    if (&row == &testing::info(testing::Word::Variable))
      entry.facts.front().second = fmt::format("expect {}", usage(row.slots));
    entry.facts.emplace_back("when", times_of(row.kind));
    entry.facts.emplace_back("never", row.never == testing::Never::Yes ? "yes" : "no");
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
