#include "assembler/timing.h"

#include "assembler/text/program.h"
#include "assembler/walk.h"

#include <fmt/format.h>

namespace orb::assembler {
namespace {

TimingNote note_of(const WalkResult& result) {
  switch (result.end) {
  case WalkEnd::Endless: return TimingNote::Endless;
  case WalkEnd::Leaves: return TimingNote::Leaves;
  case WalkEnd::Sleeps: return TimingNote::Sleeps;
  case WalkEnd::Aborts: return TimingNote::Broken;
  case WalkEnd::TooLong: return TimingNote::TooLong;
  case WalkEnd::Ended: break;
  }
  if (result.calls_unknown)
    return TimingNote::Calls;
  if (result.counts_by_api)
    return TimingNote::SystemLoops;
  return result.earliest_ms == result.latest_ms ? TimingNote::Exact : TimingNote::UntilStopped;
}

} // namespace

MacroTiming time_macro(const Assembly& assembly, std::size_t macro) {
  MacroTiming timing;
  timing.commands.resize(assembly.macros[macro].commands.size());
  const auto result = walk(assembly, macro, longest_walk, [&](const Visit& visit) {
    if (visit.macro != macro)
      return;
    auto& command = timing.commands[visit.command];
    if (!command) {
      const auto wait =
          wait_of(assembly.macros[macro].commands[visit.command], visit.sd1_ms, visit.sd2_ms);
      command = CommandTiming{visit.latest_ms, wait.least_ms, wait.most_ms, 0};
    }
    ++command->times;
  });
  timing.least_ms = result.earliest_ms;
  timing.most_ms = result.latest_ms;
  timing.note = note_of(result);
  return timing;
}

std::string print_time(std::int64_t ms) {
  return ms < whole ? fmt::format("{} ms", ms) : thousandths_text(ms) + " s";
}

std::string to_string(const MacroTiming& timing) {
  const auto time =
      timing.least_ms == timing.most_ms
          ? print_time(timing.most_ms)
          : fmt::format("{} to {}", print_time(timing.least_ms), print_time(timing.most_ms));
  switch (timing.note) {
  case TimingNote::Exact: return time;
  case TimingNote::UntilStopped: return time + ", depending on when the ball stops";
  case TimingNote::Endless: return "endless";
  case TimingNote::Leaves: return time + ", then another macro";
  case TimingNote::Calls: return time + ", plus the macros in other files that it calls";
  case TimingNote::SystemLoops: return time + ", with each system loop run once";
  case TimingNote::Sleeps: return time + ", then the ball sleeps";
  case TimingNote::Broken: return time + ", then bytes that are not a command";
  case TimingNote::TooLong: return "more than " + time;
  }
  return time;
}

} // namespace orb::assembler
