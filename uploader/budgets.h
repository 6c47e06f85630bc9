#pragma once

#include "base/time.h"

#include <cstdint>

namespace orb::uploader {

/// The longest delay before a wait on a link notices a request to stop.
constexpr Duration stop_notice = 50ms;

/// All time-outs and repetition counts of an upload. Every wait uses one of them, so that their sum
/// is the deadline stated by a plan. Source: UPLOAD unless a reason is given. Large because the
/// deadline is computed from all of them.
struct Budgets {
  /// For one answer. The slowest known ones come from erasing flash, well below a second.
  Duration answer = 2s;
  /// For bytes sent before the session began.
  Duration drain = 200ms;
  /// For connecting; a Bluetooth page takes up to 5.12 s.
  Duration connect = 6s;
  /// Attempts to open a link.
  int opens = 3;
  /// For a write, after which the link counts as broken: the longest packet needs 25 ms.
  Duration write = 5s;
  /// For an answer of bluetoothd, and for the robot's acknowledgement of a greeting word over LE.
  Duration ble_answer = 3s;
  /// For finding a robot over LE; it advertises several times a second, to a radio that listens
  /// part of the time.
  Duration scan = 10s;
  /// For connecting over LE; the kernel's own limit is 20 s, and there are three attempts.
  Duration ble_connect = 10s;
  /// For discovering a robot's characteristics.
  Duration services = 10s;
  /// For all pieces of a packet over LE: the longest has 13, and an interval lasts at most 100 ms.
  Duration ble_send = 5s;
  /// Time of a piece and its acknowledgement over LE, about two intervals of 15 to 50 ms [?].
  Duration receipt = 60ms;
  /// Time of a packet and its answer over classic Bluetooth [?]; used only for estimates.
  Duration round_trip = 40ms;
  /// Most bytes that the link takes at once; 0: any number.
  std::size_t piece = 0;
  /// For passing a packet to the link; zero if a link takes it at once.
  Duration send{};
  /// Attempts for a command that is harmless to repeat. At 10 % loss each way all six fail once in
  /// 20 000 times.
  int sends = 6;
  /// Repetitions of a packet that the ball reports as damaged.
  int resends = 3;
  /// Attempts for a whole program.
  int attempts = 12;
  /// Between repetitions, doubling from the first to the most.
  Duration backoff_first = 100ms;
  Duration backoff_most = 2s;
  /// For the last messages of what was stopped; the ball may send them 20 ms after its answers.
  Duration settle = 50ms;
  /// For a sign of life of a started program: a print or an error.
  Duration start_sign = 1s;
  /// For an error right after its first print: over LE two messages take several acknowledgements.
  Duration start_error = 200ms;
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
  /// The sum of the waits between `times` attempts.
  constexpr Duration backoffs(int times) const {
    Duration sum{};
    for (int n = 1; n < times; ++n)
      sum += backoff(n);
    return sum;
  }
  /// The longest time for a command that is repeated until answered.
  constexpr Duration ask() const { return sends * (send + answer) + backoffs(sends); }
  /// The longest time for opening a link.
  constexpr Duration open() const {
    const auto once = piece == 0 ? connect : ble_connect + services + 4 * ble_answer;
    const auto before = piece == 0 ? Duration{} : 2 * ble_answer + scan;
    return before + opens * once + backoffs(opens);
  }
  /// The number of pieces of a packet on this link.
  constexpr std::size_t pieces(std::size_t packet) const {
    return piece == 0 ? 1 : (packet + piece - 1) / piece;
  }
};

} // namespace orb::uploader
