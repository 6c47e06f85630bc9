#include "vm/lamps.h"

#include <array>

namespace orb::vm {
namespace {

constexpr Color battery_warning{255, 0, 0}; // [?]
using spec::ball::id_blink;
constexpr std::array id_colors{Color{255, 0, 0}, Color{0, 255, 0}, Color{0, 0, 255}}; // [?]
constexpr int brightest = spec::ball::greatest;

} // namespace

void Lamps::set(Actor actor, Color color) {
  color_of(actor) = color;
  if (actor == Actor::Client) {
    client_color_ = color;
    new_color_ = true;
  }
}

void Lamps::fall_asleep() {
  release(Actor::Client);
  new_color_ = false;
  back_level_ = 0;
}

Color Lamps::deciding(const Situation& situation) const {
  if (situation.asleep)
    return {};
  if (situation.battery_warns)
    return battery_warning;
  const auto& program = color_of(Actor::Basic);
  if (const auto& macro = color_of(Actor::Macro); macro && !(situation.program_first && program))
    return *macro;
  if (program)
    return *program;
  if (!situation.connected)
    return id_colors[static_cast<std::size_t>(situation.now.time_since_epoch() / id_blink) %
                     id_colors.size()];
  return color_of(Actor::Client).value_or(situation.user_color);
}

void Lamps::become(RemoteBody& robot) {
  robot_ = &robot;
}

std::optional<Color> Lamps::show(const Situation& situation) {
  const auto color = deciding(situation);
  if (std::exchange(shown_, color) == color)
    return std::nullopt;
  if (robot_ != nullptr)
    robot_->show(color);
  return color;
}

std::optional<int> Lamps::show_back(const Situation& situation) {
  const int level = situation.asleep ? 0 : situation.tail_always_on ? brightest : back_level_;
  if (std::exchange(shown_back_, level) == level)
    return std::nullopt;
  if (robot_ != nullptr)
    robot_->show_back(level);
  return level;
}

Instant Lamps::next_blink(const Situation& situation) const {
  if (situation.connected || color_of(Actor::Basic) || color_of(Actor::Macro))
    return never;
  return situation.now - situation.now.time_since_epoch() % id_blink + id_blink;
}

} // namespace orb::vm
