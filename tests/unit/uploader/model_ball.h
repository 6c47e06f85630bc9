#pragma once

#include "protocol/decoder.h"
#include "protocol/transport.h"
#include "uploader/upload.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace orb::uploader {

/// A minimal ball for uploads, with options to misbehave, and a link that takes `latency` each way.
/// Time is virtual.
class ModelBall : public protocol::Transport {
public:
  /// Returns the reaction to the `n`th command (from 1) instead of obeying it; nullopt to obey.
  using Mischief = std::function<std::optional<Bytes>(int n, const protocol::Command&)>;

  std::array<std::string, 2> areas{"old\n", "old flash\n"};
  std::array<std::size_t, 2> room{4096, 4096};
  std::map<std::uint8_t, Bytes> macros;
  Bytes chunks;
  Bytes stream;
  int executed = 0;
  int power = 2;
  Bytes versions = {0x02, 0x02, 0x03, 0x03, 0x33, 0x21, 0x16, 0x04, 0x01, 0x32};
  std::string print_at_start;
  Duration latency{};
  Mischief mischief;
  int commands_seen = 0;
  Bytes received;

  Instant now() const override { return now_; }

  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    if (broken)
      return tl::unexpected(*broken);
    received.insert(received.end(), bytes.begin(), bytes.end());
    decoder_.feed(bytes);
    while (const auto item = decoder_.next()) {
      if (item->kind == protocol::Item::Kind::BadChecksum)
        answer(spec::ResponseCode::BadChecksum, item->seq);
      if (item->kind == protocol::Item::Kind::Command)
        obey(item->command());
    }
    half_since_ = decoder_.pending() ? now_ : never;
    return {};
  }

  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    if (broken)
      return tl::unexpected(*broken);
    if (half_since_ != never && deadline >= half_since_ + spec::fragment_timeout) {
      now_ = std::max(now_, half_since_ + spec::fragment_timeout);
      half_since_ = never;
      decoder_.expire();
      while (const auto item = decoder_.next())
        if (item->kind == protocol::Item::Kind::Fragment)
          answer(spec::ResponseCode::Fragment, item->seq);
    }
    if (out_.empty()) {
      now_ = std::max(now_, deadline);
      return Bytes{};
    }
    now_ += 2 * latency;
    return std::exchange(out_, {});
  }

  /// Sends unsolicited bytes to the client.
  void send(ByteView bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  std::optional<protocol::LinkError> broken;

  void obey(const protocol::Command& command) {
    ++commands_seen;
    if (mischief)
      if (const auto instead = mischief(commands_seen, command)) {
        send(*instead);
        return;
      }
    carry_out(command);
  }

  void carry_out(const protocol::Command& command) {
    good += counts_per_packet;
    using spec::ApiCommand;
    using spec::ResponseCode;
    const auto which = spec::api_command(command.did, command.cid);
    const auto& data = command.data;
    auto code = ResponseCode::Ok;
    Bytes reply;
    if (which == ApiCommand::GetVersioning)
      reply = versions;
    else if (which == ApiCommand::GetPowerState)
      reply = {1, static_cast<std::uint8_t>(power), 3, 0, 0, 0, 0, 0};
    else if (which == ApiCommand::PerformLevel2Diagnostics)
      code = count(reply);
    else if (which == ApiCommand::EraseOrbbasicStorage)
      areas.at(data.at(0)).clear();
    else if (which == ApiCommand::AppendOrbbasicFragment)
      code = append(data);
    else if (which == ApiCommand::CommitRamToFlash)
      areas[1] = areas[0];
    else if (which == ApiCommand::ExecuteOrbbasicProgram)
      ++executed;
    else if (which == ApiCommand::SaveTemporaryMacro)
      macros[spec::macro_id_temporary] = data;
    else if (which == ApiCommand::ReinitMacroExecutive)
      macros.clear();
    else if (which == ApiCommand::AbortMacro)
      chunks.clear(), reply = {0, 0, 0};
    else if (which == ApiCommand::AppendMacroChunk)
      chunks.insert(chunks.end(), data.begin(), data.end());
    else if (which == ApiCommand::GetMacroStatus)
      reply = {running, 0, 1};
    else if (which == ApiCommand::RunMacro)
      running = data.at(0);
    else if (which == ApiCommand::SaveMacro && data.at(0) == spec::macro_id_stream)
      code = feed_stream(data);
    else if (which == ApiCommand::SaveMacro)
      code = macros.try_emplace(data.at(0), data).second ? ResponseCode::Ok
                                                         : ResponseCode::ExecuteFailed;
    if (command.flags & spec::sop2_answer)
      answer(code, command.seq, reply);
    if (which == ApiCommand::ExecuteOrbbasicProgram && !print_at_start.empty())
      send(encode(protocol::Async{static_cast<std::uint8_t>(spec::AsyncId::BasicPrint),
                                  {print_at_start.begin(), print_at_start.end()}}));
  }

  void answer(spec::ResponseCode code, std::uint8_t seq, const Bytes& data = {}) {
    send(encode(protocol::Response{static_cast<std::uint8_t>(code), seq, data}));
  }

  std::uint8_t running = 0;
  int stream_refusals = 0; ///< how often the next pieces of a stream are refused for lack of room

  /// Level 2 Diagnostics; some balls may refuse it, or count differently.
  bool has_diagnostics = true;
  std::uint32_t counts_per_packet = 1;
  std::uint32_t good = 0;

private:
  spec::ResponseCode count(Bytes& reply) const {
    if (!has_diagnostics)
      return spec::ResponseCode::BadCommand;
    reply = {0, 1, 0};
    append_u32(reply, good);
    reply.resize(
        spec::answer_offset(spec::ApiCommand::PerformLevel2Diagnostics, "gyro adjustments") +
        spec::field_size(spec::FieldType::U32));
    return spec::ResponseCode::Ok;
  }

  spec::ResponseCode append(const Bytes& data) {
    auto& area = areas.at(data.at(0));
    if (area.size() + data.size() - 1 > room.at(data.at(0)))
      return spec::ResponseCode::ExecuteFailed;
    area.append(data.begin() + 1, data.end());
    return spec::ResponseCode::Ok;
  }

  spec::ResponseCode feed_stream(const Bytes& data) {
    if (stream_refusals > 0) {
      --stream_refusals;
      return spec::ResponseCode::ExecuteFailed;
    }
    stream.insert(stream.end(), data.begin() + 2, data.end());
    return spec::ResponseCode::Ok;
  }

  Instant now_{1s};
  Instant half_since_ = never;
  protocol::Decoder decoder_{protocol::Direction::ToBall};
  Bytes out_;
};

/// A program of 60 lines in at most 5 fragments, with its final NUL.
inline Bytes sixty_lines() {
  std::string text;
  for (int line = 10; line <= 600; line += 10)
    text += std::to_string(line) + " print \"line " + std::to_string(line) + "\"\n";
  Bytes image(text.begin(), text.end());
  image.push_back(0);
  return image;
}

inline std::string as_string(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

} // namespace orb::uploader
