#pragma once

#include "protocol/decoder.h"

#include <array>
#include <cstdint>
#include <string>

namespace orb::protocol {

/// Puts packets into words, every field named. It remembers the commands it has described, so that
/// an answer's fields, which only its SEQ ties to a command, and the values of a sensor stream have
/// names too.
class Describer {
public:
  /// One line without a line end.
  std::string describe(const Item& item);

private:
  std::string command(const Item& item);
  std::string response(const Item& item);
  std::string async(const Item& item) const;

  /// By SEQ: the command last seen with it; 0xFFFF where none was.
  std::array<std::uint16_t, 256> asked_ = no_commands();
  std::uint64_t stream_mask_ = 0;

  static std::array<std::uint16_t, 256> no_commands() {
    std::array<std::uint16_t, 256> none;
    none.fill(0xFFFF);
    return none;
  }
};

} // namespace orb::protocol
