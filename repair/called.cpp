#include "repair/called.h"

#include "base/text/text.h"
#include "repair/colours.h"
#include "repair/word_index.h"

#include <algorithm>
#include <array>

namespace orb::repair {
namespace {

struct Calling {
  std::string_view name;
  std::string_view words;
};
constexpr auto callings = std::to_array<Calling>({
#define ORB_CALLED(name, words) {name, words},
#include "repair/idioms.def"
});

constexpr auto counts = std::to_array<std::string_view>({
#define ORB_COUNTED(words) words,
#include "repair/idioms.def"
});

const WordIndex& called_by() {
  static const WordIndex index(callings, [](const Calling& calling) { return calling.words; });
  return index;
}

} // namespace

bool is_called(std::string_view operand, std::string_view word) {
  const auto& lists = called_by().lists_of(word);
  return std::any_of(lists.begin(), lists.end(),
                     [&](std::size_t list) { return callings[list].name == operand; });
}

std::vector<std::string_view> meanings_of(std::string_view word) {
  std::vector<std::string_view> found;
  for (const auto list : called_by().lists_of(word))
    found.push_back(callings[list].name);
  return found;
}

std::vector<std::string_view> called_words() {
  std::vector<std::string_view> all;
  for (const auto& calling : callings)
    if (!calling.name.empty())
      for (const auto word : words_in(calling.words))
        all.push_back(word);
  return all;
}

bool mean_the_same(std::string_view a, std::string_view b) {
  if (is_called(a, b) || is_called(b, a))
    return true;
  const auto theirs = meanings_of(b);
  for (const auto mine : meanings_of(a))
    if (!mine.empty() && std::find(theirs.begin(), theirs.end(), mine) != theirs.end())
      return true;
  return false;
}

std::optional<std::string> test_colour(const Token& token) {
  return write_colour("testcolour", {token});
}

int count_of(const Token& token) {
  static const WordIndex index(counts, [](std::string_view list) { return list; });
  if (token.is_number())
    return parse_number<int>(token.text).value_or(0);
  const auto& lists = index.lists_of(token.text);
  return lists.empty() ? 0 : static_cast<int>(lists.front()) + 1;
}

} // namespace orb::repair
