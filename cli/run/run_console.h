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

/// What `--trace` and `--trace-out` ask for; nothing where there is to be no trace.
inline std::optional<report::TraceFormat> trace_format(std::string_view format,
                                                       std::string_view file) {
  if (format.empty() && file.empty())
    return std::nullopt;
  const bool csv = format == "csv" || (format.empty() && has_ending(file, ".csv"));
  return csv ? report::TraceFormat::Csv : report::TraceFormat::Json;
}

/// The command line of `orb run`.
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
  RosterOptions roster; ///< the robots; none for the virtual ball
  PortOptions port;     ///< of one of them
  std::string robot;
  std::string ball;   ///< the profile of how it drives; empty for the model's
  std::string record; ///< the file for a recording of the drive; empty for none
  std::string replay;
  bool keep_aim = false;
  bool firmware_given = false;
  bool disconnected = false;
  bool realtime = false;
  bool lenient = false;
  bool watch = false;
  bool sleeps = false; ///< the robot is put to sleep at the end
  bool open = false;
  bool together = false; ///< each file is a ball of one room
  run::Options run;

  std::optional<report::TraceFormat> format() const { return trace_format(trace, trace_out); }
};

inline constexpr std::string_view from_stdin = "@stdin";

/// Prints what the program prints, or its trace, and waits where the robot would take its time.
class Console final : public run::Listener {
public:
  Console(const RunOptions& options, const std::vector<run::Input>& inputs);

  void on_event(Duration t, const vm::Event& event) override;
  void on_fault(Duration t, const run::ProgramError& fault) override;
  void on_time(Duration t) override;
  /// Who types gets another try; what comes out of a file or a program is wrong for good. While a
  /// robot drives, only what is there already is taken.
  std::optional<std::int32_t> ask_number() override;
  bool has_more_numbers() const override;

  /// Between which speeds, other than 0, it was told to drive.
  struct Told {
    int slowest = spec::ball::greatest;
    int fastest = 0;
  };
  const Told& speeds() const { return speeds_; }

  /// What came instead of a number, for a message; empty for nothing.
  const std::string& no_number() const { return no_number_; }

  tl::expected<void, IoError> finish(const run::Ending& ending);

  /// Where a robot drives, it has to be stopped before the command ends for want of a reader:
  /// `on_lost` hears of that, once, and nothing more is printed.
  void outlive_output(std::function<void()> on_lost) { on_lost_ = std::move(on_lost); }
  /// What ended the output; nothing where it did not end.
  const std::optional<OutputError>& lost() const { return lost_; }

private:
  void print(std::string_view text);
  void put(std::string_view text);

  const RunOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<run::Trace> trace_;
  std::string no_number_;
  Told speeds_;
  std::function<void()> on_lost_;
  std::optional<OutputError> lost_;
  std::string text_; ///< of a trace that goes to a file, which appears whole at the end
};

} // namespace orb::cli
