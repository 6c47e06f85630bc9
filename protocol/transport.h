#pragma once

#include "base/bytes.h"
#include "base/time.h"

#include <string>
#include <tl/expected.hpp>

namespace orb::protocol {

/// Why a link does not work, in words a user can act on: what happened, then what helps.
struct LinkError {
  enum class Kind {
    CannotOpen, ///< the node is missing, busy, refused or not permitted
    Unfit,      ///< the robot answers, but cannot do what is required
    Closed,     ///< the other side closed the link
    Broken,     ///< the operating system reported an error
    Mismatch,   ///< a write differed from the recording
    Ended,      ///< the recording is at its end
    Interrupted ///< stopped by the user (Ctrl-C)
  };
  Kind kind = Kind::Broken;
  std::string message;
};

/// A stream of bytes to a ball with its own clock: virtual for a simulated ball, the steady clock
/// for a real link. Waiting means reading with a deadline; nothing else reads a clock.
class Transport {
public:
  virtual ~Transport() = default;

  virtual Instant now() const = 0;

  /// Writes all bytes or fails; on failure some of them may have been sent.
  virtual tl::expected<void, LinkError> write(ByteView bytes) = 0;

  /// Returns what has arrived as soon as there is a byte; empty if `deadline` passes first. A
  /// deadline at or before now() polls.
  virtual tl::expected<Bytes, LinkError> read(Instant deadline) = 0;
};

} // namespace orb::protocol
