#include "vm/ball_asks.h"

#include "protocol/payload.h"
#include "spec/ball.h"
#include "spec/colours.h"
#include "spec/macro.h"
#include "spec/unit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orb::vm {
namespace {

using spec::BasicError;
using spec::Statement;
using spec::Variable;

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

/// Scale of each variable.
constexpr auto scales = [] {
  std::array<spec::Scale, spec::variables.size()> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = spec::scale_of(spec::variables[i].unit);
  return table;
}();

} // namespace

std::int32_t Ball::Asks::OfProgram::read(Variable variable, Instant now) {
  ball_.now_ = now;
  ball_.body_.advance_to(now);
  const auto value = ball_.peek(variable, ball_.now_);
  if (variable == Variable::Cmdroll)
    ball_.drive_.take_new_roll();
  else if (variable == Variable::Cmdrgb)
    ball_.lamps_.take_new_color();
  else if (variable == Variable::Dshake)
    ball_.double_shake_ = false;
  return value;
}

std::int32_t Ball::peek(Variable variable, Instant at) const {
  const auto steps = [&](double value) {
    const auto& row = spec::info(variable);
    value = scales[static_cast<std::size_t>(variable)].of(value);
    return rounded(std::clamp<double>(value, row.least, row.greatest));
  };
  switch (variable) {
  case Variable::TimerA:
  case Variable::TimerB:
  case Variable::TimerC: return programs_.machine().timer(variable, at);
  case Variable::Ctrl: return body_.stabilized() ? 1 : 0;
  case Variable::Speed: return body_.speed();
  case Variable::Yaw: return rounded(body_.yaw_deg()) % spec::ball::full_circle;
  case Variable::Pitch: return steps(body_.pitch_deg());
  case Variable::Roll: return steps(body_.roll_deg());
  case Variable::AccelX: return steps(body_.acceleration_g().x);
  case Variable::AccelY: return steps(body_.acceleration_g().y);
  case Variable::AccelZ: return steps(body_.acceleration_g().z);
  case Variable::GyroX: return steps(body_.rotation_deg_s().x);
  case Variable::GyroY: return steps(body_.rotation_deg_s().y);
  case Variable::GyroZ: return steps(body_.rotation_deg_s().z);
  case Variable::Vbatt: return steps(body_.battery_v());
  case Variable::Sbatt: return power_.battery_state();
  case Variable::Cmdroll: return drive_.new_roll() ? 1 : 0;
  case Variable::Spdval: return drive_.client_roll().speed;
  case Variable::Hdgval: return drive_.client_roll().heading_deg;
  case Variable::Cmdrgb: return lamps_.new_color() ? 1 : 0;
  case Variable::Redval: return lamps_.client_color().red;
  case Variable::Grnval: return lamps_.client_color().green;
  case Variable::Bluval: return lamps_.client_color().blue;
  case Variable::Isconn: return connected() ? 1 : 0;
  case Variable::Dshake: return double_shake_ ? 1 : 0;
  case Variable::Accelone: return steps(body_.acceleration_total_g());
  case Variable::Xpos: return steps(body_.locator_cm().x);
  case Variable::Ypos: return steps(body_.locator_cm().y);
  case Variable::Qzero: return steps(body_.attitude().w);
  case Variable::Qone: return steps(body_.attitude().x);
  case Variable::Qtwo: return steps(body_.attitude().y);
  case Variable::Qthree: return steps(body_.attitude().z);
  case Variable::Macstat: return static_cast<std::int32_t>(macros_.macstat());
  }
  return 0;
}

std::optional<BasicError> Ball::Asks::OfProgram::write(Variable, std::int32_t value, Instant now) {
  // `ctrl` is the only variable that programs may assign here.
  ball_.now_ = now;
  const bool rolled_freely = ball_.body_.rolls_freely();
  ball_.drive(Actor::Basic, value == 0 ? Stabilization::Off : Stabilization::On);
  if (rolled_freely && !ball_.body_.rolls_freely())
    ball_.programs_.interrupt(); // its steps count from now on
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
    ball_.run_macro(values[0]); // no effect while a macro runs
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
  case Statement::Troff: break; // the machine handles these itself
  }
  return std::nullopt;
}

void Ball::Asks::OfMacro::emit_marker(int marker, int macro, int command) {
  ball_.trace(event::Marker{marker, macro, command});
  ball_.send(protocol::make_async(spec::AsyncId::MacroMarker, {marker, macro, command}));
}

void Ball::Asks::OfMacro::sleep_ms(int time_ms) {
  constexpr int second_ms = std::chrono::milliseconds{1s}.count();
  const auto& last = ball_.power_.last_sleep();
  ball_.power_.ask_to_sleep(time_ms == spec::macro_sleep_inherit
                                ? Sleep{last.seconds, 0, 0, last.milliseconds}
                                : Sleep{time_ms / second_ms, 0, 0, time_ms % second_ms});
}

} // namespace orb::vm
