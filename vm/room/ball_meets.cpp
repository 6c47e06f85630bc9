#include "vm/ball.h"

#include <algorithm>
#include <cmath>

// What other balls do to a ball.

namespace orb::vm {

void Ball::meet(const Shove& shove, std::span<const std::string> names) {
  body_.advance_to(now_);
  const auto [place, velocity] = body_.mover();
  body_.meet(shove);
  for (const auto& knock : shove.knocks) {
    body_.feel_blow(knock.into, std::hypot(velocity.x, velocity.y));
    const auto impact = *body_.take_impact();
    trace(event::Bump{{}, impact.speed, names[knock.other]});
    detect_collision(impact);
  }
  settle();
  watch_motion();
}

double Ball::most_speed_cm_s(Duration time) const {
  const bool pushed = std::any_of(script_.begin(), script_.end(), [&](const auto& event) {
    return std::holds_alternative<stimulus::Push>(event.stimulus) &&
           Instant{} + event.at <= now_ + time;
  });
  return body_.most_speed_cm_s() + spec::ball::acceleration * seconds(time) +
         (pushed ? spec::ball::full_speed : 0);
}

} // namespace orb::vm
