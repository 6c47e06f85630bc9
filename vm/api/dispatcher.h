#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "protocol/decoder.h"
#include "protocol/payload.h"
#include "spec/api.h"
#include "spec/firmware.h"
#include "vm/api/api_host.h"
#include "vm/api/profile.h"
#include "vm/api/self_level.h"

#include <cstdint>
#include <string>

namespace orb::vm {

/// The API: extracts packets from a client's bytes, obeys them through its host and answers.
/// spec/api.def says which operands a command takes and which commands are refused. Large because
/// it holds the state that only the API has: counters, profile, notifications, self levelling.
class Dispatcher {
public:
  Dispatcher(ApiHost& host, std::uint64_t seed, spec::Firmware firmware);
  /// Copies the state and serves another ball.
  Dispatcher(const Dispatcher& other, ApiHost& host) : Dispatcher(other) { host_ = &host; }

  /// Takes bytes from the client, at the host's present instant.
  void receive(ByteView bytes);
  /// Timed work: incomplete packets that time out, power notifications, self levelling, soul-block
  /// messages.
  Instant next_event() const;
  void run(Instant now);

  // Notifications from the ball.
  void on_disconnect();
  void on_sleep();
  void on_wake();
  /// The state of the battery changed: sends a power notification.
  void on_battery();
  /// A collision was reported: damages the shield.
  void on_collision();
  /// The ball began to move: starts earning experience and watching gyro limits.
  void on_motion();

  /// Returns the profile with its lifetime counters up to date.
  const Profile& profile();
  void restore(const Profile& profile) { profile_ = profile; }
  /// Grows with every command that changes state kept across power cycles.
  std::uint64_t revision() const { return revision_; }

private:
  Dispatcher(const Dispatcher&) = default;

  struct Reply {
    spec::ResponseCode code = spec::ResponseCode::Ok;
    Bytes data;
  };
  /// A command whose operands have been validated.
  struct Call {
    const protocol::Operands& operands;
    spec::ApiCommand command;

    /// Answers OK with the fields of the command's response.
    Reply answer(std::initializer_list<protocol::FieldContent> contents) const {
      return {spec::ResponseCode::Ok,
              protocol::write_fields(spec::answer(command), {contents.begin(), contents.size()})};
    }
  };

  // Source: API §Perform Level 2 Diagnostics.
  struct Counters {
    std::uint32_t good = 0;
    std::uint32_t bad_did = 0;
    std::uint32_t bad_dlen = 0;
    std::uint32_t bad_cid = 0;
    std::uint32_t bad_checksum = 0;
    std::uint32_t overruns = 0;
  };

  void take_items();
  void answer(const protocol::Item& item, const Reply& reply);
  Reply obey(const protocol::Item& item);

  /// Executes one command. Each implemented row of spec/api.def needs a specialisation
  /// (vm/api/dispatch_*.cpp); the table of handlers does not link without it.
  template <spec::ApiCommand command>
  Reply handle(Call call);
  using Handler = Reply (Dispatcher::*)(Call call);
  struct Handlers;

  std::string level_1();
  /// The answer to Get Versioning. The bootloader reports only itself.
  Bytes version_record() const;
  /// Starts or ends the boost macro.
  void boost(Switch state);
  void tick_soul();
  void check_gyro();
  void watch_gyro();
  void level(const SelfLevel::Request& request);
  void finish_levelling(std::uint8_t result);
  void send_power_state();
  void bring_up_to_date();
  void persist() { ++revision_; }

  ApiHost* host_;
  std::uint64_t seed_;
  const spec::FirmwareInfo& firmware_;
  protocol::Decoder decoder_{protocol::Direction::ToBall};
  Instant last_byte_{};
  Counters counters_;
  Profile profile_;
  std::uint64_t revision_ = 0;

  // Lost in sleep.
  bool in_bootloader_ = false;
  std::uint8_t device_mode_ = spec::device_mode::normal;
  std::uint8_t accelerometer_range_ = spec::accelerometer_range::g8;
  Instant power_notice_at_ = never;
  bool soul_messages_ = false;
  Instant soul_tick_at_ = never;
  Instant consumable_until_{};
  SelfLevel self_level_;
  Instant gyro_check_at_ = never;
  std::uint8_t gyro_exceeded_ = 0;
  int speed_before_boost_ = 0;

  Instant counted_until_{}; ///< the lifetime counters are up to date to here
  bool was_charging_ = false;
};

} // namespace orb::vm
