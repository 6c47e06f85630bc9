#pragma once

#include "debug/launch.h"
#include "playground/engine/request.h"
#include "report/journey.h"
#include "report/page.h"
#include "run/live.h"
#include "run/trace.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::playground {

/// What a page wants to know about a run besides its end.
struct Wanted {
  std::optional<report::TraceFormat> trace = {};
  bool report = false;
};

/// A run with everything it needs, and its results. The page advances its live run step by step.
/// Large because it keeps all parts and results of a run until the page asks for them.
class Run final : run::Listener {
public:
  /// With a `robot` (may be null), that is its body; `first` is what it has sent before.
  static tl::expected<std::unique_ptr<Run>, Problem> start(Request& request, const Wanted& wanted,
                                                           vm::RemoteBody* robot = nullptr,
                                                           const vm::Sample& first = {});

  /// Runs to the end.
  void finish();
  /// Runs to robot time `t`; returns false once it is over. Time passes while it waits for a
  /// number. A ball that still drives after the end is watched for some seconds.
  bool advance(Duration t);
  /// Ends the run if it has not ended yet.
  void stop();
  /// Lets the caller give() numbers while the run waits for them.
  void keep_waiting() {
    live_->keep_waiting();
    may_wait_ = true;
  }
  void give(std::int32_t number) { live_->give(number); }
  /// Applies a line of a stimulus script without its time.
  tl::expected<void, Problem> apply(const std::string& line);

  /// The run itself and its listener, for a robot that drives it.
  run::Live& live() { return *live_; }
  run::Listener& listener() { return *this; }

  std::string hint() const;
  /// What happened since the last frame.
  std::string frame();
  /// The player's data for the run so far.
  std::string report_so_far() const;
  /// The answer to `run`.
  Answer answer();

private:
  Run() = default;
  void on_event(Duration t, const vm::Event& event) override;
  void on_fault(Duration t, const run::ProgramError& fault) override;
  bool has_more_numbers() const override { return may_wait_; }
  std::string report_of(const report::Journey& journey) const;

  std::string title_;
  Say say_;
  std::unique_ptr<debug::Launched> launched_;
  Wanted wanted_;
  std::optional<report::Journey> journey_;
  std::optional<run::Trace> trace_;
  std::unique_ptr<run::Live> live_;
  std::string prints_;
  std::vector<run::ProgramError> faults_; ///< not in any frame yet
  report::Shown shown_;                   ///< in the frames
  std::optional<Duration> rolls_since_;   ///< since when it rolls on after the end
  std::string trace_text_;
  bool over_ = false;
  bool may_wait_ = false;       ///< the caller may give() numbers
  std::size_t told_prints_ = 0; ///< in the last frame
};

} // namespace orb::playground
