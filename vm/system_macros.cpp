#include "vm/system_macros.h"

namespace orb::vm {
namespace {

// clang-format off
constexpr std::uint8_t stop[]      = {1, 0x00, 0x25, 0, 0,                                       // set_speed 0
                                      0x00};
constexpr std::uint8_t blink[]     = {2, 0x00, 0x1E, 3,                                          // loop_start 3
                                      0x07, 255, 255, 255, 200, 0x07, 0, 0, 0, 200,              //   rgb on, off
                                      0x1F, 0x00};
constexpr std::uint8_t spin[]      = {3, 0x01, 0x1A, 0x01, 0x68, 0x03, 0xE8, 0x0B, 0x03, 0xE8,   // rotate 360deg 1s; delay 1s
                                      0x00};
constexpr std::uint8_t heartbeat[] = {4, 0x40, 0x14, 255, 0, 0, 0x01, 0xF4, 0x0B, 0x01, 0xF4,    // unkillable: fade in
                                      0x14, 0, 0, 0, 0x01, 0xF4, 0x0B, 0x01, 0xF4,               //   and out
                                      0x00};

constexpr SystemMacro macros[] = {
    {1, "stops without a turn",                    stop},
    {2, "blinks white three times",                blink},
    {3, "turns round once in a second",            spin},
    {4, "fades red in and out; cannot be aborted", heartbeat},
};
// clang-format on

} // namespace

std::span<const SystemMacro> system_macros() {
  return macros;
}

} // namespace orb::vm
