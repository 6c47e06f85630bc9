#include "editor/printed/word_lists.h"

#include "editor/word_at.h"
#include "spec/basic.h"
#include "spec/macro.h"
#include "structured/text/structured_words.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <functional>

namespace orb::editor {

Words control_words() {
  auto words = words_of(spec::statements, directs_the_flow);
  words.insert(words.begin(), spec::particles.begin(), spec::particles.end());
  return words;
}

Words statement_words() {
  return words_of(spec::statements, std::not_fn(directs_the_flow));
}

Words function_words() {
  return words_of(spec::functions);
}

Words variable_words() {
  Words words;
  for (const auto& row : spec::variables) {
    words.push_back(row.word);
    if (!row.old_word.empty())
      words.push_back(row.old_word);
  }
  return words;
}

Words macro_command_words() {
  Words words;
  for (const auto& row : spec::macro_commands)
    words.push_back(row.mnemonic);
  return words;
}

/// The words only structured programs have, and those that end blocks or jump.
Words structured_control_words() {
  auto words = control_words();
  std::erase_if(words, [](std::string_view word) {
    return structured::find_word(word).kind == structured::WordKind::Name || word == "gosub" ||
           word == "on";
  });
  for (const auto& row : structured::keywords)
    if (std::find(words.begin(), words.end(), row.word) == words.end())
      words.push_back(row.word);
  return words;
}

Words structured_statement_words() {
  auto words = statement_words();
  std::erase_if(words, [](std::string_view word) {
    return structured::find_word(word).kind == structured::WordKind::Name; // `let`
  });
  return words;
}

/// Flags and named values of operands.
Words macro_value_words() {
  Words words;
  const auto add = [&](std::string_view word) {
    if (std::find(words.begin(), words.end(), word) == words.end())
      words.push_back(word);
  };
  for (const auto& row : spec::macro_flags)
    add(row.word);
  for (const auto& row : spec::macro_commands)
    for (const auto& operand : row)
      for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
        add(word->word);
  return words;
}

Words test_words() {
  auto words = words_of(testing::line_words);
  const auto add = [&](const auto& more) {
    for (const auto word : more)
      if (std::find(words.begin(), words.end(), word) == words.end()) // `for` begins a line as well
        words.emplace_back(word);
  };
  add(words_of(testing::when_words));
  add(words_of(testing::join_words));
  add(testing::operand_words());
  words.emplace_back("end");
  return words;
}

Words expectation_words() {
  return words_of(testing::expectations,
                  [](const auto& row) { return &row != &testing::info(testing::Word::Variable); });
}

Words stimulus_words() {
  return words_of(vm::stimulus_words);
}

} // namespace orb::editor
