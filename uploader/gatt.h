#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "uploader/ble_error.h"
#include "uploader/endpoint.h"

namespace orb::uploader {

inline constexpr std::string_view held_by_another =
    "another program is subscribed to the robot's answers";

/// A limit for a wait.
struct Patience {
  Instant deadline;
  StopRequests stop; ///< polled while waiting

  bool stopped() const { return stop && stop() > 0; }
};

/// A robot as a computer's Bluetooth LE shows it. All waits end within stop_notice of their
/// patience.
class Gatt {
public:
  virtual ~Gatt() = default;

  virtual Instant now() const = 0;

  /// Takes one of the steps from Bus to Services. Returns what was found, in words.
  virtual tl::expected<std::string, BleError> go(protocol::BleStep step,
                                                 const Patience& patience) = 0;

  /// Returns true if the robot has the characteristic; known after the step Services.
  virtual bool has(spec::BleCharacteristic characteristic) const = 0;

  /// Returns true if another program is subscribed to these answers; known after the step Services.
  virtual bool held(spec::BleCharacteristic answers) const = 0;

  /// The robot's address, for remedies; empty while unknown.
  virtual std::string address() const = 0;

  /// The advertised name; empty if unknown.
  virtual std::string name() const = 0;

  /// Ends the link to the robot if this object made it, so that the next step Connect makes a new
  /// one.
  virtual void let_go() = 0;

  /// Writes at most spec::ble_piece_bytes and waits for the acknowledgement. A piece that fails may
  /// have arrived.
  virtual tl::expected<void, BleError> write(spec::BleCharacteristic characteristic, ByteView bytes,
                                             const Patience& patience) = 0;

  /// Makes read() return what the robot sends there.
  virtual tl::expected<void, BleError> subscribe(spec::BleCharacteristic answers,
                                                 const Patience& patience) = 0;

  /// Waits until the deadline or a request to stop.
  virtual void rest(const Patience& patience) = 0;

  /// Returns notified bytes as soon as there are any; empty if `deadline` passes first.
  virtual tl::expected<Bytes, BleError> read(Instant deadline) = 0;
};

} // namespace orb::uploader
