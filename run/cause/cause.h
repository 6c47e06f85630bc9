#pragma once

#include "base/message.h"
#include "compiler/text/program.h"
#include "spec/basic.h"
#include "vm/machine/machine.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::run {

/// Why a line stopped a program. What a machine would tell is missing where only the source is
/// known, as of a real ball; what is not known or would not help is empty.
struct Cause {
  std::string seen = {};      ///< `heading is 360, 0 to 359 allowed; use X % 360`
  std::string variables = {}; ///< that made it: `X is 360, S is 50`
  Message help = {};          ///< the line to write: `write `20 goroll X % 360,S,1``
  std::string aside = {};     ///< what not every ball does

  // The number that was wrong and what would have been right.
  std::string parameter = {};
  std::optional<std::int64_t> value = {};
  std::optional<std::int64_t> least = {};
  std::optional<std::int64_t> greatest = {};
};

/// `line` is where the program stopped with `error`; `machine` is the one that stopped there, as it
/// was then, or null.
Cause cause_of(const compiler::Program& program, const compiler::Line& line, spec::BasicError error,
               const vm::Machine* machine);

} // namespace orb::run
