#pragma once

// Private to repair/.

#include "repair/line.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace orb::repair {

/// A rewrite of a line: changes the tokens, and sets `incomplete` if it adds something that was not
/// typed.
struct Rewrite {
  std::uint8_t languages; ///< a bit for each Language
  void (*apply)(Line&);
  std::string_view before; ///< an example in the first of these languages; a test runs it
  std::string_view after;
};

/// All rewrites, in the order of application.
std::span<const Rewrite> rewrites();

/// Rewrites a line towards the notation of its language: spellings, signs, labels, quotes.
void normalise(Line& line);

// keys.cpp
void comma_for_point(Line& line);
void join_words(Line& line);
void missed_signs(Line& line);
void single_letters(Line& line);

// signs.cpp
void decimal_numbers(Line& line);
void drop_sigils(Line& line);
void close_block(Line& line);
void close_text(Line& line);
void compare_with_true(Line& line);
void drop_colons(Line& line);
void drop_types(Line& line);
void index_arrays(Line& line);
void plain_signs(Line& line);
void read_thousands(Line& line);
void words_with_one_quote(Line& line);

// wordings.cpp
void documented_spelling(Line& line);
void drop_prefixes(Line& line);
void drop_small_words(Line& line);
void other_forms(Line& line);
void own_words(Line& line);

} // namespace orb::repair
