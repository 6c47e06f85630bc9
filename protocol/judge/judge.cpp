#include "protocol/judge/judge.h"

#include "protocol/describe_v2.h"
#include "protocol/judge/rules.h"
#include "protocol/judge/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::protocol {
namespace {

using spec::Packets;

/// Most places kept per mistake.
constexpr std::size_t most_places = 3;
/// How much too early a packet sent in time may arrive after a late one.
constexpr Duration link_delay = 20ms;
/// A question is asked often if repeated this many times at no longer intervals.
constexpr std::size_t often = 5;
constexpr Duration seldom = 1s;
/// An answer that has not come by then counts as lost: no client waits longer. Source: UPLOAD.
constexpr Duration longest_wait = 2s;

std::int64_t in_ms(Duration duration) {
  return duration / 1ms;
}

/// Returns the shortest interval between commands for the robot, or for any robot with these
/// packets.
Duration interval_of(std::optional<spec::Robot> kind, Packets packets) {
  if (kind)
    return spec::info(*kind).interval;
  auto least = Duration::max();
  for (const auto& robot : spec::robots)
    if (robot.packets == packets)
      least = std::min<Duration>(least, robot.interval);
  return least;
}

bool is(const PacketV2& packet, spec::V2Message message) {
  return (packet.did << 8 | packet.cid) == static_cast<int>(message);
}

/// Returns the command that stops a robot, as people write it.
std::string stop_of(Packets packets) {
  return packets == Packets::V1 ? "roll 0 0 0" : "drive-with-heading 0 0 0";
}

} // namespace

bool Judgement::is_clean() const {
  return std::all_of(mistakes.begin(), mistakes.end(),
                     [](const Mistake& one) { return one.severity == Severity::Info; });
}

ClientJudge::ClientJudge(const Conversation& about, Packets packets, Awake awake)
    : packets_(packets), awake_(awake) {
  about_.kind = about.kind;
  about_.carrier = about.carrier;
  about_.has_start = about.has_start;
  about_.has_end = about.has_end;
  about_.has_lock = about.has_lock;
  if (about.kind && about.carrier == Carrier::Gatt)
    about_.has_lock = !spec::is_open(spec::info(*about.kind).ble);
}

Occurrence ClientJudge::here(ByteView raw) const {
  return {line_.when, line_.number, {raw.begin(), raw.end()}};
}

void ClientJudge::add(const Rule& rule, Severity severity, Message message, Message help,
                      Occurrence place) {
  auto& all = judgement_.mistakes;
  auto found = std::find_if(all.begin(), all.end(), [&](const Mistake& one) {
    return one.rule == &rule && one.message == message;
  });
  if (found == all.end())
    found = all.insert(all.end(), {&rule, severity, std::move(message), std::move(help), 0, {}});
  found->severity = std::max(found->severity, severity);
  ++found->count;
  if (found->places.size() < most_places)
    found->places.push_back(std::move(place));
}

void ClientJudge::take(const LogLine& line) {
  const auto direction = line.direction.value_or(Direction::ToBall);
  const bool out = direction == Direction::ToBall;
  // The ball drops an incomplete packet after a while.
  if (out && to_ball_.pending() && line.at && client_.at &&
      *line.at - *client_.at > spec::fragment_timeout) {
    line_ = client_;
    to_ball_.expire();
    take_v1(direction);
  }
  line_.when = line.when;
  line_.at = line.at;
  line_.number = line.number;
  if (line.greets) {
    is_greeted_ = is_greeted_ || spec::is_greeting(as_text(line.bytes));
    return;
  }
  robot_spoke_ = robot_spoke_ || !out;
  if (out)
    client_ = line_;
  if (packets_ == Packets::V1) {
    (out ? to_ball_ : from_ball_).feed(line.bytes);
    take_v1(direction);
  } else {
    (out ? to_ball_v2_ : from_ball_v2_).feed(line.bytes);
    take_v2(direction);
  }
}

