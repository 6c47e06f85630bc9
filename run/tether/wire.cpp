#include "run/tether/wire.h"

#include <fmt/format.h>

namespace orb::run {

std::string RobotWire::name_of(const Request& request) const {
  const auto name = command_name(request);
  return fmt::format("{} ({:02X}h {:02X}h)", name.empty() ? "a command" : name, request.did,
                     request.cid);
}

Bytes CollisionLimits::operands() const {
  constexpr std::uint8_t dead_time = 20; // in units of 10 ms
  const auto at_rest = static_cast<std::uint8_t>(threshold);
  const auto by_speed = static_cast<std::uint8_t>(speed);
  return {1, at_rest, by_speed, at_rest, by_speed, dead_time};
}

std::optional<vm::event::Collision> read_collision(ByteView data, std::size_t speed_at) {
  constexpr std::size_t size = 16;
  constexpr std::size_t with_long_time = 18;
  if (data.size() != size && data.size() != with_long_time)
    return std::nullopt;
  const auto word = [&](std::size_t at) { return static_cast<std::int16_t>(read_u16(data, at)); };
  constexpr std::size_t axis = 6;
  constexpr std::size_t powers = 7;
  return vm::event::Collision{word(0),      word(2),          data[axis],
                              word(powers), word(powers + 2), data[speed_at]};
}

} // namespace orb::run
