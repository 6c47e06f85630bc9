#pragma once

#include "base/message.h"
#include "compiler/text/program.h"
#include "spec/basic.h"
#include "vm/machine/machine.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::run {

/// Why a line stopped a program. Values are missing if only the source is known, as with a real
/// ball; a text is empty if it is unknown or would not help.
struct Cause {
  std::string seen = {};      ///< `heading is 360, 0 to 359 allowed; use X % 360`
  std::string variables = {}; ///< the variables behind it: `X is 360, S is 50`
  Message help = {};          ///< the line to write: `write `20 goroll X % 360,S,1``
  std::string aside = {};     ///< what some balls do instead

  // The offending number and its permitted range.
  std::string parameter = {};
  std::optional<std::int64_t> value = {};
  std::optional<std::int64_t> least = {};
  std::optional<std::int64_t> greatest = {};
};

/// `line` is where the program stopped with `error`. `machine` is the stopped machine in that
/// state, or null.
Cause cause_of(const compiler::Program& program, const compiler::Line& line, spec::BasicError error,
               const vm::Machine* machine);

} // namespace orb::run