void ClientJudge::take_v1(Direction direction) {
  const bool out = direction == Direction::ToBall;
  auto& decoder = out ? to_ball_ : from_ball_;
  while (const auto item = decoder.next()) {
    switch (item->kind) {
    case Item::Kind::Command: obey(order_of(*item), refusal_of(*item), item->raw); break;
    case Item::Kind::Response: hear(reply_of(*item), item->raw); break;
    case Item::Kind::BadChecksum:
      if (out) {
        const auto covered =
            item->raw.subspan(spec::sop_size).first(item->raw.size() - spec::sop_size - 1);
        damaged(order_of(*item), item->raw.back(), checksum(covered), item->raw);
      }
      break;
    case Item::Kind::Noise:
      if (out)
        noise(item->raw);
      break;
    case Item::Kind::Fragment:
      if (out) {
        add(rules::WireFraming, Severity::Error, texts::Unfinished(), texts::CountsData(),
            here(item->raw));
        seen_ = item->raw.size() - 1;
      }
      break;
    case Item::Kind::Async: break;
    }
  }
}

void ClientJudge::take_v2(Direction direction) {
  const bool out = direction == Direction::ToBall;
  auto& decoder = out ? to_ball_v2_ : from_ball_v2_;
  while (const auto item = decoder.next()) {
    const auto& packet = item->packet;
    switch (item->kind) {
    case ItemV2::Kind::Packet:
      if (out)
        obey(order_of(packet), refusal_of(packet, about_.kind), item->raw);
      else if (spec::has(packet.flags, spec::V2Flag::Response))
        hear(reply_of(packet), item->raw);
      else if (is(packet, spec::V2Message::DidSleep))
        sleep();
      break;
    case ItemV2::Kind::BadChecksum:
      if (out)
        damaged(order_of(packet), item->checksum, item->right_checksum, item->raw);
      break;
    case ItemV2::Kind::Noise:
      if (out)
        noise(item->raw);
      break;
    case ItemV2::Kind::Incomplete:
      if (out)
        add(rules::WireFraming, Severity::Error, texts::Unfinished(), texts::EndsPacket("D8"),
            here(item->raw));
      break;
    }
  }
}

void ClientJudge::damaged(Order order, std::uint8_t wrong, std::uint8_t right, ByteView raw) {
  add(rules::WireChecksum, Severity::Error, texts::WrongChecksum(order.name),
      texts::RightChecksum(fmt::format("{:02X}", right), fmt::format("{:02X}", wrong),
                           packets_ == Packets::V1 ? "DID" : "FLAGS"),
      here(raw));
  ++judgement_.commands;
  open_.push_back({std::move(order), here(raw), line_.at, false, true});
  if (packets_ == Packets::V1)
    seen_ = raw.size() - 1; // the decoder reports its bytes again
}

void ClientJudge::noise(ByteView raw) {
  const auto seen = std::min(seen_, raw.size());
  seen_ -= seen;
  raw = raw.subspan(seen);
  const auto of_others =
      packets_ == Packets::V1 ? understood_as_v2(raw) : understood(raw, Direction::ToBall);
  // A client that does not yet know the robot's packets tries both kinds.
  const bool is_trial = judgement_.commands == 0 && of_others == raw.size();
  if (raw.empty() || is_trial)
    return;
  if (packets_ == Packets::V2 && raw.front() == spec::v2_start)
    add(rules::WireFraming, Severity::Error, texts::WrongEscape(), texts::EscapeThese(), here(raw));
  else
    add(rules::WireFraming, Severity::Error, texts::NoPacket(),
        texts::PacketBegins(packets_ == Packets::V1 ? "FF FF" : "8D"), here(raw));
}

// Commands.

void ClientJudge::obey(const Order& order, const std::optional<Refusal>& silent, ByteView raw) {
  const auto place = here(raw);
  ++judgement_.commands;
  seen_ = 0;
  check_greeting(order, place);
  check_sequence(order, place);
  check_pace(order, place);
  check_awake(order, place);
  if (silent && order.answers == Answers::Never)
    refuse(order, *silent, place, Severity::Warning);
  if (!silent)
    follow(order, place);
  if (!order.instead.empty()) {
    auto& asked = asked_[order.name];
    if (asked.count++ == 0)
      asked = {1, line_.at, line_.at, order.instead, place};
    asked.last = line_.at;
  }
  last_ = Sent{line_.at, order.key, false};
  if (order.answers != Answers::Never)
    open_.push_back({order, place, line_.at});
}

void ClientJudge::check_greeting(const Order& order, const Occurrence& place) {
  if (is_greeted_ || !about_.has_lock || !about_.has_start || judgement_.commands > 1)
    return;
  const bool deaf = packets_ == Packets::V1; // the newer ones obey, for ten seconds
  const auto packets = deaf ? spec::BleProtocol::V1 : spec::BleProtocol::V2;
  for (const auto& row : spec::ble_greeting)
    if (spec::protocol_of(row.characteristic) == packets && spec::is_greeting(row.bytes))
      add(rules::GreetingMissing, deaf ? Severity::Error : Severity::Warning,
          texts::NotGreeted(order.name),
          texts::GreetFirst(row.bytes, spec::info(row.characteristic).uuid), place);
}

