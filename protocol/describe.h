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

  /// By SEQ: the command last seen with it.
  std::array<const spec::CommandInfo*, UINT8_MAX + 1> asked_{};
  std::uint64_t stream_mask_ = 0;
};

} // namespace orb::protocol
