#include "vm/ball.h"
#include "vm/body/trigonometry.h"

#include <algorithm>
#include <cmath>

// A ball in a room: contacts with other balls, and fast advance between them.

namespace orb::vm {

void Ball::meet(const Shove& shove, std::span<const std::string> names) {
  calm_until_ = {};
  body_.advance_to(now_);
  const auto [place, velocity] = body_.mover();
  body_.meet(shove);
  for (const auto& knock : shove.knocks) {
    body_.feel_blow(knock.into, vm::length(velocity.x, velocity.y));
    const auto impact = *body_.take_impact();
    trace(event::Bump{{}, impact.speed, names[knock.other]});
    detect_collision(impact);
  }
  settle();
  watch_motion();
}

bool Ball::coast(Instant target) {
  return target < calm_until_ && pass(target);
}

Instant Ball::next_push() const {
  const auto push = std::find_if(script_.rbegin(), script_.rend(), [](const auto& event) {
    return std::holds_alternative<stimulus::Push>(event.stimulus);
  });
  return push == script_.rend() ? never : Instant{} + push->at;
}

} // namespace orb::vm