void ClientJudge::check_sequence(const Order& order, const Occurrence& place) {
  const bool is_v2 = packets_ == Packets::V2;
  const auto help = texts::CountUp(is_v2 ? int{spec::v2_last_seq} : int{UINT8_MAX});
  if (is_v2 && order.seq == spec::v2_message_seq)
    add(rules::SequenceReused, Severity::Error, texts::SequenceOfMessages(order.name), help, place);
  if (order.answers == Answers::Never)
    return;
  const auto same = std::find_if(open_.begin(), open_.end(),
                                 [&](const Open& open) { return open.order.key == order.key; });
  if (same == open_.end())
    return;
  // A command that was passed over or is old counts as lost: its number may be reused.
  const bool is_old = same->at && line_.at && *line_.at - *same->at > longest_wait;
  const bool is_lost = same->was_passed || is_old;
  if (same->was_damaged || same->order.answers == Answers::Errors)
    ; // no answer was due
  else if (!is_lost)
    add(rules::SequenceReused, Severity::Error, texts::SequenceIsOpen(order.name), help, place);
  else
    add(rules::AnswerUnmatched, Severity::Warning, texts::NeverAnswered(same->order.name),
        texts::SendAgain(), same->place);
  open_.erase(same);
}

void ClientJudge::check_pace(const Order& order, const Occurrence& place) {
  if (!last_ || last_->is_answered || !last_->at || !line_.at ||
      about_.carrier == Carrier::Rfcomm) // it slows clients down by itself
    return;
  const auto gap = *line_.at - *last_->at;
  const auto interval = interval_of(about_.kind, packets_);
  if (gap >= Duration{} && gap < interval - link_delay)
    add(rules::TooFast, Severity::Warning, texts::FollowsTooSoon(order.name),
        texts::WaitBetween(in_ms(interval)), place);
}

void ClientJudge::check_awake(const Order& order, const Occurrence& place) {
  if (packets_ == Packets::V1 || awake_ != Awake::No || !about_.has_start ||
      order.effect != Effect::Drives)
    return;
  add(rules::NotAwake, was_put_to_sleep_ ? Severity::Error : Severity::Warning,
      texts::AsksSleeper(order.name), texts::WakeFirst(spec::info(spec::V2Command::Wake).name),
      place);
}

/// Updates the assumed state of the robot.
void ClientJudge::follow(const Order& order, const Occurrence& place) {
  switch (order.effect) {
  case Effect::Drives:
    drives_ = Moved{order, place, line_.at};
    stops_.reset(); // it is no longer meant to be stopped
    break;
  case Effect::Stops:
    if (drives_ || stops_)
      stops_ = Moved{order, place, line_.at};
    drives_.reset();
    break;
  case Effect::Wakes: awake_ = Awake::Yes; break;
  case Effect::Sleeps: sleep(); break;
  case Effect::EndsSafely: ends_safely_ = true; break;
  case Effect::None: break;
  }
}

void ClientJudge::sleep() {
  awake_ = Awake::No;
  was_put_to_sleep_ = true;
  drives_.reset();
  stops_.reset();
}

// Answers.

void ClientJudge::hear(const Reply& reply, ByteView raw) {
  ++judgement_.answers;
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const Open& open) { return open.order.key == reply.key; });
  const bool is_of_link = reply.refusal && reply.refusal->why == Refusal::Why::Link;
  if (found == open_.end()) {
    const bool may_be_older = !about_.has_start || judgement_.commands == 0;
    if (!may_be_older && !is_of_link)
      add(rules::AnswerUnmatched, Severity::Warning, texts::AnswerToNothing(),
          texts::CompareSequence(), here(raw));
    return;
  }
  const auto open = std::move(*found);
  for (auto before = open_.begin(); before != found; ++before)
    before->was_passed = true;
  open_.erase(found);
  if (last_ && last_->key == reply.key)
    last_->is_answered = true;
  if (!reply.refusal) {
    if (open.order.effect == Effect::Stops)
      stops_.reset();
    return;
  }
  if (is_of_link)
    return; // reported when it was sent, or the fault of the link
  const bool moved = drives_ && drives_->order.key == open.order.key;
  if (moved && open.order.effect == Effect::Drives)
    drives_.reset();
  refuse(open.order, *reply.refusal, open.place, Severity::Error);
}

