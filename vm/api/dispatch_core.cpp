// Device 00h: the core commands, which all of the vendor's robots share.

#include "spec/unit.h"
#include "vm/api/dispatch.h"
#include "vm/common/bluetooth.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace orb::vm {
namespace {

using spec::ResponseCode;
using namespace spec::ball;

constexpr std::string_view default_name = "Sphero-RGB";
constexpr std::uint8_t id_colors[] = {1, 2, 3};       // red, green, blue in LEDC's numbering [P]
constexpr std::string_view address_prefix = "6886E7"; // the vendor's block of Bluetooth addresses
constexpr auto version_hardware_at =
    spec::answer_offset(spec::ApiCommand::GetVersioning, "hardware");
constexpr auto version_bootloader_at =
    spec::answer_offset(spec::ApiCommand::GetVersioning, "bootloader");

// The bootloader's record, copied from a recording (REC).
constexpr std::size_t short_record = 8;
constexpr std::uint8_t short_record_version = 1;

std::uint16_t clamp_u16(std::uint64_t value) {
  return static_cast<std::uint16_t>(std::min<std::uint64_t>(value, UINT16_MAX));
}

std::string_view own_name(const Profile& profile) {
  return profile.name.empty() ? default_name : std::string_view(profile.name);
}

std::int64_t centivolts(const Body& body) {
  return std::lround(spec::scale_of("0.01 V").of(body.battery_v()));
}

} // namespace

/// Appends 24 bits of the seed to the vendor's prefix.
std::string bluetooth_address(std::uint64_t seed) {
  return fmt::format("{}{:06X}", address_prefix, seed % (1U << 24));
}

HANDLE(Ping) {
  return {};
}

HANDLE(GetVersioning) {
  return {ResponseCode::Ok, version_record()};
}

HANDLE(SetDeviceName) {
  const auto name = as_text(call.operands.data());
  profile_.name = clip_utf8(name.substr(0, name.find('\0')), name_size);
  persist();
  return {};
}

HANDLE(GetBluetoothInfo) {
  return call.answer({as_bytes(clip_utf8(own_name(profile_), reported_name_size)),
                      as_bytes(bluetooth_address(seed_)), 0, id_colors[0], id_colors[1],
                      id_colors[2]});
}

HANDLE(SetAutoReconnect) {
  profile_.auto_reconnect = call.operands.u8(0) != 0;
  profile_.auto_reconnect_s = call.operands.u8(1);
  persist();
  return {};
}

HANDLE(GetAutoReconnect) {
  return call.answer({profile_.auto_reconnect, profile_.auto_reconnect_s});
}

HANDLE(GetPowerState) {
  bring_up_to_date();
  return call.answer({power_record_version, host_->power().battery_state(),
                      centivolts(host_->body()), profile_.charges,
                      clamp_u16(profile_.since_charge_s)});
}

HANDLE(SetPowerNotification) {
  power_notice_at_ = call.operands.u8(0) == 0 ? never : host_->now() + power_notice_interval;
  return {};
}

HANDLE(Sleep) {
  if (call.operands.number(0) == deep_sleep)
    return {ResponseCode::Unsupported, {}};
  host_->sleep({static_cast<int>(call.operands.number(0)), call.operands.u8(1),
                static_cast<int>(call.operands.number(2))});
  return {};
}

HANDLE(GetVoltageTripPoints) {
  return call.answer({host_->settings().low_battery_cv, host_->settings().critical_battery_cv});
}

HANDLE(SetVoltageTripPoints) {
  auto settings = host_->settings();
  settings.low_battery_cv = static_cast<int>(call.operands.number(0));
  settings.critical_battery_cv = static_cast<int>(call.operands.number(1));
  host_->change(settings);
  persist();
  return {};
}

HANDLE(SetInactivityTimeout) {
  host_->set<Duration>(&Settings::inactivity_timeout,
                       std::chrono::seconds{call.operands.number(0)});
  persist();
  return {};
}

HANDLE(JumpToBootloader) {
  in_bootloader_ = true;
  host_->shut_down();
  return {};
}

HANDLE(LeaveBootloader) {
  if (!firmware_.has_firmware())
    return {ResponseCode::MainCorrupt, {}};
  in_bootloader_ = false;
  return {};
}

HANDLE(IsPageBlank) {
  const auto* pages = spec::find_flash_pages(firmware_.record()[spec::version_model_at]);
  if (pages == nullptr || !pages->has(call.operands.u8(0)))
    return {ResponseCode::PageIllegal, {}};
  return call.answer({firmware_.has_firmware() ? 0 : 1});
}

HANDLE(PerformLevel1Diagnostics) {
  const auto text = level_1();
  host_->send(protocol::make_async(spec::AsyncId::Level1Diagnostics, {as_bytes(text)}));
  return {};
}

HANDLE(PerformLevel2Diagnostics) {
  bring_up_to_date();
  Bytes boots;
  for (std::size_t i = 0; i < boot_counters; ++i)
    append_u16(boots, i == 0 ? profile_.cold_boots : i == wake_up_counter ? profile_.wake_ups : 0);
  return call.answer({level_2_record_version, 0, counters_.good, counters_.bad_did,
                      counters_.bad_dlen, counters_.bad_cid, counters_.bad_checksum,
                      counters_.overruns, host_->link().sent(), host_->link().dropped(),
                      boot_reason_cold, boots, 0, profile_.charges,
                      clamp_u16(profile_.since_charge_s), profile_.awake_s,
                      profile_.rolled_cm + host_->body().rolled_cm(), 0, 0});
}

