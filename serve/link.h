#pragma once

#include "base/bytes.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <sys/types.h>

namespace orb::serve {

class Link;

/// The ball's side of its links.
class Door {
public:
  /// Returns true if a client may enter: one at a time.
  virtual bool admits() = 0;
  /// Tells that a client has connected through `link`. It stays until hang_up().
  virtual void enter(Link& link) = 0;
  /// Tells that `link` has a new address.
  virtual void moved(const Link& link) = 0;

protected:
  ~Door() = default;
};

/// A way to a ball, used by one client at a time. No function blocks.
class Link {
public:
  enum class Ready : std::uint8_t { Read, Write };

  virtual ~Link() = default;
  /// The address for clients, for example `tcp 127.0.0.1:4242`.
  virtual std::string address() const = 0;
  /// Starts to accept clients.
  virtual void start(Door& door) = 0;
  /// Disconnects the client.
  virtual void hang_up() = 0;
  /// Returns true if the client notices hang_up().
  virtual bool can_hang_up() const = 0;

  /// Calls `handler` once, when the client is readable or writable.
  virtual void wait(Ready ready, std::function<void()> handler) = 0;
  /// Have the contracts of read(2) and write(2).
  virtual ssize_t read(std::span<std::uint8_t> buffer) = 0;
  virtual ssize_t write(ByteView bytes) = 0;
  /// Returns true if the other end is closed; bytes may still be unread.
  virtual bool client_left() = 0;
};

} // namespace orb::serve
