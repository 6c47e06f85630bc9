#pragma once

// Traces macros in the order of the executive, with a clock but without a ball. Private to
// assembler/.

#include "assembler/assemble.h"
#include "assembler/waits.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace orb::assembler {

/// The position and time of the walk. Waits of unknown length give an earliest and a latest time.
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
  Endless, ///< it returned to an earlier state
  Leaves,  ///< at a goto to a macro outside the file
  Sleeps,
  Aborts, ///< at bytes that are not a command
  TooLong ///< after very many commands
};

struct WalkResult {
  WalkEnd end = WalkEnd::Ended;
  std::int64_t earliest_ms = 0;
  std::int64_t latest_ms = 0;
  bool calls_unknown = false; ///< a gosub left the file: its time is missing
  bool counts_by_api = false; ///< counted loop_start_system once
};

inline constexpr std::size_t longest_walk = 500'000; ///< commands

inline constexpr std::size_t nowhere = SIZE_MAX;

/// Maps an id to its macro; nowhere if no macro has it.
using MacrosById = std::array<std::size_t, spec::macro_id_temporary + 1>;

inline MacrosById macros_by_id(const Assembly& assembly) {
  MacrosById found;
  found.fill(nowhere);
  for (std::size_t i = assembly.macros.size(); i-- > 0;)
    found[assembly.macros[i].id.value_or(spec::macro_id_temporary)] = i;
  return found;
}

/// Traces one macro. Private to walk().
template <class Visitor>
class Walker {
public:
  Walker(const Assembly& assembly, std::size_t start, Visitor visit)
      : assembly_(assembly), by_id_(macros_by_id(assembly)), visit_(std::move(visit)) {
    now_.macro = start;
  }

  WalkResult run(std::size_t most) {
    std::optional<WalkEnd> end;
    for (std::size_t steps = 0; steps < most && !end; ++steps)
      end = step();
    result_.end = end.value_or(WalkEnd::TooLong);
    result_.earliest_ms = now_.earliest_ms;
    result_.latest_ms = now_.latest_ms;
    return result_;
  }

private:
  using MacroCommand = spec::MacroCommand;
  struct Place {
    std::size_t macro = 0;
    std::size_t command = 0;

    friend auto operator<=>(const Place&, const Place&) = default;
  };
  static constexpr Place elsewhere{nowhere, 0};
  struct Loop {
    Place first = elsewhere;
    std::int32_t left = 0;

    friend auto operator<=>(const Loop&, const Loop&) = default;
  };

  /// Executes one command; returns how the walk ended, if it did.
  std::optional<WalkEnd> step() {
    const auto& macro = assembly_.macros[now_.macro];
    const auto is_stream = macro.id == spec::macro_id_stream;
    if (now_.command >= macro.commands.size())
      return is_stream ? WalkEnd::Ended : come_back();
    visit_(std::as_const(now_));
    const auto& command = macro.commands[now_.command];
    if (command.info == nullptr)
      return WalkEnd::Aborts;
    ++now_.command;
    if (command.origin == PlacedCommand::Origin::Broken)
      return std::nullopt;
    const auto kind = command.info->command;
    if (kind == MacroCommand::End && !is_stream)
      return come_back();
    if (kind == MacroCommand::StreamEnd)
      return WalkEnd::Ended;
    const auto wait = wait_of(command, now_.sd1_ms, now_.sd2_ms);
    now_.earliest_ms += wait.least_ms;
    now_.latest_ms += wait.most_ms;
    if (kind == MacroCommand::Sleep)
      return WalkEnd::Sleeps;
    if (kind == MacroCommand::Goto)
      return jump(command.value[0]);
    if (kind == MacroCommand::Gosub && !now_.in_gosub && !is_stream)
      call(command.value[0]);
    else if (kind == MacroCommand::SetSd1)
      now_.sd1_ms = command.value[0];
    else if (kind == MacroCommand::SetSd2)
      now_.sd2_ms = command.value[0];
    else
      repeat(kind, command.value[0]);
    return std::nullopt;
  }

  std::optional<WalkEnd> come_back() {
    if (!now_.in_gosub)
      return WalkEnd::Ended;
    now_.in_gosub = false;
    go_to(caller_);
    return std::nullopt;
  }

  void go_to(Place place) {
    now_.macro = place.macro;
    now_.command = place.command;
  }

  std::optional<WalkEnd> jump(std::int32_t id) {
    const auto target = by_id_[static_cast<std::uint8_t>(id)];
    if (target == nowhere)
      return WalkEnd::Leaves;
    go_to({target, 0});
    const auto is_new =
        jumps_
            .insert({target, now_.sd1_ms, now_.sd2_ms, loop_, now_.in_gosub ? caller_ : elsewhere})
            .second;
    return is_new ? std::nullopt : std::optional(WalkEnd::Endless);
  }

  void call(std::int32_t id) {
    const auto target = by_id_[static_cast<std::uint8_t>(id)];
    if (target == nowhere) {
      result_.calls_unknown = true;
      return;
    }
    caller_ = {now_.macro, now_.command};
    now_.in_gosub = true;
    go_to({target, 0});
  }

  void repeat(MacroCommand kind, std::int32_t count) {
    if (kind == MacroCommand::LoopStart)
      loop_ = {{now_.macro, now_.command}, std::max(count, 1)};
    if (kind == MacroCommand::LoopStartSystem) {
      result_.counts_by_api = true;
      loop_ = {{now_.macro, now_.command}, 1};
    }
    if (kind != MacroCommand::LoopEnd || loop_.first.macro != now_.macro)
      return;
    if (--loop_.left > 0)
      go_to(loop_.first);
    else
      loop_ = {};
  }

  const Assembly& assembly_;
  MacrosById by_id_;
  Visitor visit_;
  WalkResult result_;
  Visit now_;
  Place caller_;
  Loop loop_;
  /// The states at each jump to a macro; a repeated one is an endless loop.
  std::set<std::tuple<std::size_t, std::int32_t, std::int32_t, Loop, Place>> jumps_;
};

/// Calls `visit(Visit)` for each command in execution order, at most `most` times.
template <class Visitor>
WalkResult walk(const Assembly& assembly, std::size_t start, std::size_t most, Visitor visit) {
  return Walker(assembly, start, std::move(visit)).run(most);
}

} // namespace orb::assembler
