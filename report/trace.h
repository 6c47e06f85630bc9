#pragma once

#include "base/time.h"
#include "vm/common/observer.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace orb::report {

enum class TraceFormat : std::uint8_t { Json, Csv };

/// A value of an event, with its key in the trace.
struct TraceField {
  std::string_view key;
  std::variant<std::int64_t, double, std::string> value;
};

/// Returns one line of a trace: `{"t":ms,"event":"print",…}`, or a row of CSV. docs/using/ball.md
/// lists the events and their keys.
std::string trace_line(TraceFormat format, Duration t, std::string_view event,
                       const std::vector<TraceField>& fields);

/// Returns the line for an event of a ball; empty for the end of a program or macro, which is not
/// the end of a run.
std::string trace_line(TraceFormat format, Duration t, const vm::Event& event);

/// Returns the CSV header. Empty for JSON.
std::string trace_head(TraceFormat format);

/// Source places by robot line, for example `patrol.orb:12:3`. Empty if the source itself has
/// numbers.
using LinePlaces = std::map<int, std::string>;

/// Identifies a trace that is one of several, for a ball of a room. Its lines name the ball.
struct TraceOf {
  std::string ball;     ///< empty: a single ball, whose trace has its own header
  bool sources = false; ///< CSV has a column of source places: some program has them
};

/// Returns the CSV header for the balls of a room, with or without the column of source places.
/// Empty for JSON.
std::string room_trace_head(TraceFormat format, bool sources = false);

/// Keep: the trace includes the event of every line.
enum class TraceLines : std::uint8_t { Leave, Keep };

/// Writes the trace of one run, one line per event.
class TraceWriter {
public:
  TraceWriter(TraceFormat format, TraceLines lines, std::function<void(std::string_view)> put,
              LinePlaces places = {}, TraceOf of = {});
  void add(Duration t, const vm::Event& event);
  /// Adds an event with more fields than the ball knows.
  void add(Duration t, std::string_view event, const std::vector<TraceField>& fields);
  void finish(Duration t, std::string_view reason, std::uint64_t lines);

private:
  std::string with_source(std::string line, const std::string& source) const;
  void tell(std::string line, const std::string& source, const std::string& other = {});

  TraceFormat format_;
  TraceLines lines_; ///< a report needs every line even if the trace leaves them out
  std::function<void(std::string_view)> put_;
  LinePlaces places_;
  TraceOf of_;
};

} // namespace orb::report
