#pragma once

#include <asio/io_context.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <sys/types.h>

namespace orb::serve {

/// Passes the lines of a source to an event loop, one at a time, without line ends. Reads in a
/// separate thread, because reading may block and others may share the source, for example a
/// terminal.
class LineReader {
public:
  /// Has the contract of read(2).
  using Read = std::function<ssize_t(std::span<char>)>;
  /// Longer lines are passed on in pieces.
  static constexpr std::size_t longest = 4096;

  /// `io` calls `on_line`. `read` must stay valid for the life of the process.
  LineReader(asio::io_context& io, Read read, std::function<void(const std::string&)> on_line);
  /// Stops passing lines on; a blocked read is abandoned.
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

} // namespace orb::serve
