#pragma once

// Private to assembler/: the wait of each command.

#include "assembler/assemble.h"

#include <cstdint>

namespace orb::assembler {

/// The shortest and longest wait of a command, given the system delays.
struct Wait {
  std::int64_t least_ms = 0;
  std::int64_t most_ms = 0;
};

inline Wait wait_of(const PlacedCommand& command, std::int32_t sd1_ms, std::int32_t sd2_ms) {
  if (command.info == nullptr || command.origin == PlacedCommand::Origin::Broken)
    return {};
  switch (command.info->wait) {
  case spec::MacroWait::None: return {};
  case spec::MacroWait::Operand: {
    const auto time = command.value[command.info->operand_count - 1U];
    return {time, time};
  }
  case spec::MacroWait::Sd1: return {sd1_ms, sd1_ms};
  case spec::MacroWait::Sd2: return {sd2_ms, sd2_ms};
  case spec::MacroWait::Stopped: return {0, command.value[command.info->operand_count - 1U]};
  }
  return {};
}

} // namespace orb::assembler
