#pragma once

// Looks up the words of orbBasic by one multiplication: each word fits into 64 bits, and the
// multiplier is searched at compile time so that no two words share a slot.

#include "base/text/text.h"
#include "spec/basic.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace orb::compiler {

enum class WordKind : std::uint8_t {
  Unknown,
  Statement, ///< `index` is a spec::Statement
  Function,  ///< `index` is a spec::Function
  Variable,  ///< `index` is a spec::Variable
  Letter,    ///< `index` is 0 for A to 25 for Z
  Particle,  ///< `then`, `to`, …
};

struct Word {
  WordKind kind = WordKind::Unknown;
  std::uint8_t index = 0;
};

namespace words {

inline constexpr std::size_t longest = 8;
inline constexpr unsigned slot_bits = 9;

/// Packs the characters of a word, the first one lowest.
constexpr std::uint64_t pack(std::string_view word) {
  std::uint64_t packed = 0;
  for (std::size_t i = 0; i < word.size() && i < longest; ++i)
    packed |= static_cast<std::uint64_t>(static_cast<unsigned char>(word[i])) << (8 * i);
  return packed;
}

struct Entry {
  std::uint64_t packed = 0;
  Word word;
};

inline constexpr std::size_t count = [] {
  std::size_t n = spec::statements.size() + spec::functions.size() + spec::variables.size() +
                  spec::particles.size();
  for (const auto& row : spec::variables)
    n += row.old_word.empty() ? 0 : 1;
  return n;
}();

inline constexpr std::array<Entry, count> entries = [] {
  std::array<Entry, count> all{};
  std::size_t n = 0;
  const auto add = [&](std::string_view text, WordKind kind, std::size_t index) {
    all[n++] = Entry{pack(text), Word{kind, static_cast<std::uint8_t>(index)}};
  };
  for (std::size_t i = 0; i < spec::statements.size(); ++i)
    add(spec::statements[i].word, WordKind::Statement, i);
  for (std::size_t i = 0; i < spec::functions.size(); ++i)
    add(spec::functions[i].word, WordKind::Function, i);
  for (std::size_t i = 0; i < spec::variables.size(); ++i) {
    add(spec::variables[i].word, WordKind::Variable, i);
    if (!spec::variables[i].old_word.empty())
      add(spec::variables[i].old_word, WordKind::Variable, i);
  }
  for (std::size_t i = 0; i < spec::particles.size(); ++i)
    add(spec::particles[i], WordKind::Particle, i);
  return all;
}();

constexpr bool all_short() {
  for (const auto& row : spec::statements)
    if (row.word.size() > longest)
      return false;
  for (const auto& row : spec::variables)
    if (row.word.size() > longest || row.old_word.size() > longest)
      return false;
  return true;
}
static_assert(all_short(), "a word has more than 8 letters: widen pack()");

constexpr std::size_t slot(std::uint64_t packed, std::uint64_t multiplier) {
  return static_cast<std::size_t>((packed * multiplier) >> (64 - slot_bits));
}

inline constexpr std::uint64_t multiplier = [] {
  // Arbitrary constants: they only start and step the search.
  std::uint64_t candidate = 0x9E3779B97F4A7C15;
  for (;;) {
    std::array<bool, 1 << slot_bits> taken{};
    bool good = true;
    for (const auto& entry : entries) {
      auto& place = taken[slot(entry.packed, candidate)];
      if (place) {
        good = false;
        break;
      }
      place = true;
    }
    if (good)
      return candidate;
    candidate = candidate * 6364136223846793005U + 1442695040888963407U; // any odd pair will do
  }
}();

/// Indices into `entries`; `count` for an empty slot.
inline constexpr std::array<std::uint8_t, 1 << slot_bits> slots = [] {
  std::array<std::uint8_t, 1 << slot_bits> table{};
  for (auto& place : table)
    place = static_cast<std::uint8_t>(count);
  for (std::size_t i = 0; i < count; ++i)
    table[slot(entries[i].packed, multiplier)] = static_cast<std::uint8_t>(i);
  return table;
}();
static_assert(count < UINT8_MAX);

} // namespace words

/// The meaning of `packed` (see words::pack), a word of `length` letters.
constexpr Word find_word(std::uint64_t packed, std::size_t length) {
  if (length == 1) {
    const auto c = static_cast<char>(packed);
    return {WordKind::Letter, static_cast<std::uint8_t>(to_lower(c) - 'a')};
  }
  if (length > words::longest)
    return {};
  const auto place = words::slots[words::slot(packed, words::multiplier)];
  if (place == words::count || words::entries[place].packed != packed)
    return {};
  return words::entries[place].word;
}

constexpr Word find_word(std::string_view text) {
  return text.empty() ? Word{} : find_word(words::pack(text), text.size());
}

} // namespace orb::compiler
