#pragma once

#include "base/time.h"
#include "vm/observer.h"

#include <cstdint>
#include <functional>
#include <map>
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

/// The same for an event of a ball; empty for the end of a program or a macro, which is
/// not the end of a run.
std::string trace_line(TraceFormat format, Duration t, const vm::Event& event);

/// The first line of the CSV form: the columns. Empty for JSON.
std::string trace_head(TraceFormat format);

/// Where lines of the robot stand in a source without numbers: `patrol.orb:12:3` by line. Empty
/// where the source has numbers itself.
using LinePlaces = std::map<int, std::string>;

/// A trace that is one of several: of a ball of a room. Its lines name the ball.
struct TraceOf {
  std::string ball;     ///< empty: of one ball alone, and then the trace has its own head
  bool sources = false; ///< the program of some ball of the room has places: CSV has their column
};

/// The first line of the CSV form for the balls of a room. Empty for JSON.
std::string room_trace_head(TraceFormat format, bool sources);

/// Which events a trace has.
enum class TraceLines : std::uint8_t { Leave, Keep };

/// Writes the trace of one run, a line an event.
class TraceWriter {
public:
  TraceWriter(TraceFormat format, TraceLines lines, std::function<void(std::string_view)> put,
              LinePlaces places = {}, TraceOf of = {});
  void add(Duration t, const vm::Event& event);
  /// An event of which more is known than the ball says.
  void add(Duration t, std::string_view event, const std::vector<TraceField>& fields);
  void finish(Duration t, std::string_view reason, std::uint64_t lines);

private:
  std::string with_source(std::string line, const std::string& source) const;
  void tell(std::string line, const std::string& source, const std::string& other = {});

  TraceFormat format_;
  TraceLines lines_; ///< a report needs every line even where the trace leaves them out
  std::function<void(std::string_view)> put_;
  LinePlaces places_;
  TraceOf of_;
};

} // namespace orb::report
