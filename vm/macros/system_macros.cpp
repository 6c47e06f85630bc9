#include "vm/macros/system_macros.h"

#include "spec/ball.h"
#include "spec/macro.h"

namespace orb::vm {
namespace {

using enum spec::MacroCommand;

constexpr std::uint8_t code(spec::MacroCommand command) {
  return static_cast<std::uint8_t>(command);
}
constexpr std::uint8_t code(spec::MacroFlag flag) {
  return static_cast<std::uint8_t>(flag);
}
/// The two bytes of a number, in the order of an image.
constexpr std::uint8_t high(int number) {
  return static_cast<std::uint8_t>(number >> 8);
}
constexpr std::uint8_t low(int number) {
  return static_cast<std::uint8_t>(number);
}

constexpr int half_second = 500;   // ms
constexpr int second = 1000;       // ms
constexpr std::uint8_t wink = 200; // ms
constexpr int turn = spec::ball::full_circle;
constexpr std::uint8_t full = spec::ball::greatest;

// clang-format off
constexpr std::uint8_t stop[]      = {1, 0, code(SetSpeed), 0, 0, code(End)};
constexpr std::uint8_t blink[]     = {2, 0, code(LoopStart), 3,
                                      code(Rgb), full, full, full, wink, code(Rgb), 0, 0, 0, wink,
                                      code(LoopEnd), code(End)};
constexpr std::uint8_t spin[]      = {3, code(spec::MacroFlag::MotorControl),
                                      code(Rotate), high(turn), low(turn), high(second), low(second),
                                      code(Delay), high(second), low(second), code(End)};
constexpr std::uint8_t heartbeat[] = {4, code(spec::MacroFlag::Unkillable),
                                      code(Fade), full, 0, 0, high(half_second), low(half_second),
                                      code(Delay), high(half_second), low(half_second),
                                      code(Fade), 0, 0, 0, high(half_second), low(half_second),
                                      code(Delay), high(half_second), low(half_second), code(End)};

constexpr SystemMacro macros[] = {
    {1, "stops without turning",                    stop},
    {2, "blinks white three times",                blink},
    {3, "turns around once in one second",            spin},
    {4, "fades red in and out; cannot be aborted", heartbeat},
};
// clang-format on

} // namespace

std::span<const SystemMacro> system_macros() {
  return macros;
}

} // namespace orb::vm
