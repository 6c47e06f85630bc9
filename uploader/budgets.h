#pragma once

#include "base/time.h"

#include <cstdint>

namespace orb::uploader {

/// How long a request to stop may go unnoticed while a link is waited for.
constexpr Duration stop_notice = 50ms;

/// Every wait and every repetition of an upload. Nothing waits without one of these, so their sum
/// is the deadline that a plan states. Source: UPLOAD where no reason is given.
struct Budgets {
  /// For one answer. The slowest ones seen come from erasing flash, well below a second.
  Duration answer = 2s;
  /// For bytes that were on their way before we came.
  Duration drain = 200ms;
  /// For a connection to come about; a Bluetooth page takes up to 5.12 s.
  Duration connect = 6s;
  /// How often a link is tried to be opened.
  int opens = 3;
  /// How often a command is sent that does no harm twice. At 10 % loss each way six of them all
  /// fail once in 20 000 times.
  int sends = 6;
  /// How often a packet that the ball reports as damaged is sent again.
  int resends = 3;
  /// How often a whole program is sent.
  int attempts = 12;
  /// Between repetitions, doubling from the first to the most.
  Duration backoff_first = 100ms;
  Duration backoff_most = 2s;
  /// For the last messages of what was stopped; the ball's may be 20 ms after its answers.
  Duration settle = 50ms;
  /// For a sign of life of a program whose start was not answered.
  Duration start_sign = 1s;
  /// Between two offers of a chunk to a stream macro whose buffer is full.
  Duration stream_pause = 50ms;
  /// For room in the buffer of a stream macro. One command can play for 65 s.
  Duration stream_room = 120s;

  /// The wait before repetition `n`, counted from 1.
  constexpr Duration backoff(int n) const {
    auto wait = backoff_first;
    for (int i = 1; i < n && wait < backoff_most; ++i)
      wait *= 2;
    return wait < backoff_most ? wait : backoff_most;
  }
  /// The sum of the waits between `times` repetitions.
  constexpr Duration backoffs(int times) const {
    Duration sum{};
    for (int n = 1; n < times; ++n)
      sum += backoff(n);
    return sum;
  }
  /// The longest that a command can take which is sent until it is answered.
  constexpr Duration ask() const { return sends * answer + backoffs(sends); }
};

} // namespace orb::uploader