void ClientJudge::refuse(const Order& order, const Refusal& refusal, const Occurrence& place,
                         Severity severity) {
  const bool silent = order.answers == Answers::Never;
  switch (refusal.why) {
  case Refusal::Why::Link: break;
  case Refusal::Why::Unknown:
    add(rules::CommandUnknown, severity, texts::Unknown(order.name),
        order.is_known ? texts::ExplainsRobots(order.name) : Message{}, place);
    break;
  case Refusal::Why::Asleep:
    if (awake_ == Awake::No && about_.has_start && order.effect == Effect::Drives) {
      for (auto& mistake : judgement_.mistakes) // reported already, but not with certainty
        if (mistake.rule == &rules::NotAwake && mistake.message == texts::AsksSleeper(order.name))
          mistake.severity = severity;
      break;
    }
    add(rules::NotAwake, severity, texts::AsksSleeper(order.name),
        texts::WakeFirst(spec::info(spec::V2Command::Wake).name), place);
    break;
  case Refusal::Why::Other:
    add(rules::CommandRefused, severity,
        silent ? texts::RefusedInSilence(order.name, refusal.error)
               : texts::Refused(order.name, refusal.error),
        order.is_known ? texts::ExplainsCommand(order.name) : Message{}, place);
    break;
  }
}

// The end.

Judgement ClientJudge::end(Ending ending) {
  const auto last = std::exchange(line_, client_);
  to_ball_.expire();
  to_ball_v2_.expire();
  if (packets_ == Packets::V1)
    take_v1(Direction::ToBall);
  else
    take_v2(Direction::ToBall);
  line_ = last;
  judge_end(ending);
  auto& all = judgement_.mistakes;
  // The log contains only the client's side, so nothing is known about open requests.
  if (!robot_spoke_)
    std::erase_if(all, [](const Mistake& one) {
      return one.message.text() == &texts::SequenceIsOpen ||
             one.message.text() == &texts::NeverAnswered;
    });
  std::stable_sort(all.begin(), all.end(),
                   [](const Mistake& a, const Mistake& b) { return a.severity > b.severity; });
  return std::move(judgement_);
}

void ClientJudge::judge_end(Ending ending) {
  for (const auto& open : open_)
    if (open.was_passed && !open.was_damaged && open.order.answers == Answers::Always &&
        open.order.effect != Effect::Stops)
      add(rules::AnswerUnmatched, Severity::Warning, texts::NeverAnswered(open.order.name),
          texts::SendAgain(), open.place);
  for (const auto& [name, asked] : asked_) {
    if (asked.count < often || !asked.first || !asked.last)
      continue;
    const auto apart = (*asked.last - *asked.first) / static_cast<int>(asked.count - 1);
    if (apart <= seldom)
      add(rules::Polling, Severity::Info, texts::AskedOften(name, asked.count, in_ms(apart)),
          texts::LetItSay(asked.instead), asked.place);
  }
  if (ending == Ending::Unseen)
    return;
  if (stops_) {
    const auto& order = stops_->order;
    const bool asks = order.answers != Answers::Never;
    if (robot_spoke_ || !asks)
      add(rules::StopUnsure, Severity::Warning,
          asks ? texts::StopNotAnswered(order.name) : texts::StopAsksNothing(order.name),
          texts::RepeatStop(), stops_->place);
  }
  if (!drives_ || ends_safely_)
    return;
  const bool is_v2 = packets_ == Packets::V2;
  const bool has_ended =
      is_v2 && (!drives_->at || !line_.at || *line_.at - *drives_->at >= spec::v2_drive_timeout);
  if (!has_ended)
    add(rules::LeftDriving, is_v2 ? Severity::Warning : Severity::Error,
        texts::StillDrives(drives_->order.name), texts::StopBefore(stop_of(packets_)),
        drives_->place);
}

Judgement judge(const Conversation& conversation, Packets packets, ClientJudge::Awake awake) {
  ClientJudge judge(conversation, packets, awake);
  for (const auto& line : conversation.lines)
    judge.take(line);
  return judge.end(conversation.has_end ? Ending::Over : Ending::Unseen);
}

} // namespace orb::protocol
