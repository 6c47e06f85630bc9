#pragma once

#include <asio/io_context.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <sys/types.h>

namespace orb::serve {

/// Hands the lines of a source to an event loop, one at a time, without their ends. The source is
/// read in a thread of its own, as reading may block, and others may share it: a terminal, say.
class LineReader {
public:
  /// As read(2).
  using Read = std::function<ssize_t(std::span<char>)>;
  /// A longer line is handed on in pieces.
  static constexpr std::size_t longest = 4096;

  /// `on_line` is called by `io`. `read` must be good for as long as the process lives.
  LineReader(asio::io_context& io, Read read, std::function<void(const std::string&)> on_line);
  /// Nothing is handed on any more; a read that waits is left alone.
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

} // namespace orb::serve
