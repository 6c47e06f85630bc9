#pragma once

/// Serial ports to a ball.
namespace orb::spec {

/// A convention: an RFCOMM port has no baud rate, but opening a port requires one.
inline constexpr unsigned serial_baud_rate = 115200;

} // namespace orb::spec
