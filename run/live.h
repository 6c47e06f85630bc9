#pragma once

#include "report/journey.h"
#include "run/run.h"

#include <cstdint>
#include <memory>
#include <span>
#include <tl/expected.hpp>

namespace orb::run {

/// A run that the caller advances step by step, while the world or a person acts on the ball. run()
/// advances one to its end.
class Live {
public:
  /// Uploads everything into a ball and starts it. All arguments must outlive the run.
  static tl::expected<std::unique_ptr<Live>, Failure> start(std::span<const Input> inputs,
                                                            const Options& options,
                                                            Listener& listener,
                                                            report::Journey* journey);
  ~Live();

  /// Advances toward robot time `t` since the start, perhaps not all the way. Returns false if the
  /// run is over.
  bool advance(Duration t, vm::Ball::Halt halt = vm::Ball::Halt::Look);
  /// Lets time pass to `t` even if the run may be over: while the program waits for a number.
  void wait(Duration t, vm::Ball::Halt halt = vm::Ball::Halt::Look);
  /// A program that waits for a number no longer ends the run: give() may supply it.
  void keep_waiting();
  /// Ends the run.
  void stop();

  void give(std::int32_t number); ///< for `input`
  void apply(const vm::Stimulus& stimulus);

  /// Applies contact with other balls of the room, at time().
  void meet(const vm::Shove& shove, std::span<const std::string> names);
  /// As in vm::Ball; times count from the start.
  bool coast(Duration t);
  Duration next_push() const;
  /// Returns true if the sought text was printed, or the run was stopped.
  bool over_early() const;

  /// Takes news from the remote robot, at time().
  void feel(const vm::Sample& sample);
  void feel(const vm::event::Collision& collision);

  Duration time() const; ///< since the start
  /// The next event, since the start; Duration::max() if there is none.
  Duration next_event() const;
  const vm::Ball& ball() const;
  bool waits_for_number() const;
  /// Returns true if nothing runs any more but the ball still rolls.
  bool rolls_out() const;
  /// The ending if the run stopped now.
  Ending so_far() const;

  /// Ends the run and returns its ending. The run must not be used afterwards.
  tl::expected<Ending, Failure> finish();

private:
  struct Impl;
  explicit Live(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

} // namespace orb::run
