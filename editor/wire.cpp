#include "editor/wire.h"

#include "base/text/header_fields.h"
#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

/// Where the header of the next message begins within `bytes`; else the end of what can be skipped
/// if a body of unknown length comes first.
std::size_t next_header(std::string_view bytes) {
  constexpr std::string_view word = "content-length:";
  for (std::size_t at = 0; at < bytes.size(); ++at)
    if (bytes.size() - at >= word.size() && equal_words(bytes.substr(at, word.size()), word))
      return at;
  return std::string_view::npos;
}

} // namespace

std::optional<MessageReader::Event> MessageReader::next() {
  for (;;) {
    if (to_skip_ > 0) {
      const auto skipped = std::min(to_skip_, buffer_.size());
      buffer_.erase(0, skipped);
      to_skip_ -= skipped;
      if (to_skip_ > 0)
        return std::nullopt;
    }
    if (!length_) {
      if (auto fault = read_header())
        return fault;
      if (!length_)
        return std::nullopt;
    }
    if (buffer_.size() < *length_)
      return std::nullopt;
    Event event{false, buffer_.substr(0, *length_)};
    buffer_.erase(0, *length_);
    length_.reset();
    return event;
  }
}

/// Skips bytes that may belong to a body of unknown length.
void MessageReader::skip_to_header() {
  constexpr std::size_t shorter_than_the_word = 14;
  const auto at = next_header(buffer_);
  if (at == std::string::npos) {
    buffer_.erase(0, buffer_.size() - std::min(buffer_.size(), shorter_than_the_word));
    return;
  }
  buffer_.erase(0, at);
  lost_ = false;
}

/// Reads a complete header: sets `length_`, or returns what is wrong with it.
std::optional<MessageReader::Event> MessageReader::read_header() {
  if (lost_)
    skip_to_header();
  if (lost_)
    return std::nullopt;
  auto end = buffer_.find("\r\n\r\n");
  std::size_t size = 4;
  if (const auto bare = buffer_.find("\n\n"); bare < end) {
    end = bare;
    size = 2;
  }
  if (end == std::string::npos) {
    if (buffer_.size() <= max_header)
      return std::nullopt;
    lost_ = true;
    return Event{true, "a header without an end"};
  }
  const auto header = std::string_view(buffer_).substr(0, end);
  const auto length = body_length(header);
  if (length.said != BodyLength::Found::Length) {
    // The rest of a body longer than announced may precede the next header.
    const auto other = next_header(header.substr(std::min<std::size_t>(1, header.size())));
    buffer_.erase(0, other == std::string_view::npos ? end + size : other + 1);
    lost_ = true;
    return Event{true, "a header without a usable Content-Length"};
  }
  buffer_.erase(0, end + size);
  if (length.bytes > max_message) {
    to_skip_ = length.bytes;
    return Event{
        true, fmt::format("a message of {} bytes; at most {} are read", length.bytes, max_message)};
  }
  length_ = length.bytes;
  return std::nullopt;
}

std::string frame(std::string_view message) {
  return fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
}

} // namespace orb::editor
