#pragma once

#include "protocol/decoder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// A field of a packet: a number and what it stands for, or a text.
struct NamedValue {
  std::string name;
  std::optional<std::int64_t> number;
  std::string text; ///< of a number: its meaning, empty where it has none
};

/// A packet taken apart.
struct Parts {
  std::string_view name; ///< of the command, also of the one that is answered, or of the message
  std::vector<NamedValue> fields;
  Bytes rest; ///< of the data: what no field names
};

/// Puts packets into words, every field named. It remembers the commands it has described, so that
/// an answer's fields, which only its SEQ ties to a command, and the values of a sensor stream have
/// names too.
class Describer {
public:
  /// One line without a line end.
  std::string describe(const Item& item);
  /// The same as values, of a whole packet.
  Parts parts(const Item& item);

private:
  void remember(const Item& item);
  std::string command(const Item& item);
  std::string response(const Item& item);
  std::string async(const Item& item) const;

  /// By SEQ: the command last seen with it.
  std::array<const spec::CommandInfo*, UINT8_MAX + 1> asked_{};
  std::uint64_t stream_mask_ = 0;
};

} // namespace orb::protocol
