#include "vm/ball_asks.h"

#include "protocol/payload.h"
#include "spec/macro.h"

#include <algorithm>
#include <cmath>

namespace orb::vm {
namespace {

using spec::BasicError;
using spec::Statement;
using spec::Variable;

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

std::int32_t rounded_s16(double value) {
  return static_cast<std::int32_t>(std::lround(std::clamp<double>(value, INT16_MIN, INT16_MAX)));
}

} // namespace

std::int32_t Ball::Asks::OfProgram::read(Variable variable, Instant now) {
  ball_.now_ = now;
  ball_.body_.advance_to(now);
  const auto& body = ball_.body_;
  auto& lamps = ball_.lamps_;
  auto& drive = ball_.drive_;
  constexpr double g = 4096; // 8 g are full scale of 16 bits; other units: spec/basic.def
  switch (variable) {
  case Variable::TimerA:
  case Variable::TimerB:
  case Variable::TimerC: break; // the machine's own
  case Variable::Ctrl: return body.stabilized() ? 1 : 0;
  case Variable::Speed: return body.speed();
  case Variable::Yaw: return rounded(body.yaw_deg()) % 360;
  case Variable::Pitch: return rounded(body.pitch_deg());
  case Variable::Roll: return rounded(body.roll_deg());
  case Variable::AccelX: return rounded_s16(body.acceleration_g().x * g);
  case Variable::AccelY: return rounded_s16(body.acceleration_g().y * g);
  case Variable::AccelZ: return rounded_s16(body.acceleration_g().z * g);
  case Variable::GyroX: return rounded(body.rotation_deg_s().x * 10);
  case Variable::GyroY: return rounded(body.rotation_deg_s().y * 10);
  case Variable::GyroZ: return rounded(body.rotation_deg_s().z * 10);
  case Variable::Vbatt: return rounded(body.battery_v() * 100);
  case Variable::Sbatt: return ball_.power_.battery_state();
  case Variable::Cmdroll: return drive.take_new_roll() ? 1 : 0;
  case Variable::Spdval: return drive.client_roll().speed;
  case Variable::Hdgval: return drive.client_roll().heading_deg;
  case Variable::Cmdrgb: return lamps.take_new_color() ? 1 : 0;
  case Variable::Redval: return lamps.client_color().red;
  case Variable::Grnval: return lamps.client_color().green;
  case Variable::Bluval: return lamps.client_color().blue;
  case Variable::Isconn: return ball_.connected() ? 1 : 0;
  case Variable::Dshake: return std::exchange(ball_.double_shake_, false) ? 1 : 0;
  case Variable::Accelone: return rounded(body.acceleration_total_g() * 1000);
  case Variable::Xpos: return rounded_s16(body.pose().x_cm);
  case Variable::Ypos: return rounded_s16(body.pose().y_cm);
  case Variable::Qzero: return rounded(body.attitude().w * 10000);
  case Variable::Qone: return rounded(body.attitude().x * 10000);
  case Variable::Qtwo: return rounded(body.attitude().y * 10000);
  case Variable::Qthree: return rounded(body.attitude().z * 10000);
  case Variable::Macstat: return static_cast<std::int32_t>(ball_.macros_.macstat());
  }
  return 0;
}

std::optional<BasicError> Ball::Asks::OfProgram::write(Variable, std::int32_t value, Instant now) {
  // `ctrl` is the one that programs may assign.
  ball_.now_ = now;
  ball_.drive(Actor::Basic, value == 0 ? Stabilization::Off : Stabilization::On);
  return std::nullopt;
}

std::optional<Instant> Ball::Asks::OfProgram::print(std::string_view text, Instant now) {
  ball_.now_ = now;
  if (const auto again = ball_.link_.print(text, now))
    return again;
  ball_.trace(event::Print{std::string(text)});
  return std::nullopt;
}

void Ball::Asks::OfProgram::line_ended(int line, Instant now) {
  ball_.now_ = now;
  ball_.trace(event::Line{line});
}

std::optional<BasicError> Ball::Asks::OfProgram::perform(Statement statement,
                                                         std::span<const std::int32_t> values,
                                                         Instant now) {
  ball_.now_ = now;
  const auto byte = [&](std::size_t n) { return static_cast<std::uint8_t>(values[n]); };
  switch (statement) {
  case Statement::Rgb: ball_.set_led(Actor::Basic, {byte(0), byte(1), byte(2)}); break;
  case Statement::Ledc: {
    const auto& row = spec::led_colours[byte(0)];
    ball_.set_led(Actor::Basic, {row.red, row.green, row.blue});
    break;
  }
  case Statement::BackLed: ball_.set_back_led(values[0]); break;
  case Statement::Goroll: {
    const Go go = values.size() > 2 ? static_cast<Go>(values[2])
                  : values[1] > 0   ? Go::Drive
                                    : Go::Brake;
    ball_.drive(Actor::Basic, Roll{values[0], values[1], go});
    break;
  }
  case Statement::Heading: ball_.drive(Actor::Basic, SetHeading{values[0]}); break;
  case Statement::Raw:
    ball_.drive(Actor::Basic, Motors{{static_cast<MotorMode>(values[0]), values[1]},
                                     {static_cast<MotorMode>(values[2]), values[3]}});
    break;
  case Statement::Locate:
    ball_.body_.advance_to(now);
    ball_.body_.locate(values[0], values[1]);
    break;
  case Statement::Basflg:
    ball_.programs_.set_flags(static_cast<std::uint32_t>(values[0]));
    ball_.share_drive();
    ball_.show_lamps();
    break;
  case Statement::Sleep: ball_.power_.ask_to_sleep({values[0], values[1], values[2]}); break;
  case Statement::Macrun:
    ball_.run_macro(values[0]); // while one runs it has no effect
    break;
  case Statement::Mackill:
    ball_.macros_.abort(now);
    ball_.settle();
    break;
  case Statement::Reset:
    ball_.programs_.set_flags(0);
    ball_.share_drive();
    break;
  case Statement::Let:
  case Statement::If:
  case Statement::For:
  case Statement::Next:
  case Statement::Goto:
  case Statement::Gosub:
  case Statement::Return:
  case Statement::On:
  case Statement::Print:
  case Statement::Input:
  case Statement::Delay:
  case Statement::End:
  case Statement::Random:
  case Statement::Data:
  case Statement::Rstr:
  case Statement::Read:
  case Statement::Tron:
  case Statement::Troff: break; // the machine's own
  }
  return std::nullopt;
}

void Ball::Asks::OfMacro::emit_marker(int marker, int macro, int command) {
  ball_.trace(event::Marker{marker, macro, command});
  ball_.send(protocol::make_async(spec::AsyncId::MacroMarker, {marker, macro, command}));
}

void Ball::Asks::OfMacro::sleep_ms(int time_ms) {
  constexpr int second_ms = 1000;
  const auto& last = ball_.power_.last_sleep();
  ball_.power_.ask_to_sleep(time_ms == spec::macro_sleep_inherit
                                ? Sleep{last.seconds, 0, 0, last.milliseconds}
                                : Sleep{time_ms / second_ms, 0, 0, time_ms % second_ms});
}

} // namespace orb::vm
