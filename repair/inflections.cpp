#include "repair/inflections.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/idioms.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace orb::repair {
namespace {

constexpr std::size_t shortest_stem = 4; // letters

/// True if the ending may follow a stem.
bool is_ending(std::string_view end) {
  return holds("a e i o u n r s t d as es is os an en in am em er ir ar re et st te ez ed de "
               "ung ado ada ido ida ato ata ito ita are ere ire ion ons ent ant ite ate ete ando "
               "endo indo iendo iert ieren ing ungen ement amos emos imos iamo",
               end) ||
         end.empty();
}

struct Form {
  std::string letters;
  std::string_view word;
};

/// Words indexed by the first letters of their stems.
class Forms {
public:
  explicit Forms(const std::vector<std::string_view>& words) {
    for (const auto word : words)
      if (auto letters = plain_letters(word); letters.size() >= shortest_stem)
        by_stem_[letters.substr(0, shortest_stem)].push_back({std::move(letters), word});
  }

  /// The word with the longest common prefix, perhaps itself; empty if none is close.
  std::string_view nearest(std::string_view word) const {
    const auto letters = plain_letters(word);
    const auto near = by_stem_.find(letters.substr(0, shortest_stem));
    std::string_view best;
    std::size_t longest = 0;
    if (letters.size() >= shortest_stem && near != by_stem_.end())
      for (const auto& form : near->second) {
        if (equal_words(form.word, word))
          return form.word;
        const auto differ =
            std::mismatch(letters.begin(), letters.end(), form.letters.begin(), form.letters.end());
        const auto stem = static_cast<std::size_t>(differ.first - letters.begin());
        const auto end = std::string_view(letters).substr(stem);
        const auto other = std::string_view(form.letters).substr(stem);
        const bool extends = end.empty() || other.empty();
        if (stem > longest && (extends || stem > shortest_stem) && is_ending(end) &&
            is_ending(other)) {
          longest = stem;
          best = form.word;
        }
      }
    return best;
  }

private:
  std::unordered_map<std::string, std::vector<Form>> by_stem_;
};

} // namespace

std::string plain_letters(std::string_view word) {
  constexpr std::string_view plain = // of U+00C0 to U+00FF
      "aaaaaaaceeeeiiiidnooooo ouuuuy saaaaaaaceeeeiiiidnooooo ouuuuy y";
  std::string letters;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (word[i] == '\xC3' && i + 1 < word.size() && is_utf8_tail(word[i + 1]))
      letters += plain[static_cast<unsigned char>(word[++i]) & 0x3FU];
    else
      letters += to_lower(word[i]);
  return letters;
}

std::string_view known_form_of(std::string_view word, Language language) {
  static const Forms spoken(spoken_words());
  static const Forms called(called_words());
  const bool programs = language == Language::Basic || language == Language::Structured;
  const auto first = (programs ? spoken : called).nearest(word);
  return first.empty() ? (programs ? called : spoken).nearest(word) : first;
}

} // namespace orb::repair
