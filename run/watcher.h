#pragma once

#include "run/live.h"
#include "run/named_values.h"
#include "run/start.h"
#include "run/want.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::run {

/// Finds a text in output that arrives in pieces.
class Search {
public:
  explicit Search(const std::string& text) : text_(text) {}

  bool seen() const { return seen_; }
  void take(std::string_view piece) {
    if (text_.empty() || seen_)
      return;
    window_ += piece;
    seen_ = window_.find(text_) != std::string::npos;
    if (window_.size() >= text_.size())
      window_.erase(0, window_.size() - text_.size() + 1);
  }

private:
  const std::string& text_;
  std::string window_;
  bool seen_ = false;
};

/// Observes a ball from the start of the program to its end and forwards its events. Large because
/// it collects, in one pass over the events, everything that the ending and the report say about a
/// run.
class Watcher final : public vm::Observer, public vm::StepObserver {
public:
  Watcher(const Load& load, const Options& options, Listener& listener, report::Journey* journey)
      : load_(load), target_(options.target), until_(options.until), among_(options.among),
        listener_(listener), journey_(journey), expected_(options.expect),
        forbidden_(options.fail_text) {}

  /// When the ball's events begin to belong to the run.
  enum class From : std::uint8_t {
    Now,
    FirstCommand, ///< for a macro that plays while it arrives
  };
  void begin(vm::Ball& ball, From from) {
    if (journey_ != nullptr && !load_.programs.empty())
      names_.emplace(*load_.programs.front().program, *journey_);
    ball_ = &ball;
    start_ = ball.now();
    from_ = from;
    if (among_ == Among::Others && journey_ != nullptr) // even a ball that never moves has a place
      journey_->add({}, vm::event::Position{ball.body().world_pose()});
  }

  void on_event(Instant at, const vm::Event& event) override {
    if (ball_ == nullptr || enough_)
      return;
    if (among_ == Among::Others && std::holds_alternative<vm::event::Position>(event))
      hear(at, vm::event::Position{ball_->body().world_pose()});
    else
      hear(at, event);
  }

  void on_step(Instant at, const vm::Body& body) override {
    if (ball_ == nullptr || from_ == From::FirstCommand)
      return;
    listener_.on_step(at - start_, body);
    stop_if_enough();
  }

  /// Returns true if the run ends although something still runs.
  bool is_over_early() const { return enough_ || seen() != Sought::Nothing; }
  void stop() { enough_ = true; }
  /// A number that the program waits for may still be given.
  void keep_waiting() { waits_on_ = true; }

  Instant start() const { return start_; }
  std::optional<Instant> over() const { return over_; } ///< when everything had finished
  Sought seen() const {
    return forbidden_.seen()  ? Sought::Forbidden
           : expected_.seen() ? Sought::Expected
                              : Sought::Nothing;
  }
  const std::vector<ProgramError>& faults() const { return faults_; }
  std::optional<vm::event::End::Reason> end() const { return end_; }
  const std::optional<vm::event::MacroEnd>& macro_end() const { return macro_end_; }
  std::uint64_t lines() const { return lines_; }
  std::uint64_t commands() const { return commands_; }
  /// What could be seen of the ball so far.
  Sight sight() const {
    Sight seen = sight_;
    const auto& body = ball_->body();
    seen.pose = among_ == Among::Others ? body.world_pose() : body.pose();
    seen.way_cm = body.rolled_cm();
    seen.motion = body.is_driven() ? Sight::Motion::Driven
                  : body.stopped() ? Sight::Motion::Still
                                   : Sight::Motion::Rolling;
    return seen;
  }

private:
  bool may_be_answered() const { return waits_on_ && ball_->machine().waits_for_input(); }

  void hear(Instant at, const vm::Event& event) {
    if (over_)
      return roll_out(at, event);
    if (from_ == From::FirstCommand) {
      if (!std::holds_alternative<vm::event::Macro>(event))
        return;
      start_ = at;
      from_ = From::Now;
    }
    // After the end only events that belong to the ending count.
    const bool was_idle = ball_->idle() && !may_be_answered();
    if (!take(event) && was_idle) {
      over_ = at;
      roll_out(at, event);
      return;
    }
    if (std::holds_alternative<vm::event::End>(event) && was_idle)
      over_ = at;
    tell(at - start_, event);
  }

