#pragma once

#include "structured/text/program.h"

#include <optional>
#include <string_view>
#include <vector>

namespace orb::structured {

/// What `end WORD` ends, where WORD is one that can be ended.
std::optional<Kind> end_of_block(std::string_view word);

/// What ends the block of an opener; Broken for anything else.
Kind end_of(Kind opener);

/// How the end of a block is written: `end if`, `next`.
std::string_view words_of_end(Kind end);

/// The words that `end` ends: `if`, `while` …
std::vector<std::string_view> words_after_end();

/// Links the statements of a file that open, part and close the same block, and reports those that
/// do not fit.
void link_blocks(Program& program, const File& file);

/// The statement's block words: whether it opens a block, parts or closes one.
bool opens_block(Kind kind);
bool parts_block(Kind kind);
bool closes_block(Kind kind);
bool is_loop(Kind kind);

/// Whether a statement declares something for the whole program.
bool declares(Kind kind);

} // namespace orb::structured
