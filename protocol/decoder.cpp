#include "protocol/decoder.h"

#include <algorithm>
#include <cstring>

namespace orb::protocol {
namespace {

using spec::async_header_size;
using spec::command_header_size;
using spec::response_header_size;

/// Returns the position of the next SOP1 at or after `from`; the size if there is none.
std::size_t find_start(ByteView bytes, std::size_t from) {
  if (from < bytes.size() && bytes[from] == spec::sop1)
    return from;
  const auto left = bytes.size() - from;
  const void* found = left == 0 ? nullptr : std::memchr(bytes.data() + from, spec::sop1, left);
  return found == nullptr
             ? bytes.size()
             : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - bytes.data());
}

Item whole_packet(Item::Kind kind, ByteView data, ByteView packet) {
  Item item;
  item.kind = kind;
  item.flags = packet[1]; // SOP2
  item.data = data;
  item.raw = packet;
  return item;
}

} // namespace

Item item_of(const Command& command, ByteView packet) {
  auto item = whole_packet(Item::Kind::Command, command.data, packet);
  item.did = command.did;
  item.cid = command.cid;
  item.seq = command.seq;
  return item;
}

Item item_of(const Response& response, ByteView packet) {
  auto item = whole_packet(Item::Kind::Response, response.data, packet);
  item.code = response.code;
  item.seq = response.seq;
  return item;
}

Item item_of(const Async& message, ByteView packet) {
  auto item = whole_packet(Item::Kind::Async, message.data, packet);
  item.code = message.id;
  return item;
}

void Decoder::feed(ByteView bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  at_ = 0;
}

void Decoder::reset() {
  bytes_.clear();
  at_ = 0;
  expiry_ = Expiry::No;
}

std::optional<Item> Decoder::next() {
  const ByteView window = bytes_;
  Item item;
  for (auto start = at_;;) {
    start = find_start(window, start);
    const auto at_end = start == window.size();
    const auto found = at_end ? Match::No : match(window.subspan(start), item);
    const auto given_up = found == Match::Incomplete && expiry_ == Expiry::Reported;
    if (!at_end && (found == Match::No || given_up)) {
      ++start; // no packet begins at this SOP1
      continue;
    }
    if (start > at_) {
      item = {};
      item.raw = window.subspan(at_, start - at_);
      at_ = start;
      return item;
    }
    switch (found) {
    case Match::Whole: at_ += item.raw.size(); return item;
    case Match::Damaged: ++at_; return item;
    case Match::Incomplete:
      if (expiry_ == Expiry::No)
        return std::nullopt;
      expiry_ = Expiry::Reported;
      item.kind = Item::Kind::Fragment;
      item.raw = window.subspan(at_);
      ++at_;
      return item;
    case Match::No: // the end of the window
      expiry_ = Expiry::No;
      return std::nullopt;
    }
  }
}

Decoder::Match Decoder::match(ByteView bytes, Item& item) const {
  return direction_ == Direction::ToBall ? match_command(bytes, item) : match_answer(bytes, item);
}

namespace {

/// Sets payload and raw bytes. Returns true if the checksum is right.
bool complete(ByteView bytes, std::size_t header, std::size_t payload, Item& item) {
  item.raw = bytes.first(header + payload + 1);
  item.data = bytes.subspan(header, payload);
  const auto covered = bytes.subspan(spec::sop_size, header + payload - spec::sop_size);
  if (checksum(covered) == item.raw.back())
    return true;
  item.kind = Item::Kind::BadChecksum;
  return false;
}

} // namespace

/// Returns true if the first SOP1 is a stray byte before a whole packet, as in FF FF FF 00 01 ….
/// `bytes` end before the packet that would begin here. The packet that is complete first wins, as
/// if bytes arrived one by one, so the result does not depend on how the stream is cut.
bool Decoder::is_stray(ByteView bytes) const {
  const auto other = std::find_if(bytes.begin(), bytes.end(),
                                  [](std::uint8_t byte) { return byte != spec::sop1; });
  const auto run = static_cast<std::size_t>(other - bytes.begin());
  if (run < spec::sop_size)
    return false;
  Item after;
  // SOP1 and SOP2 of the packet are the last two bytes of the run, or SOP2 is a different byte
  // after it.
  for (const auto start : {run - 2, run - 1})
    if (start > 0 && match_command(bytes.subspan(start), after) == Match::Whole)
      return true;
  return false;
}

Decoder::Match Decoder::match_command(ByteView bytes, Item& item) const {
  item = {};
  if (bytes.size() >= spec::sop_size && !spec::is_sop2(bytes[1]))
    return Match::No;
  if (bytes.size() >= command_header_size - 1) {
    item.flags = bytes[1];
    item.did = bytes[2];
    item.cid = bytes[3];
    item.seq = bytes[4];
  }
  if (bytes.size() < command_header_size)
    return Match::Incomplete;
  const auto dlen = bytes[command_header_size - 1];
  if (dlen == 0)
    return Match::No;
  const auto fixed = dlen == spec::dlen_long ? spec::long_payload(item.did, item.cid) : 0;
  const auto payload = fixed != 0 ? fixed : dlen - std::size_t{1};
  const auto size = command_header_size + payload + 1;
  if (is_stray(bytes.first(std::min(bytes.size(), size - 1))))
    return Match::No;
  if (bytes.size() < size)
    return Match::Incomplete;
  item.kind = Item::Kind::Command;
  return complete(bytes, command_header_size, payload, item) ? Match::Whole : Match::Damaged;
}

Decoder::Match Decoder::match_answer(ByteView bytes, Item& item) const {
  item = {};
  if (bytes.size() < spec::sop_size)
    return Match::Incomplete;
  const auto is_async = bytes[1] == spec::sop2_async;
  if (!is_async && bytes[1] != spec::sop2_response)
    return Match::No;
  item.flags = bytes[1];
  const auto header = is_async ? async_header_size : response_header_size;
  if (bytes.size() < header)
    return Match::Incomplete;
  item.code = bytes[2];
  item.seq = is_async ? std::uint8_t{0} : bytes[3];
  const auto length = is_async ? read_u16(bytes, async_header_size - 2)
                               : std::size_t{bytes[response_header_size - 1]};
  if (length == 0 || length > spec::max_async_payload + 1)
    return Match::No;
  if (bytes.size() < header + length)
    return Match::Incomplete;
  item.kind = is_async ? Item::Kind::Async : Item::Kind::Response;
  return complete(bytes, header, length - 1, item) ? Match::Whole : Match::Damaged;
}

std::size_t understood(ByteView bytes, Direction direction) {
  Decoder decoder(direction);
  decoder.feed(bytes);
  std::size_t count = 0;
  while (const auto item = decoder.next())
    if (item->kind == Item::Kind::Command || item->kind == Item::Kind::Response ||
        item->kind == Item::Kind::Async)
      count += item->raw.size();
  return count;
}

} // namespace orb::protocol
