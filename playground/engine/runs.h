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

/// What a page wants to know of a run besides how it ends.
struct Wanted {
  std::optional<report::TraceFormat> trace;
  bool report = false;
};

/// A run with all that it needs, and what it has come to. A page's live run is moved on bit by bit.
class Run final : run::Listener {
public:
  /// With a `robot`, which may be null, that is its body; `first` is what it said before.
  static tl::expected<std::unique_ptr<Run>, Problem> start(Request& request, const Wanted& wanted,
                                                           vm::Elsewhere* robot = nullptr,
                                                           const vm::Sample& first = {});

  /// Goes on to its end.
  void finish();
  /// Goes on to robot time `t`; false once it is over. While it waits for a number it goes on. A
  /// ball that still drives when nothing runs any more is watched for some seconds.
  bool advance(Duration t);
  /// Ends it where it has not come to its end by itself.
  void stop();
  /// Whoever runs it may give() numbers while it waits for them.
  void keep_waiting() {
    live_->keep_waiting();
    may_wait_ = true;
  }
  void give(std::int32_t number) { live_->give(number); }
  /// A line of a stimulus script without its time.
  tl::expected<void, Problem> apply(const std::string& line);

  /// The run itself, and who hears of it, for a robot that drives it.
  run::Live& live() { return *live_; }
  run::Listener& listener() { return *this; }

  std::string hint() const;
  /// What happened since the last frame.
  std::string frame();
  /// What a player shows of the run so far.
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
  std::vector<run::ProgramError> faults_; ///< that no frame has told
  report::Shown shown_;                   ///< by the frames
  std::optional<Duration> rolls_since_;   ///< nothing runs any more
  std::string trace_text_;
  bool over_ = false;
  bool may_wait_ = false;       ///< somebody may give() numbers
  std::size_t told_prints_ = 0; ///< by the last frame
};

} // namespace orb::playground
