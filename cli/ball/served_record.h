#pragma once

#include "base/io_error.h"
#include "cli/context/output_error.h"
#include "report/course.h"
#include "report/trace.h"
#include "serve/spectator.h"
#include "spec/robots.h"
#include "vm/stimulus.h"

#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// What to record of served balls.
struct RecordOptions {
  int count = 1;
  spec::Robot robot = spec::Robot::Sphero;
  std::optional<report::TraceFormat> trace;
  std::string trace_out;                     ///< empty: standard output
  std::string report;                        ///< empty for none
  std::optional<report::Course> course;      ///< the course that they drive through
  std::vector<vm::TimedStimulus> stimulus{}; ///< other stimuli for each ball; its walls are drawn
};

/// Traces served balls, and writes a report when serving ends.
class ServedRecord {
public:
  explicit ServedRecord(RecordOptions options);
  ~ServedRecord();

  /// Opens the trace file.
  tl::expected<void, IoError> open();
  serve::Spectator* watch(int index);
  /// Writes the report. Fails if the trace could not be written.
  tl::expected<void, IoError> finish();
  /// The error that ended standard output; nothing if it is still open.
  const std::optional<OutputError>& lost() const { return lost_; }

private:
  class Seat;
  void put(std::string_view text);

  RecordOptions options_;
  std::ofstream file_;
  std::optional<IoError> broken_;
  std::optional<OutputError> lost_;
  std::vector<std::unique_ptr<Seat>> seats_;
};

} // namespace orb::cli
