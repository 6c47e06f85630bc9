#pragma once

#include <cstdint>
#include <string>

namespace orb::vm {

/// The Bluetooth address of a ball, twelve digits: it follows from the seed, so that the balls of
/// one server differ.
std::string bluetooth_address(std::uint64_t seed);

} // namespace orb::vm
