#pragma once

// Follows macros as the executive does, with a clock but without a ball. Private to assembler/.

#include "assembler/assemble.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <tuple>

namespace orb::assembler {

/// Where the walk is, and when. Waits of unknown length make an earliest and a latest time.
struct Visit {
  std::size_t macro = 0;
  std::size_t command = 0;
  std::int64_t earliest_ms = 0;
  std::int64_t latest_ms = 0;
  std::int32_t sd1_ms = 0;
  std::int32_t sd2_ms = 0;
  bool in_gosub = false;
};

/// Why a walk ended.
enum class WalkEnd : std::uint8_t {
  Ended,   ///< at the last End
  Endless, ///< it came back to a state in which it had been
  Leaves,  ///< at a goto to a macro that is not in the file
  Sleeps,
  Aborts, ///< at bytes that are no command
  TooLong ///< after very many commands
};

struct WalkResult {
  WalkEnd end = WalkEnd::Ended;
  std::int64_t earliest_ms = 0;
  std::int64_t latest_ms = 0;
  bool calls_unknown = false; ///< a gosub left the file: its time is missing
  bool counts_by_api = false; ///< loop_start_system counted as once
};

inline constexpr std::size_t longest_walk = 500'000; ///< commands

/// Which macro has an id; nowhere where none has.
inline constexpr std::size_t nowhere = SIZE_MAX;

inline std::array<std::size_t, 256> macros_by_id(const Assembly& assembly) {
  std::array<std::size_t, 256> found;
  found.fill(nowhere);
  for (std::size_t i = assembly.macros.size(); i-- > 0;)
    found[assembly.macros[i].id.value_or(spec::macro_id_temporary)] = i;
  return found;
}

/// How long a command waits, given the system delays: earliest and latest.
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

/// Calls `visit(Visit)` for each command in the order in which they run, `most` of them.
template <class Visitor>
WalkResult walk(const Assembly& assembly, std::size_t start, std::size_t most, Visitor visit) {
  using spec::MacroCommand;
  struct Place {
    std::size_t macro = 0;
    std::size_t command = 0;
  };
  struct Loop {
    std::size_t macro = SIZE_MAX;
    std::size_t first = 0;
    std::int32_t left = 0;
  };
  WalkResult result;
  Visit now;
  now.macro = start;
  Place caller;
  Loop loop;
  std::set<std::tuple<std::size_t, std::int32_t, std::int32_t, std::size_t, std::size_t,
                      std::int32_t, std::size_t>>
      jumps;
  const auto by_id = macros_by_id(assembly);
  const auto find = [&](std::int32_t id) { return by_id[static_cast<std::uint8_t>(id)]; };
  const auto ended = [&](WalkEnd end) {
    result.end = end;
    result.earliest_ms = now.earliest_ms;
    result.latest_ms = now.latest_ms;
    return result;
  };
  for (std::size_t steps = 0; steps < most; ++steps) {
    const auto& macro = assembly.macros[now.macro];
    const bool at_end = now.command >= macro.commands.size();
    if (!at_end)
      visit(now);
    const auto* command = at_end ? nullptr : &macro.commands[now.command];
    if (!at_end && command->info == nullptr)
      return ended(WalkEnd::Aborts);
    const auto kind = at_end ? MacroCommand::End : command->info->command;
    if (!at_end && command->origin == PlacedCommand::Origin::Broken) {
      ++now.command;
      continue;
    }
    if (kind == MacroCommand::End && macro.id != spec::macro_id_stream) {
      if (!now.in_gosub)
        return ended(WalkEnd::Ended);
      now.in_gosub = false;
      now.macro = caller.macro;
      now.command = caller.command;
      continue;
    }
    if (at_end || kind == MacroCommand::StreamEnd)
      return ended(WalkEnd::Ended);
    const auto wait = wait_of(*command, now.sd1_ms, now.sd2_ms);
    now.earliest_ms += wait.least_ms;
    now.latest_ms += wait.most_ms;
    ++now.command;
    if (kind == MacroCommand::SetSd1) {
      now.sd1_ms = command->value[0];
    } else if (kind == MacroCommand::SetSd2) {
      now.sd2_ms = command->value[0];
    } else if (kind == MacroCommand::Sleep) {
      return ended(WalkEnd::Sleeps);
    } else if (kind == MacroCommand::LoopStart || kind == MacroCommand::LoopStartSystem) {
      const bool fixed = kind == MacroCommand::LoopStart;
      result.counts_by_api = result.counts_by_api || !fixed;
      loop = {now.macro, now.command, fixed ? std::max(command->value[0], 1) : 1};
    } else if (kind == MacroCommand::LoopEnd && loop.macro == now.macro) {
      if (--loop.left > 0)
        now.command = loop.first;
      else
        loop = {};
    } else if (kind == MacroCommand::Goto) {
      const auto target = find(command->value[0]);
      if (target == nowhere)
        return ended(WalkEnd::Leaves);
      now.macro = target;
      now.command = 0;
      if (!jumps
               .insert({target, now.sd1_ms, now.sd2_ms, loop.macro, loop.first, loop.left,
                        now.in_gosub ? caller.macro * 65536 + caller.command : SIZE_MAX})
               .second)
        return ended(WalkEnd::Endless);
    } else if (kind == MacroCommand::Gosub && !now.in_gosub && macro.id != spec::macro_id_stream) {
      const auto target = find(command->value[0]);
      if (target == nowhere) {
        result.calls_unknown = true;
        continue;
      }
      caller = {now.macro, now.command};
      now.in_gosub = true;
      now.macro = target;
      now.command = 0;
    }
  }
  return ended(WalkEnd::TooLong);
}

} // namespace orb::assembler
