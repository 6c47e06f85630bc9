#pragma once

#include "spec/ble.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace orb::vm {

/// Returns the Bluetooth address of a ball, twelve digits. It is derived from the seed, so that the
/// balls of one server differ.
std::string bluetooth_address(std::uint64_t seed);

/// Such an address as people write it: `68:86:E7:00:00:01`.
inline std::string with_colons(std::string_view address) {
  std::string out;
  for (std::size_t i = 0; i + 1 < address.size(); i += 2)
    out.append(i > 0 ? ":" : "").append(address.substr(i, 2));
  return out;
}

/// What a robot calls itself over Bluetooth LE: its kind and the end of its address, `SB-1A2B`.
inline std::string advertised_name(spec::BleModel model, std::string_view address) {
  constexpr std::size_t told = 4; // digits of the address
  return std::string(spec::info(model).prefix).append(address.substr(address.size() - told));
}

} // namespace orb::vm
