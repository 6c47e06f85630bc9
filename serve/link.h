#pragma once

#include "base/bytes.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <sys/types.h>

namespace orb::serve {

class Link;

/// What a ball does about the clients that its links find.
class Door {
public:
  /// Whether a client may come in: one at a time.
  virtual bool admits() = 0;
  /// The client of `link` is there, until hang_up().
  virtual void enter(Link& link) = 0;
  /// `link` has another address from now on.
  virtual void moved(const Link& link) = 0;

protected:
  ~Door() = default;
};

/// A way to a ball: clients come and go on it, one at a time. Nothing here blocks.
class Link {
public:
  enum class Ready : std::uint8_t { Read, Write };

  virtual ~Link() = default;
  /// Where clients find it, such as `tcp 127.0.0.1:4242`.
  virtual std::string address() const = 0;
  /// Begins to look for clients.
  virtual void start(Door& door) = 0;
  /// Lets the client go.
  virtual void hang_up() = 0;
  /// Whether the client notices hang_up().
  virtual bool can_hang_up() const = 0;

  /// Calls `handler` once, when the client can be read from or written to.
  virtual void wait(Ready ready, std::function<void()> handler) = 0;
  /// As read(2) and write(2).
  virtual ssize_t read(std::span<std::uint8_t> buffer) = 0;
  virtual ssize_t write(ByteView bytes) = 0;
  /// Whether nobody is at the other end (any more); bytes may still wait.
  virtual bool client_left() = 0;
};

} // namespace orb::serve
