#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::protocol {

/// Why a link does not work, in words a user can act on: what was seen, then what helps.
struct LinkError {
  enum class Kind {
    CannotOpen, ///< the node is missing, busy, refused or not permitted
    Unfit,      ///< the robot is there, but cannot do what is wanted of it
    Closed,     ///< the other side hung up
    Broken,     ///< the operating system reported an error
    Mismatch,   ///< a replayed recording saw other bytes than it holds
    Ended,      ///< a replayed recording has been played to its end
    Interrupted ///< the user stopped it (Ctrl-C)
  };
  Kind kind = Kind::Broken;
  std::string message;
};

/// A stream of bytes to a ball with a time line of its own: virtual for a simulated ball, the
/// steady clock for a real link. Waiting is reading with a deadline; nothing else reads a clock.
class Transport {
public:
  virtual ~Transport() = default;

  virtual Instant now() const = 0;

  /// Writes all bytes or fails; part of them may have gone out when it fails.
  virtual tl::expected<void, LinkError> write(ByteView bytes) = 0;

  /// What has arrived, as soon as there is at least one byte; nothing when `deadline` passes first.
  /// A deadline that is not after now() polls.
  virtual tl::expected<Bytes, LinkError> read(Instant deadline) = 0;
};

} // namespace orb::protocol
