#include "uploader/session.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace orb::uploader {
namespace {

using protocol::Item;
using spec::ApiCommand;
using spec::Retry;

constexpr std::size_t inbox_most = 4096; // messages; a minute of the fastest sensor stream
constexpr auto dlen_at = spec::command_header_size - 1;

tl::unexpected<NoAnswer> link_failed(const protocol::LinkError& error) {
  return tl::unexpected(NoAnswer{NoAnswer::Kind::Link, error});
}

/// Returns the least and greatest payload of an answer "OK". A command whose answer has no fields
/// gets exactly none, which tells a Simple Response from the echo of a command; records may grow.
std::pair<std::size_t, std::size_t> answer_sizes(ApiCommand command) {
  std::size_t least = 0;
  const auto fields = spec::answer(command);
  for (const auto& field : fields)
    if (field.presence == spec::Presence::Required)
      least += spec::field_size(field.type);
  return {least, fields.empty() ? 0 : spec::max_payload};
}

} // namespace

bool survives_shorter(const protocol::Command& command) {
  const auto packet = encode(command);
  const auto dlen = packet[dlen_at];
  auto sum = 0U; // of DID, CID and SEQ
  for (auto at = spec::sop_size; at < dlen_at; ++at)
    sum += packet[at];
  for (auto bit = 1U; bit <= dlen; bit <<= 1) {
    const auto shorter = dlen ^ bit;
    if (shorter >= dlen || shorter == 0)
      continue;
    auto total = sum + shorter;
    const auto checksum_at = dlen_at + shorter;
    for (auto at = dlen_at + 1; at < checksum_at; ++at)
      total += packet[at];
    if (static_cast<std::uint8_t>(~total) == packet[checksum_at])
      return true;
  }
  return false;
}

Session::Session(protocol::Transport& transport, const Budgets& budgets, std::uint8_t first_seq)
    : transport_(transport), budgets_(budgets), next_seq_(first_seq) {}

tl::expected<void, NoAnswer> Session::drain() {
  const auto until = now() + budgets_.drain;
  while (now() < until) {
    const auto read = transport_.read(until);
    if (!read)
      return link_failed(read.error());
    counts_.bytes_in += read->size();
    counts_.noise_in += read->size();
  }
  decoder_.reset();
  return {};
}

tl::expected<void, NoAnswer> Session::send(ApiCommand command, const Bytes& data) {
  auto packet = protocol::make_command(command, data, next_seq_);
  while (survives_shorter(packet)) { // never true of a ping, and at most for 8 sequence numbers
    const auto kept = also_;
    also_.reset();
    const auto moved = exchange(ApiCommand::Ping, {}); // a lost ping costs only time
    also_ = kept;
    if (!moved && moved.error().kind == NoAnswer::Kind::Link)
      return tl::unexpected(moved.error());
    packet.seq = next_seq_;
  }
  current_ = next_seq_++;
  std::tie(least_payload_, most_payload_) = answer_sizes(command);
  once_ = spec::info(command).idempotent == spec::Idempotent::No;
  answer_.reset();
  answered_.reset(*current_);
  last_sent_ = encode(packet);
  ++counts_.packets_out;
  counts_.bytes_out += last_sent_.size();
  if (const auto written = transport_.write(last_sent_); !written) {
    current_.reset();
    return link_failed(written.error());
  }
  return {};
}

bool Session::awaited(const Item& item) const {
  const auto ok = item.code == static_cast<std::uint8_t>(spec::ResponseCode::Ok);
  if (ok && (item.data.size() < least_payload_ || item.data.size() > most_payload_))
    return false;
  if (item.seq == current_)
    return true;
  // The answer to an earlier attempt of the same harmless command counts, too.
  return ok && also_.test(item.seq);
}

