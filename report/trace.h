#pragma once

#include "base/time.h"
#include "vm/observer.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace orb::report {

enum class TraceFormat : std::uint8_t { Json, Csv };

/// One value of an event, under its key of the trace.
struct TraceField {
  std::string_view key;
  std::variant<std::int64_t, double, std::string> value;
};

/// One line of a trace: `{"t":ms,"event":"print",…}`, or a row of the CSV form. docs/ball.md lists
/// the events and their keys.
std::string trace_line(TraceFormat format, Duration t, std::string_view event,
                       const std::vector<TraceField>& fields);

/// The same for an event of a ball; empty for vm::event::End, which is not the end of a run.
std::string trace_line(TraceFormat format, Duration t, const vm::Event& event);

/// The first line of the CSV form: the columns. Empty for JSON.
std::string trace_head(TraceFormat format);

} // namespace orb::report
