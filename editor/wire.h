#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace orb::editor {

/// Cuts a byte stream into the messages of the Language Server Protocol: headers, an empty line,
/// as many bytes as `Content-Length` says. Whatever arrives, it goes on with the next message.
class MessageReader {
public:
  /// Longer messages are skipped, not stored.
  static constexpr std::size_t max_message = 16U << 20;
  static constexpr std::size_t max_header = 4096;

  struct Event {
    bool is_error = false;
    std::string text; ///< the message, or what is wrong with it
  };

  void feed(std::string_view bytes) { buffer_.append(bytes); }

  /// The next message or fault in what was fed; nothing until more arrives.
  std::optional<Event> next();

private:
  std::optional<Event> read_header();
  void skip_to_header();

  std::string buffer_;
  std::optional<std::size_t> length_; ///< of the message that is being read
  std::size_t to_skip_ = 0;
  bool lost_ = false; ///< how long the last body is is not known: the next header has to be found
};

/// A message with its header.
std::string frame(std::string_view message);

} // namespace orb::editor
