#pragma once

#include "compiler/load.h"
#include "vm/machine/machine.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orb::vm {

/// A host that records statements; system variables are a map.
class NotebookHost final : public Host {
public:
  std::int32_t read(spec::Variable variable, Instant) override {
    const std::int32_t value = values[variable];
    if (spec::info(variable).access == spec::Access::ReadClears)
      values[variable] = 0;
    return value;
  }
  std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                        Instant) override {
    values[variable] = value;
    return std::nullopt;
  }
  std::optional<spec::BasicError> perform(spec::Statement statement,
                                          std::span<const std::int32_t> arguments,
                                          Instant now) override {
    std::string note{spec::info(statement).word};
    for (std::size_t i = 0; i < arguments.size(); ++i)
      note += (i == 0 ? " " : ",") + std::to_string(arguments[i]);
    notes.push_back(note);
    times.push_back(now);
    return std::nullopt;
  }
  std::optional<Instant> print(std::string_view text, Instant now) override {
    if (now < queue_full_until)
      return queue_full_until;
    printed += text;
    print_times.push_back(now);
    return std::nullopt;
  }
  void line_ended(int line, Instant) override { lines.push_back(line); }

  std::map<spec::Variable, std::int32_t> values;
  std::vector<std::string> notes;
  std::vector<Instant> times;
  std::string printed;
  std::vector<Instant> print_times;
  std::vector<int> lines;
  Instant queue_full_until{};
};

/// The result of a program.
struct BasicRun {
  std::string printed;
  std::vector<std::string> notes;
  std::string end; ///< `end`, or the error in the robot's words, or `running`
  std::uint64_t lines = 0;
  Instant at{};
};

/// Runs a program from its first line for at most `time`; `input` gets no answer.
inline BasicRun run_basic(std::string_view text, Duration time = 10s, int line = -1,
                          Dispatch dispatch = Dispatch::Threaded, std::uint32_t speed = 3000) {
  NotebookHost host;
  Machine machine(speed, 1, dispatch);
  auto chunk = compiler::load(text);
  if (line < 0)
    line = chunk.lines.empty() ? 0 : chunk.lines.front().number;
  machine.start(std::move(chunk), line, Instant{});
  const Instant limit = Instant{} + time;
  while (machine.running() && machine.next_event() < limit)
    machine.run(limit, host);
  BasicRun run;
  run.printed = host.printed;
  run.notes = host.notes;
  run.lines = machine.lines();
  run.at = machine.now();
  if (const auto stop = machine.take_termination())
    run.end = stop->error ? "Line " + std::to_string(stop->line) + ": " +
                                std::string(spec::info(*stop->error).text)
                          : "end";
  else
    run.end = "running";
  return run;
}

} // namespace orb::vm
