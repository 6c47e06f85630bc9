#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

enum class Ways : std::uint8_t { Keep, Split };

/// Computes what values variables can have at each line, and uses it: tests with a certain outcome
/// go, variables that are always a known number become that number, divisions and indices that
/// cannot fail are marked, indices that can only fail are noted, ways whose tests are decided lead
/// past them, and terms learn their ranges. Keeps what the program does; gives up, changing
/// nothing, on programs that no robot holds. Where nothing else changes, ways can be split. True
/// where something changed.
bool use_values(Code& code, Ways ways = Ways::Keep);

} // namespace orb::structured
