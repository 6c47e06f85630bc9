#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace orb::editor {

/// Splits a byte stream into messages of the Language Server Protocol: headers, an empty line, then
/// `Content-Length` bytes. Recovers from any error with the next message.
class MessageReader {
public:
  /// Bytes. Longer messages are skipped without storing them.
  static constexpr std::size_t max_message = 16U << 20;
  static constexpr std::size_t max_header = 4096;

  struct Event {
    bool is_error = false;
    std::string text; ///< the message, or the error
  };

  void feed(std::string_view bytes) { buffer_.append(bytes); }

  /// Returns the next message or error in the input so far; nothing if more is needed.
  std::optional<Event> next();

private:
  std::optional<Event> read_header();
  void skip_to_header();

  std::string buffer_;
  std::optional<std::size_t> length_; ///< of the message being read
  std::size_t to_skip_ = 0;
  bool lost_ = false; ///< the last body has an unknown length: search for the next header
};

/// Adds the header to a message.
std::string frame(std::string_view message);

} // namespace orb::editor
