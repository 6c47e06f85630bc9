#include "vm/drive.h"

namespace orb::vm {
namespace {

/// Returns true for motions that restart the motion time-out.
bool sets_in_motion(const Motion& motion) {
  return std::holds_alternative<Roll>(motion) || std::holds_alternative<Rotate>(motion) ||
         std::holds_alternative<Motors>(motion) || std::holds_alternative<SetSpeed>(motion);
}

} // namespace

bool Drive::may_move(const Motion& motion) {
  return sets_in_motion(motion) || std::holds_alternative<Stabilization>(motion);
}

Outcome Drive::obey(Actor actor, const Motion& motion, Instant now) {
  if (const auto* roll = std::get_if<Roll>(&motion); roll && actor == Actor::Client) {
    client_roll_ = *roll;
    new_roll_ = true;
  }
  if (!may(actor) && !std::holds_alternative<RotationRate>(motion))
    return Outcome::Refused;
  body_->advance_to(now);
  const auto outcome = body_->obey(motion);
  if (sets_in_motion(motion))
    deadline_ = settings_->has(spec::permanent_option_flags::motion_timeout)
                    ? now + settings_->motion_timeout
                    : never;
  return outcome;
}

void Drive::share(Wanted wanted) {
  if (exclusive_ && !(*exclusive_ == Actor::Basic ? wanted.by_program : wanted.by_macro))
    exclusive_.reset();
  if (!exclusive_ && wanted.by_program)
    exclusive_ = Actor::Basic;
  if (!exclusive_ && wanted.by_macro)
    exclusive_ = Actor::Macro;
}

void Drive::run(Instant now) {
  if (now < deadline_)
    return;
  deadline_ = never;
  if (!exclusive_)
    body_->obey(Stop{});
}

void Drive::settings_changed() {
  if (!settings_->has(spec::permanent_option_flags::motion_timeout))
    deadline_ = never;
}

void Drive::fall_asleep() {
  new_roll_ = false;
  deadline_ = never;
}

} // namespace orb::vm
