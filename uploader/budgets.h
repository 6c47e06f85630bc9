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
  /// For a link to take bytes; then it is broken: the longest packet needs 25 ms.
  Duration write = 5s;
  /// For bluetoothd to answer, and for a robot to acknowledge a word of the greeting over LE.
  Duration ble_answer = 3s;
  /// For a robot to be seen over LE; it shows itself several times a second, to a radio that
  /// listens part of the time.
  Duration scan = 10s;
  /// For a connection over LE; the kernel's own limit is 20 s, and there are three tries.
  Duration ble_connect = 10s;
  /// For the characteristics of a robot to be known.
  Duration services = 10s;
  /// For all pieces of a packet over LE: the longest has 13, and an interval lasts at most 100 ms.
  Duration ble_send = 5s;
  /// What a piece and its receipt take over LE, about two intervals of 15 to 50 ms [?].
  Duration receipt = 60ms;
  /// What a packet and its answer take over classic Bluetooth [?]; for an estimate only.
  Duration round_trip = 40ms;
  /// The most bytes that the link takes at once; 0 where it takes any number.
  std::size_t piece = 0;
  /// For a packet to be handed to the link; none where a link takes it at once.
  Duration send{};
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
  /// For a sign of life of a program that was started: a print or an error.
  Duration start_sign = 1s;
  /// For an error right behind its first print: over LE two messages take several receipts.
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
  /// The sum of the waits between `times` repetitions.
  constexpr Duration backoffs(int times) const {
    Duration sum{};
    for (int n = 1; n < times; ++n)
      sum += backoff(n);
    return sum;
  }
  /// The longest that a command can take which is sent until it is answered.
  constexpr Duration ask() const { return sends * (send + answer) + backoffs(sends); }
  /// The longest that it takes to open a link.
  constexpr Duration open() const {
    const auto once = piece == 0 ? connect : ble_connect + services + 4 * ble_answer;
    const auto before = piece == 0 ? Duration{} : 2 * ble_answer + scan;
    return before + opens * once + backoffs(opens);
  }
  /// How many pieces the link makes of a packet.
  constexpr std::size_t pieces(std::size_t packet) const {
    return piece == 0 ? 1 : (packet + piece - 1) / piece;
  }
};

} // namespace orb::uploader
