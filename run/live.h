#pragma once

#include "report/journey.h"
#include "run/run.h"

#include <cstdint>
#include <memory>
#include <span>
#include <tl/expected.hpp>

namespace orb::run {

/// A run that is handed its time bit by bit, while the world, or a person, does things to the ball.
/// run() is one of these that goes on to its end.
class Live {
public:
  /// Brings everything into a ball and starts it. All that is handed in outlives the run.
  static tl::expected<std::unique_ptr<Live>, Failure> start(std::span<const Input> inputs,
                                                            const Options& options,
                                                            Listener& listener,
                                                            report::Journey* journey);
  ~Live();

  /// Goes on to robot time `t` since the start, or less far; false: the run is over.
  bool advance(Duration t, vm::Ball::Halt halt = vm::Ball::Halt::Look);
  /// Time passes to `t` though the run may be over: while the program waits for a number.
  void wait(Duration t, vm::Ball::Halt halt = vm::Ball::Halt::Look);
  /// From now on a program that waits for a number is not over: give() may bring it.
  void keep_waiting();
  /// From now on it is over.
  void stop();

  void give(std::int32_t number); ///< for `input`
  void apply(const vm::Stimulus& stimulus);

  /// Other balls of its room press on it or have run into it, at time().
  void meet(const vm::Shove& shove, std::span<const std::string> names);
  /// As vm::Ball has them; times since the start.
  bool coast(Duration t);
  Duration next_push() const;
  /// It has printed what was looked for.
  bool over_early() const;

  /// What the robot elsewhere says, at time().
  void feel(const vm::Sample& sample);
  void feel(const vm::event::Collision& collision);

  Duration time() const; ///< since the start
  /// When something happens next by itself, since the start; the greatest duration for never.
  Duration next_event() const;
  const vm::Ball& ball() const;
  bool waits_for_number() const;
  /// Nothing runs any more, and the ball still rolls.
  bool rolls_out() const;
  /// How it would end now.
  Ending so_far() const;

  /// How it ended; nothing can be done with the run after that.
  tl::expected<Ending, Failure> finish();

private:
  struct State;
  explicit Live(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

} // namespace orb::run
