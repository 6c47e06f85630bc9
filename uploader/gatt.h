#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "uploader/ble_error.h"
#include "uploader/endpoint.h"

namespace orb::uploader {

inline constexpr std::string_view held_by_another =
    "another program is subscribed to the robot's answers";

/// How long something is waited for.
struct Patience {
  Instant deadline;
  Stop stop; ///< asked while it is waited

  bool stopped() const { return stop && stop() > 0; }
};

/// One robot as the Bluetooth LE of a computer shows it. It ends a wait within stop_notice of its
/// patience.
class Gatt {
public:
  virtual ~Gatt() = default;

  virtual Instant now() const = 0;

  /// Takes one of the steps from Bus to Services; what was found, in words.
  virtual tl::expected<std::string, BleError> go(protocol::BleStep step,
                                                 const Patience& patience) = 0;

  /// Whether the robot has it; known after the step Services.
  virtual bool has(spec::BleCharacteristic characteristic) const = 0;

  /// Whether another program has the answers that come there; known after the step Services.
  virtual bool held(spec::BleCharacteristic answers) const = 0;

  /// The robot's address, for what helps; empty where it is not known yet.
  virtual std::string address() const = 0;

  /// The name that it advertises; empty where it is not known.
  virtual std::string name() const = 0;

  /// Ends the link to the robot if it was made here, so that the next step Connect makes a new one.
  virtual void let_go() = 0;

  /// Writes at most spec::ble_piece_bytes and waits for the receipt. A piece that fails may have
  /// arrived.
  virtual tl::expected<void, BleError> write(spec::BleCharacteristic characteristic, ByteView bytes,
                                             const Patience& patience) = 0;

  /// From now on read() has what the robot sends there.
  virtual tl::expected<void, BleError> subscribe(spec::BleCharacteristic answers,
                                                 const Patience& patience) = 0;

  /// Lets time pass.
  virtual void rest(const Patience& patience) = 0;

  /// What has been notified of, as soon as there is a byte; nothing when `deadline` passes first.
  virtual tl::expected<Bytes, BleError> read(Instant deadline) = 0;
};

} // namespace orb::uploader
