#include "vm/api/dispatch.h"

#include <algorithm>
#include <utility>

namespace orb::vm {
namespace {

using protocol::Item;
using spec::ApiCommand;
using spec::ResponseCode;

using namespace spec::ball;

/// The code with which the ball refuses a command that it knows but does not implement (UPLOAD
/// quirk).
ResponseCode refusal(spec::Status status) {
  switch (status) {
  case spec::Status::Implemented: return ResponseCode::Ok;
  case spec::Status::Factory:
  case spec::Status::Unsupported: return ResponseCode::Unsupported;
  case spec::Status::Password: return ResponseCode::BadPassword;
  case spec::Status::Bootloader: return ResponseCode::BadDevice;
  }
  return ResponseCode::General;
}

} // namespace

/// Handlers in the order of spec::api_commands; null for commands that are refused.
struct Dispatcher::Handlers {
  template <ApiCommand command, spec::Status status>
  static constexpr Handler of() {
    if constexpr (status == spec::Status::Implemented)
      return &Dispatcher::handle<command>;
    else
      return nullptr;
  }
  static Handler find(const spec::CommandInfo& row) {
    static constexpr Handler table[] = {
#define COMMAND(enumerator, did, cid, name, status, ...)                                           \
  of<ApiCommand::enumerator, spec::Status::status>(),
#include "spec/api.def"
    };
    return table[&row - spec::api_commands.data()];
  }
};

Dispatcher::Dispatcher(ApiHost& host, std::uint64_t seed, spec::Firmware firmware)
    : host_(&host), seed_(seed), firmware_(spec::info(firmware)) {
  profile_.cold_boots = 1;
  in_bootloader_ = !firmware_.has_firmware();
}

void Dispatcher::receive(ByteView bytes) {
  if (bytes.empty())
    return;
  last_byte_ = host_->now();
  decoder_.feed(bytes);
  take_items();
}

void Dispatcher::take_items() {
  while (const auto item = decoder_.next()) {
    switch (item->kind) {
    case Item::Kind::Command: {
      // The answer must leave before any message the command causes.
      host_->link().hold_messages();
      answer(*item, obey(*item));
      host_->command_done();
      host_->link().release_messages(host_->now());
      if (host_->power().falls_asleep()) {
        decoder_.reset();
        return;
      }
      break;
    }
    case Item::Kind::BadChecksum:
      ++counters_.bad_checksum;
      answer(*item, {ResponseCode::BadChecksum, {}});
      break;
    case Item::Kind::Fragment: answer(*item, {ResponseCode::Fragment, {}}); break;
    case Item::Kind::Noise:
    case Item::Kind::Response:
    case Item::Kind::Async: break;
    }
  }
}

void Dispatcher::answer(const Item& item, const Reply& reply) {
  if ((item.flags & spec::sop2_answer) != 0)
    host_->link().send(
        protocol::Response{static_cast<std::uint8_t>(reply.code), item.seq, reply.data},
        host_->now());
}

Dispatcher::Reply Dispatcher::obey(const Item& item) {
  const auto resets = (item.flags & spec::sop2_reset_timeout) != 0;
  if (resets || !firmware_.has_option_bits())
    host_->stay_awake();

  const auto other_device = in_bootloader_ ? spec::did_bootloader : spec::did_sphero;
  if (item.did != spec::did_core && item.did != other_device) {
    ++counters_.bad_did;
    return {ResponseCode::BadDevice, {}};
  }
  const auto* row = spec::find_command(item.did, item.cid);
  if (row == nullptr || !firmware_.knows(*row)) {
    ++counters_.bad_cid;
    return {ResponseCode::BadCommand, {}};
  }
  const auto refused = refusal(row->status);
  if (refused == ResponseCode::Unsupported) {
    ++counters_.good;
    return {refused, {}};
  }
  const auto operands = protocol::Operands::read(row->command, item.data);
  if (!operands && operands.error().code == ResponseCode::BadMessage) {
    ++counters_.bad_dlen;
    return {ResponseCode::BadMessage, {}};
  }
  ++counters_.good;
  if (refused != ResponseCode::Ok)
    return {refused, {}};
  if (!operands)
    return {operands.error().code, {}};
  return (this->*Handlers::find(*row))({*operands, row->command});
}

// Timed work.

Instant Dispatcher::next_event() const {
  const auto fragment = decoder_.pending() ? last_byte_ + spec::fragment_timeout : never;
  return std::min(
      {fragment, power_notice_at_, self_level_.next_event(), soul_tick_at_, gyro_check_at_});
}

void Dispatcher::run(Instant now) {
  if (decoder_.pending() && now >= last_byte_ + spec::fragment_timeout) {
    decoder_.expire();
    take_items();
  }
  if (now >= power_notice_at_) {
    power_notice_at_ = now + power_notice_interval;
    send_power_state();
  }
  if (const auto result = self_level_.run(now, host_->body()))
    finish_levelling(*result);
  if (now >= soul_tick_at_)
    tick_soul();
  if (now >= gyro_check_at_)
    check_gyro();
}

void Dispatcher::send_power_state() {
  host_->send(
      protocol::make_async(spec::AsyncId::PowerNotification, {host_->power().battery_state()}));
}

void Dispatcher::on_battery() {
  bring_up_to_date();
  const auto charging = host_->power().battery_state() == spec::power_state::charging;
  if (was_charging_ && !charging) {
    ++profile_.charges;
    profile_.since_charge_s = 0;
  }
  was_charging_ = charging;
  if (power_notice_at_ != never)
    send_power_state();
}

void Dispatcher::on_collision() {
  if (!profile_.soul.damage_shield())
    return;
  if (soul_messages_)
    host_->send(protocol::make_async(spec::AsyncId::ShieldDamage, {profile_.soul.shield()}));
  soul_tick_at_ = std::min(soul_tick_at_, host_->now() + soul_tick);
}

void Dispatcher::on_motion() {
  soul_tick_at_ = std::min(soul_tick_at_, host_->now() + soul_tick);
  watch_gyro();
}

void Dispatcher::on_disconnect() {
  decoder_.reset();
  power_notice_at_ = never;
}

void Dispatcher::on_sleep() {
  bring_up_to_date();
  decoder_.reset();
  self_level_.stop();
  profile_.soul.stop_boost();
  in_bootloader_ = !firmware_.has_firmware();
  device_mode_ = spec::device_mode::normal;
  accelerometer_range_ = spec::accelerometer_range::g8;
  power_notice_at_ = soul_tick_at_ = gyro_check_at_ = never;
  consumable_until_ = {};
  soul_messages_ = false;
  gyro_exceeded_ = 0;
}

void Dispatcher::on_wake() {
  ++profile_.wake_ups;
  counted_until_ = host_->now();
  host_->link().set_clock_ms(
      0, host_->now()); // API §Assign Time Value: the clock starts at zero on wake-up
}

const Profile& Dispatcher::profile() {
  bring_up_to_date();
  return profile_;
}

/// Updates the lifetime counters. They are computed on demand, so that they need no events.
void Dispatcher::bring_up_to_date() {
  if (host_->power().asleep())
    return;
  const auto awake = std::chrono::floor<std::chrono::seconds>(host_->now() - counted_until_);
  counted_until_ += awake;
  profile_.awake_s += static_cast<std::uint64_t>(awake.count());
  profile_.since_charge_s += static_cast<std::uint64_t>(awake.count());
}

void Dispatcher::tick_soul() {
  auto& soul = profile_.soul;
  const auto was_boosting = soul.boosting();
  const auto moving = !host_->body().stopped();
  const auto changes = soul.tick(moving);
  if (was_boosting && !soul.boosting())
    boost(Switch::Off);
  soul_tick_at_ = moving || soul.changing() ? host_->now() + soul_tick : never;
  if (!soul_messages_)
    return;
  if (changes.level)
    host_->send(protocol::make_async(spec::AsyncId::LevelUp, {soul.level(), soul.points()}));
  if (changes.shield)
    host_->send(protocol::make_async(spec::AsyncId::ShieldDamage, {soul.shield()}));
  if (changes.experience)
    host_->send(protocol::make_async(spec::AsyncId::XpUpdate, {soul.experience()}));
  if (changes.boost)
    host_->send(protocol::make_async(spec::AsyncId::BoostUpdate, {soul.boost()}));
}

/// Checks for gyro limits only if the client asked for the messages and the ball can be turning.
void Dispatcher::watch_gyro() {
  const auto wanted = host_->settings().has(spec::permanent_option_flags::gyro_limit_messages);
  gyro_check_at_ = wanted && host_->body().moving() ? host_->now() : never;
}

void Dispatcher::check_gyro() {
  const auto rate = host_->body().rotation_deg_s();
  const std::pair<double, std::uint32_t> axes[] = {
      {rate.x, spec::gyro_axis_flags::x_positive}, {-rate.x, spec::gyro_axis_flags::x_negative},
      {rate.y, spec::gyro_axis_flags::y_positive}, {-rate.y, spec::gyro_axis_flags::y_negative},
      {rate.z, spec::gyro_axis_flags::z_positive}, {-rate.z, spec::gyro_axis_flags::z_negative}};
  std::uint8_t exceeded = 0;
  for (const auto& [value, bit] : axes)
    if (value > gyro_limit)
      exceeded = static_cast<std::uint8_t>(exceeded | bit);
  exceeded = static_cast<std::uint8_t>(exceeded & ~gyro_exceeded_);
  if (exceeded != 0) {
    // Report each axis once, until Set Heading clears the measurements.
    gyro_exceeded_ = static_cast<std::uint8_t>(gyro_exceeded_ | exceeded);
    host_->send(protocol::make_async(spec::AsyncId::GyroLimit, {exceeded}));
  }
  gyro_check_at_ = host_->body().moving() ? host_->now() + gyro_check_interval : never;
}

} // namespace orb::vm
