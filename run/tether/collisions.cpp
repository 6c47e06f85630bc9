#include "run/tether/wire.h"

namespace orb::run {

Bytes CollisionLimits::operands() const {
  constexpr std::uint8_t dead_time = 20; // of 10 ms
  const auto at_rest = static_cast<std::uint8_t>(threshold);
  const auto by_speed = static_cast<std::uint8_t>(speed);
  return {1, at_rest, by_speed, at_rest, by_speed, dead_time};
}

std::optional<vm::event::Collision> read_collision(ByteView data) {
  constexpr std::size_t size = 16;
  constexpr std::size_t with_third_power = 18;
  if (data.size() != size && data.size() != with_third_power)
    return std::nullopt;
  const auto word = [&](std::size_t at) { return static_cast<std::int16_t>(read_u16(data, at)); };
  constexpr std::size_t axis = 6;
  constexpr std::size_t powers = 7;
  constexpr std::size_t after = 5; // the time and the speed before it
  return vm::event::Collision{word(0),      word(2),          data[axis],
                              word(powers), word(powers + 2), data[data.size() - after]};
}

} // namespace orb::run
