#pragma once

#include "protocol/decoder.h"
#include "protocol/packet_v2.h"
#include "spec/robots.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::protocol {

/// The effect of a command on a robot, as far as its judge needs it.
enum class Effect : std::uint8_t {
  None,
  Drives,
  Stops,
  Wakes,
  Sleeps,
  EndsSafely ///< the robot now stops by itself when it loses its client
};

/// When an answer is due.
enum class Answers : std::uint8_t { Never, Errors, Always };

/// A command with packets v1 or v2.
struct Order {
  std::string name;      ///< for example `roll`; its ids if no table has it
  std::uint32_t key = 0; ///< the part that its answer repeats
  std::uint8_t seq = 0;
  Answers answers = Answers::Always;
  Effect effect = Effect::None;
  bool is_known = false;     ///< a table has it
  bool needs_waking = false; ///< a sleeping robot does not obey it
  std::string_view instead;  ///< the command that makes the robot report by itself; or empty
};

/// How a command is refused.
struct Refusal {
  enum class Why : std::uint8_t {
    Link,    ///< damaged or incomplete
    Unknown, ///< the robot does not know it
    Asleep,
    Other
  };
  Why why = Why::Other;
  std::string error; ///< `07h, parameter value(s) invalid`
};

/// An answer with packets v1 or v2.
struct Reply {
  std::uint32_t key = 0;
  std::optional<Refusal> refusal;
};

Order order_of(const Item& item);
Order order_of(const PacketV2& packet);
Reply reply_of(const Item& item);
Reply reply_of(const PacketV2& packet);

/// Returns how a command would be refused according to the tables alone; nullopt if they do not
/// object or have no row. Without a robot only length and values are checked.
std::optional<Refusal> refusal_of(const Item& item);
std::optional<Refusal> refusal_of(const PacketV2& packet, std::optional<spec::Robot> robot);

} // namespace orb::protocol
