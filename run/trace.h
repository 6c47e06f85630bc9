#pragma once

#include "report/trace.h"
#include "run/run.h"

#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace orb::run {

/// Writes the trace of a run, with source places and explanations of faults.
class Trace {
public:
  Trace(report::TraceFormat format, report::TraceLines lines, std::span<const Input> inputs,
        std::function<void(std::string_view)> put, report::TraceOf of = {});
  void add(Duration t, const vm::Event& event) { writer_.add(t, event); }
  void add(Duration t, const ProgramError& fault);
  void finish(const Ending& ending);

private:
  report::TraceWriter writer_;
};

} // namespace orb::run
