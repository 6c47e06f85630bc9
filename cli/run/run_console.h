#pragma once

#include "base/io_error.h"
#include "base/text/text.h"
#include "cli/context/output_error.h"
#include "cli/input/target.h"
#include "cli/many/roster.h"
#include "cli/robot/link.h"
#include "report/trace.h"
#include "run/run.h"
#include "run/trace.h"
#include "spec/firmware.h"
#include "spec/robots.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// The format that `--trace` and `--trace-out` ask for; nothing without a trace.
inline std::optional<report::TraceFormat> trace_format(std::string_view format,
                                                       std::string_view file) {
  if (format.empty() && file.empty())
    return std::nullopt;
  const bool csv = format == "csv" || (format.empty() && has_ending(file, ".csv"));
  return csv ? report::TraceFormat::Csv : report::TraceFormat::Json;
}

/// The options of `orb run`. Large because each option of the command line is a field.
struct RunOptions {
  std::vector<std::string> files;
  std::string language;
  std::string time = "60s";
  std::string input;
  std::string native = "auto";
  std::string firmware = std::string(spec::info(spec::default_firmware).name);
  std::vector<std::string> stimuli;
  std::string course;
  std::string trace;
  std::string trace_out;
  std::string report;
  std::string compare;
  std::string svg;
  TargetOptions target;
  RosterOptions roster; ///< the robots; none means the virtual ball
  PortOptions port;     ///< link options for one of them
  std::string robot;
  std::string ball;   ///< profile of how it drives; empty for the model's default
  std::string record; ///< file to record the drive in; empty for none
  std::string replay;
  bool keep_aim = false;
  bool firmware_given = false;
  bool disconnected = false;
  bool realtime = false;
  bool lenient = false;
  bool watch = false;
  bool sleeps = false; ///< puts the robot to sleep at the end
  bool open = false;
  bool together = false; ///< each file is one ball of a room
  run::Options run;

  std::optional<report::TraceFormat> format() const { return trace_format(trace, trace_out); }
};

inline constexpr std::string_view from_stdin = "@stdin";

/// Prints the output of the program or its trace, and waits where a robot would take time.
class Console final : public run::Listener {
public:
  Console(const RunOptions& options, const std::vector<run::Input>& inputs);

  void on_event(Duration t, const vm::Event& event) override;
  void on_fault(Duration t, const run::ProgramError& fault) override;
  void on_time(Duration t) override;
  /// A person may try again; a wrong number from a file or program is final. While a robot drives,
  /// takes only input that is already there.
  std::optional<std::int32_t> ask_number() override;
  bool has_more_numbers() const override;

  /// The lowest and highest speed it was told to drive, other than 0.
  struct SpeedRange {
    int slowest = spec::ball::greatest;
    int fastest = 0;
  };
  const SpeedRange& speeds() const { return speeds_; }

  /// The input that was not a number, for a message; empty if there was none.
  const std::string& no_number() const { return no_number_; }

  tl::expected<void, IoError> finish(const run::Ending& ending);

  /// Keeps the command running after the reader of its output has left, so that a driven robot can
  /// be stopped. Calls `on_lost` once; prints nothing more.
  void outlive_output(std::function<void()> on_lost) { on_lost_ = std::move(on_lost); }
  /// The error that ended the output; nothing if it did not end.
  const std::optional<OutputError>& lost() const { return lost_; }

private:
  void print(std::string_view text);
  void put(std::string_view text);

  const RunOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<run::Trace> trace_;
  std::string no_number_;
  SpeedRange speeds_;
  std::function<void()> on_lost_;
  std::optional<OutputError> lost_;
  std::string text_; ///< of a trace to a file, which is written at the end
};

} // namespace orb::cli
