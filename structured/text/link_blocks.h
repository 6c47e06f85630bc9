#pragma once

#include "structured/text/program.h"

#include <optional>
#include <string_view>
#include <vector>

namespace orb::structured {

/// The kind of end for `end WORD`; nothing if WORD cannot be ended.
std::optional<Kind> end_of_block(std::string_view word);

/// The kind of end for an opener; Broken for anything else.
Kind end_of(Kind opener);

/// The words of a block end: `end if`, `next`.
std::string_view words_of_end(Kind end);

/// The words that may follow `end`: `if`, `while` …
std::vector<std::string_view> words_after_end();

/// Links the statements of a file that open, divide and close the same block, and reports
/// mismatches.
void link_blocks(Program& program, const File& file);

/// True if the statement opens a block; the same for dividing and closing one.
bool opens_block(Kind kind);
bool parts_block(Kind kind);
bool closes_block(Kind kind);
bool is_loop(Kind kind);

/// True if the statement is a global declaration.
bool declares(Kind kind);

} // namespace orb::structured