void Session::take_in(const Item& item) {
  switch (item.kind) {
  case Item::Kind::Async:
    if (inbox_.size() == inbox_most) {
      inbox_.pop_front();
      ++counts_.messages_dropped;
    }
    inbox_.push_back(item.async());
    return;
  case Item::Kind::Response:
    if (current_ && !answer_ && awaited(item)) {
      answer_ = item.response();
      answered_.set(item.seq, once_);
    } else if (answered_.test(item.seq)) {
      duplicate_seen_ = true;
    } else {
      ++counts_.foreign_answers;
    }
    return;
  case Item::Kind::Noise: counts_.noise_in += item.raw.size(); return;
  case Item::Kind::BadChecksum:
  case Item::Kind::Fragment: ++counts_.damaged_in; return;
  case Item::Kind::Command: return; // not in this direction
  }
}

/// Takes all items at once, because the bytes live no longer than this call.
void Session::take_in() {
  while (const auto item = decoder_.next())
    take_in(*item);
}

tl::expected<std::optional<protocol::Response>, NoAnswer> Session::receive(Instant deadline) {
  while (!answer_) {
    const auto read = transport_.read(deadline);
    if (!read) {
      current_.reset();
      return link_failed(read.error());
    }
    counts_.bytes_in += read->size();
    if (!last_sent_.empty() && std::search(read->begin(), read->end(), last_sent_.begin(),
                                           last_sent_.end()) != read->end())
      ++counts_.echoes;
    decoder_.feed(*read);
    take_in();
    if (!answer_ && now() >= deadline) {
      // A damaged, apparently longer packet may hide the answer.
      decoder_.expire();
      take_in();
      break;
    }
  }
  current_.reset();
  return std::exchange(answer_, std::nullopt);
}

tl::expected<protocol::Response, NoAnswer> Session::exchange(ApiCommand command,
                                                             const Bytes& data) {
  if (const auto sent = send(command, data); !sent)
    return tl::unexpected(sent.error());
  auto received = receive(now() + budgets_.answer);
  if (!received)
    return tl::unexpected(received.error());
  if (!*received)
    return tl::unexpected(NoAnswer{});
  if (spec::retry_of((*received)->code) != Retry::SameAgain)
    ++counts_.arrived;
  return std::move(**received);
}

tl::expected<protocol::Response, NoAnswer> Session::ask(ApiCommand command, const Bytes& data) {
  tl::expected<protocol::Response, NoAnswer> last = tl::unexpected(NoAnswer{});
  also_.reset();
  for (int sending = 1; sending <= budgets_.sends; ++sending) {
    if (sending > 1)
      if (const auto waited = listen(now() + budgets_.backoff(sending - 1)); !waited)
        return tl::unexpected(waited.error());
    const auto answer = exchange(command, data);
    if (!answer && answer.error().kind == NoAnswer::Kind::Link) {
      also_.reset();
      return answer;
    }
    if (!answer) {
      also_.set(static_cast<std::uint8_t>(next_seq_ - 1));
      continue;
    }
    if (spec::retry_of(answer->code) != Retry::SameAgain && !is_transient(answer->code)) {
      also_.reset();
      return answer;
    }
    last = answer;
  }
  also_.reset();
  return last; // a ball that says only "damaged" or "busy" has answered after all
}

tl::expected<void, NoAnswer> Session::listen(Instant deadline,
                                             const std::function<bool()>& enough) {
  while (!(enough && enough()) && now() < deadline) {
    const auto read = transport_.read(deadline);
    if (!read)
      return link_failed(read.error());
    if (read->empty() && deadline == never)
      return {}; // a virtual ball at rest
    counts_.bytes_in += read->size();
    decoder_.feed(*read);
    take_in();
  }
  return {};
}

void Session::watch_duplicates() {
  answered_.reset();
  duplicate_seen_ = false;
}

bool is_transient(std::uint8_t code) {
  return code == static_cast<std::uint8_t>(spec::ResponseCode::MemoryBusy);
}

std::string describe_code(std::uint8_t code) {
  const auto* row = spec::find_response(code);
  return row == nullptr ? fmt::format("{:02X}h, an undocumented code", code)
                        : fmt::format("{:02X}h, {}", code, row->meaning);
}

} // namespace orb::uploader
