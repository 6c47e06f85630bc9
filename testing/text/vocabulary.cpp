#include "testing/text/vocabulary.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb::testing {

std::vector<std::string_view> operand_words() {
  std::vector<std::string_view> words{"to", "times"};
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows)
      for (const auto& slot : row.slots)
        if (!slot.before.empty() && is_letter(slot.before[0]) &&
            std::find(words.begin(), words.end(), slot.before) == words.end())
          words.push_back(slot.before);
  };
  add(line_words);
  add(expectations);
  add(join_words);
  return words;
}

} // namespace orb::testing
