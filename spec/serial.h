#pragma once

/// Serial ports on the way to a ball.
namespace orb::spec {

/// By custom: an RFCOMM port has no baud rate, but who opens a port must name one.
inline constexpr unsigned serial_baud_rate = 115200;

} // namespace orb::spec
