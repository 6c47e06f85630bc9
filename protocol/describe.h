#pragma once

#include "protocol/decoder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// A field of a packet: a number with its meaning, or a text.
struct NamedValue {
  std::string name;
  std::optional<std::int64_t> number;
  std::string text; ///< meaning of a number, which may be empty; otherwise the text
};

/// A packet split into fields.
struct Parts {
  std::string_view name; ///< of the command, also of one that is answered, or of the message
  std::vector<NamedValue> fields;
  Bytes rest; ///< data bytes that no field covers
};

/// Describes packets with all fields named. Remembers commands, because only SEQ ties an answer to
/// its command, and because a sensor stream depends on the mask requested.
class Describer {
public:
  /// Returns one line without a line end.
  std::string describe(const Item& item);
  /// Returns the fields of a whole packet.
  Parts parts(const Item& item);

private:
  void remember(const Item& item);
  std::string command(const Item& item);
  std::string response(const Item& item);
  std::string async(const Item& item) const;

  /// The last command with each SEQ.
  std::array<const spec::CommandInfo*, UINT8_MAX + 1> asked_{};
  std::uint64_t stream_mask_ = 0;
};

} // namespace orb::protocol