HANDLE(ClearCounters) {
  if (device_mode_ == spec::device_mode::normal)
    return {ResponseCode::ExecuteFailed, {}};
  counters_ = {};
  host_->link().clear_counters();
  return {};
}

HANDLE(AssignTimeValue) {
  host_->link().set_clock_ms(static_cast<std::uint32_t>(call.operands.number(0)), host_->now());
  return {};
}

HANDLE(PollPacketTimes) {
  // The model receives and answers within the same millisecond.
  const auto clock = host_->link().clock_ms(host_->now());
  return call.answer({call.operands.number(0), clock, clock});
}

Bytes Dispatcher::version_record() const {
  const auto record = firmware_.record();
  Bytes told(record.begin(), record.end());
  if (!in_bootloader_)
    return told;
  told.resize(short_record);
  told.front() = short_record_version;
  for (const auto at : {spec::version_firmware_at, spec::version_firmware_at + 1,
                        spec::version_orbbasic_at, spec::version_macro_at})
    told[at] = 0;
  return told;
}

std::string Dispatcher::level_1() {
  bring_up_to_date();
  const auto record = firmware_.record();
  const auto nibbles = [](std::uint8_t byte) { return fmt::format("{}.{}", byte >> 4, byte & 15); };
  const auto& settings = host_->settings();
  const auto& body = host_->body();
  const auto felt = body.acceleration_g();
  const auto rate = body.rotation_deg_s();
  std::string out;
  out += fmt::format("[System]\nMode {}, Boot code {}\n", device_mode_ == 0 ? 'N' : 'H',
                     boot_reason_cold);
  out += fmt::format("{} rechrg, {} s since last, {} s alive\n", profile_.charges,
                     profile_.since_charge_s, profile_.awake_s);
  out += fmt::format("Cold:{}, Wakeup:{}\n", profile_.cold_boots, profile_.wake_ups);
  out += fmt::format("Dist rolled: {} cm, Vbatt {:.2f}, state: {}\n",
                     profile_.rolled_cm + body.rolled_cm(), body.battery_v(),
                     spec::value_name("power state", host_->power().battery_state()));
  out += fmt::format("Stabilize:{}\nAutoRN:{}\nMac:{}\nBas:{}\n", body.stabilized() ? 1 : 0,
                     profile_.auto_reconnect ? 1 : 0, host_->macros().id(),
                     host_->programs().running() ? 1 : 0);
  out += fmt::format("Bootldr={}\nMA={}.{}\nBoard={}\nOrbBasic={}\nMacExec={}\n",
                     nibbles(record[version_bootloader_at]), record[spec::version_firmware_at],
                     record[spec::version_firmware_at + 1], record[version_hardware_at],
                     nibbles(firmware_.orbbasic()), nibbles(record[spec::version_macro_at]));
  out += fmt::format(
      "[Network]\nRx good:{}, bad:{}, Tx:{}\nRx overruns:{}, Tx:{}\n", counters_.good,
      counters_.bad_checksum + counters_.bad_did + counters_.bad_cid + counters_.bad_dlen,
      host_->link().sent(), counters_.overruns, host_->link().dropped());
  out += fmt::format("Dev name: {}, BTA:{}\n", own_name(profile_), bluetooth_address(seed_));
  out += fmt::format("[Options]\nPermanent:{:08X}, Temporary:{:08X}\nTrip points:{}, {}\n",
                     settings.permanent_flags, settings.temporary_flags, settings.low_battery_cv,
                     settings.critical_battery_cv);
  out += fmt::format("ClientTimeOut={}\nMotionTimeOut={}\n",
                     settings.inactivity_timeout / std::chrono::seconds{1},
                     settings.motion_timeout / std::chrono::milliseconds{1});
  out +=
      fmt::format("[Sensors]\nAccel X={:.4f} Y={:.4f} Z={:.4f}\nGyro X={:.4f} Y={:.4f} Z={:.4f}\n",
                  felt.x, felt.y, felt.z, rate.x, rate.y, rate.z);
  out += fmt::format("Pitch={:.3f} Roll={:.3f} Yaw={:.3f}\n", body.pitch_deg(), body.roll_deg(),
                     body.yaw_deg());
  const auto pose = body.pose();
  const auto& limits = settings.collisions;
  out += fmt::format("[Control]\nX={:.1f} Y={:.1f} Speed={:.1f} cm/s\nHeading={:.1f}, Speed={}\n",
                     pose.x_cm, pose.y_cm, pose.speed_cm_s, body.heading_setpoint_deg(),
                     body.speed_setpoint());
  out += fmt::format("[Collisions]\nMethod={} Xt={} Xs={} Yt={} Ys={} Dead={} ms\n", limits.method,
                     limits.x_threshold, limits.x_speed, limits.y_threshold, limits.y_speed,
                     limits.dead_time_10ms * 10);
  return out;
}

} // namespace orb::vm