  /// After the program's end only the effects of the ball's motion count.
  void roll_out(Instant at, const vm::Event& event) {
    if (until_ == Until::Rest && (std::holds_alternative<vm::event::Bump>(event) ||
                                  std::holds_alternative<vm::event::Position>(event)))
      tell(at - start_, event);
  }

  void stop_if_enough() {
    if (!listener_.enough())
      return;
    enough_ = true;
    ball_->interrupt();
  }

  void tell(Duration t, const vm::Event& event) {
    look(event);
    const auto* error = std::get_if<vm::event::Error>(&event);
    if (error == nullptr)
      listener_.on_event(t, event);
    else
      listener_.on_fault(t, add_fault(*error));
    stop_if_enough();
    if (journey_ == nullptr)
      return;
    journey_->add(t, event);
    if (const auto* line = std::get_if<vm::event::Line>(&event);
        line != nullptr && names_ && in_first_program())
      names_->line_ended(t, line->line, ball_->machine(), *journey_);
    if (error != nullptr)
      journey_->explain(faults_.back().cause.seen);
    journey_->sample(t, ball_->body());
  }

  /// Collects data for the ending. Returns true if the event counts even after the program.
  bool take(const vm::Event& event) {
    if (const auto* print = std::get_if<vm::event::Print>(&event)) {
      expected_.take(print->text);
      forbidden_.take(print->text);
      if (seen() != Sought::Nothing)
        ball_->interrupt();
      return true;
    }
    if (std::holds_alternative<vm::event::Error>(event))
      return true;
    if (const auto* end = std::get_if<vm::event::End>(&event)) {
      end_ = end->reason;
      lines_ += end->lines;
      return true;
    }
    if (const auto* end = std::get_if<vm::event::MacroEnd>(&event))
      macro_end_ = *end;
    return false;
  }

  /// Adds an error, explained by the source and by the machine, which is still in that state.
  const ProgramError& add_fault(const vm::event::Error& error) {
    return faults_.emplace_back(run::explain(*load_.programs[in_first_program() ? 0 : 1].input,
                                             error.line, error.code, &ball_->machine()));
  }

  bool in_first_program() const {
    return ball_->basic_area() == target_.area || load_.programs.size() < 2;
  }

  void look(const vm::Event& event) {
    if (std::holds_alternative<vm::event::Macro>(event))
      ++commands_;
    else if (const auto* drive = std::get_if<vm::event::Drive>(&event))
      sight_.told_to_move |= drive->roll.speed != 0;
    else if (const auto* place = std::get_if<vm::event::Position>(&event))
      sight_.turned |= place->pose.heading_deg != 0;
    else if (const auto* led = std::get_if<vm::event::Led>(&event);
             led != nullptr && !ball_->blinks())
      sight_.color = led->color;
    else if (const auto* bump = std::get_if<vm::event::Bump>(&event)) {
      if (!bump->ball.empty()) {
        sight_.met.insert(bump->ball);
        return;
      }
      ++sight_.bumps;
      if (std::find(sight_.walls.begin(), sight_.walls.end(), bump->wall) == sight_.walls.end())
        sight_.walls.push_back(bump->wall);
    }
  }

  vm::Ball* ball_ = nullptr;
  From from_ = From::Now;
  Instant start_{};
  const Load& load_;
  const compiler::Target& target_;
  Until until_;
  Among among_;
  bool enough_ = false;
  bool waits_on_ = false;
  Listener& listener_;
  report::Journey* journey_;
  std::optional<NamedValues> names_; ///< values for the journey, of the first program
  Search expected_;
  Search forbidden_;
  std::vector<ProgramError> faults_;
  std::optional<vm::event::End::Reason> end_;
  std::optional<vm::event::MacroEnd> macro_end_;
  std::uint64_t lines_ = 0;
  std::uint64_t commands_ = 0;
  std::optional<Instant> over_;
  Sight sight_;
};

} // namespace orb::run
