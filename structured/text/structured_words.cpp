#include "structured/text/structured_words.h"

#include "spec/colours.h"

namespace orb::structured {
namespace {

// Each word fits into 64 bits; the table uses open addressing.
constexpr std::size_t longest = 8;
constexpr std::size_t slots = 512;

constexpr std::uint64_t pack(std::string_view word) {
  std::uint64_t packed = 0;
  for (std::size_t i = 0; i < word.size(); ++i)
    packed |= static_cast<std::uint64_t>(static_cast<unsigned char>(to_lower(word[i]))) << (8 * i);
  return packed;
}

constexpr std::size_t slot(std::uint64_t packed) {
  return static_cast<std::size_t>((packed * 0x9E3779B97F4A7C15U) >> 55);
}
static_assert(slots == std::size_t{1} << (64 - 55));

struct Entry {
  std::uint64_t packed = 0;
  Word word;
};

constexpr auto table = [] {
  std::array<Entry, slots> all{};
  const auto add = [&](std::string_view text, WordKind kind, std::size_t index) {
    auto at = slot(pack(text));
    while (all[at].packed != 0)
      at = (at + 1) % slots;
    all[at] = {pack(text), {kind, static_cast<std::uint8_t>(index)}};
  };
  for (std::size_t i = 0; i < spec::statements.size(); ++i)
    if (spec::statements[i].statement != spec::Statement::Let)
      add(spec::statements[i].word, WordKind::Statement, i);
  for (std::size_t i = 0; i < spec::functions.size(); ++i)
    add(spec::functions[i].word, WordKind::Function, i);
  for (std::size_t i = 0; i < spec::variables.size(); ++i) {
    add(spec::variables[i].word, WordKind::Variable, i);
    if (!spec::variables[i].old_word.empty())
      add(spec::variables[i].old_word, WordKind::Variable, i);
  }
  for (std::size_t i = 0; i < keywords.size(); ++i)
    add(keywords[i].word, WordKind::Keyword, i);
  return all;
}();

} // namespace

Word find_word(std::string_view text) {
  if (text.empty() || text.size() > longest)
    return {};
  const auto packed = pack(text);
  for (auto at = slot(packed); table[at].packed != 0; at = (at + 1) % slots)
    if (table[at].packed == packed)
      return table[at].word;
  return {};
}

std::string_view spelling(Word word) {
  switch (word.kind) {
  case WordKind::Name: return {};
  case WordKind::Keyword: return keywords[word.index].word;
  case WordKind::Statement: return spec::statements[word.index].word;
  case WordKind::Function: return spec::functions[word.index].word;
  case WordKind::Variable: return spec::variables[word.index].word;
  }
  return {};
}

std::optional<std::uint32_t> find_colour(std::string_view name) {
  for (const auto& colour : spec::colours)
    if (!colour.name.empty() && equal_words(colour.name, name))
      return colour.rgb;
  return std::nullopt;
}

std::vector<std::string_view> colour_names() {
  std::vector<std::string_view> names;
  for (const auto& colour : spec::colours)
    if (!colour.name.empty())
      names.push_back(colour.name);
  return names;
}

} // namespace orb::structured
