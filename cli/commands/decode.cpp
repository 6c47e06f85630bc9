#include "cli/commands/commands.h"
#include "cli/context/json.h"
#include "cli/model/checks.h"
#include "disk/disk.h"

#include "protocol/describe.h"
#include "protocol/packet_v2.h"
#include "protocol/recording.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <vector>

namespace orb::cli {
namespace {

using protocol::Direction;
using protocol::Item;

struct DecodeArguments {
  std::vector<std::string> words;
  bool v2 = false;
  std::string from = "auto";
  std::string format = "text";
};

/// A stream of one direction, printed as its packets become whole.
class Printer {
public:
  Printer(Direction direction, std::string prefix, bool as_json, protocol::Describer& describer)
      : decoder_(direction), from_(direction == Direction::ToBall ? "client" : "ball"),
        prefix_(std::move(prefix)), as_json_(as_json), describer_(describer) {}

  void feed(ByteView bytes) {
    decoder_.feed(bytes);
    drain();
  }
  void finish() {
    decoder_.expire();
    drain();
  }

private:
  void drain() {
    while (auto item = decoder_.next()) {
      // The bytes of a damaged packet are scanned again; they are shown once.
      const auto seen = std::min(shown_, item->raw.size());
      shown_ -= seen;
      if (item->kind == Item::Kind::Noise) {
        item->raw = item->raw.subspan(seen);
        if (item->raw.empty())
          continue;
      }
      print(*item);
      if (item->kind == Item::Kind::BadChecksum || item->kind == Item::Kind::Fragment)
        shown_ = item->raw.size() - 1;
    }
  }

  void print(const Item& item) {
    if (!as_json_)
      return print_out(fmt::format("{}{}\n", prefix_, describer_.describe(item)));
    Json json{{"from", from_}};
    json.update(packet_json(describer_, item));
    print_json(json);
  }

  protocol::Decoder decoder_;
  std::string_view from_;
  std::string prefix_;
  bool as_json_;
  protocol::Describer& describer_;
  std::size_t shown_ = 0; ///< how many of the bytes to come have been printed already
};

bool is_text(std::string_view content) {
  return std::ranges::all_of(content, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isprint(byte) != 0 || std::isspace(byte) != 0;
  });
}

/// What is to be decoded: a recording, hex text or the bytes themselves.
struct Input {
  std::vector<protocol::RecordedPiece> recording; ///< empty: the bytes count
  Bytes bytes;
};

Input take_apart(std::string_view content) {
  if (is_text(content)) {
    if (auto recording = protocol::parse_recording(content); recording && !recording->empty())
      return {*std::move(recording), {}};
    if (auto hex = from_hex(content))
      return {{}, *std::move(hex)};
  }
  const auto bytes = as_bytes(content);
  return {{}, {bytes.begin(), bytes.end()}};
}

std::string_view kind_name(const protocol::ItemV2& item) {
  using Kind = protocol::ItemV2::Kind;
  switch (item.kind) {
  case Kind::Packet:
    return (item.packet.flags & static_cast<std::uint8_t>(spec::V2Flag::Response)) != 0 ? "response"
                                                                                        : "command";
  case Kind::Noise: return "noise";
  case Kind::BadChecksum: return "bad-checksum";
  case Kind::Incomplete: return "incomplete";
  }
  return "";
}

Json packet_json(const protocol::ItemV2& item) {
  Json json{{"kind", kind_name(item)}};
  if (item.kind == protocol::ItemV2::Kind::Packet) {
    const auto& packet = item.packet;
    json.update(
        {{"flags", packet.flags}, {"did", packet.did}, {"cid", packet.cid}, {"seq", packet.seq}});
    if (json["kind"] == "response")
      json["error"] = packet.error;
    json["data"] = to_hex(packet.data);
  }
  json["raw"] = to_hex(item.raw);
  return json;
}

void print_v2(const Input& input, bool as_json) {
  // Both directions share one format; the flags tell answers from commands.
  const auto print = [&](protocol::DecoderV2& decoder, std::string_view prefix) {
    while (const auto item = decoder.next())
      if (as_json)
        print_json(packet_json(*item));
      else
        print_out(fmt::format("{}{}\n", prefix, describe(*item)));
  };
  protocol::DecoderV2 to_ball, from_ball;
  if (input.recording.empty()) {
    to_ball.feed(input.bytes);
    to_ball.expire();
    print(to_ball, "");
    return;
  }
  for (const auto& piece : input.recording) {
    const auto out = piece.direction == Direction::ToBall;
    auto& decoder = out ? to_ball : from_ball;
    decoder.feed(piece.bytes);
    print(decoder, out ? "> " : "< ");
  }
  to_ball.expire();
  print(to_ball, "> ");
  from_ball.expire();
  print(from_ball, "< ");
}

/// How many of the bytes are part of a whole packet when they travel so.
std::size_t understood(ByteView bytes, Direction direction) {
  protocol::Decoder decoder(direction);
  decoder.feed(bytes);
  std::size_t count = 0;
  while (const auto item = decoder.next())
    if (item->kind == Item::Kind::Command || item->kind == Item::Kind::Response ||
        item->kind == Item::Kind::Async)
      count += item->raw.size();
  return count;
}

/// Who sent the bytes: whoever's packets have right checksums, the client where that does not tell.
Direction direction_of(const DecodeArguments& arguments, ByteView bytes) {
  const bool ball = arguments.from == "ball" ||
                    (arguments.from == "auto" &&
                     understood(bytes, Direction::FromBall) > understood(bytes, Direction::ToBall));
  return ball ? Direction::FromBall : Direction::ToBall;
}

void print_v1(const Input& input, const DecodeArguments& arguments) {
  protocol::Describer describer;
  const bool as_json = arguments.format == "json";
  if (input.recording.empty()) {
    Printer printer(direction_of(arguments, input.bytes), "", as_json, describer);
    printer.feed(input.bytes);
    printer.finish();
    return;
  }
  Printer to_ball(Direction::ToBall, "> ", as_json, describer);
  Printer from_ball(Direction::FromBall, "< ", as_json, describer);
  for (const auto& piece : input.recording)
    (piece.direction == Direction::ToBall ? to_ball : from_ball).feed(piece.bytes);
  to_ball.finish();
  from_ball.finish();
}

void decode(Context& context, const DecodeArguments& arguments) {
  Input input;
  const auto& words = arguments.words;
  std::error_code ignored;
  if (words.empty() ||
      (words.size() == 1 &&
       (words[0] == "-" || std::filesystem::exists(disk::as_path(words[0]), ignored)))) {
    const auto content = disk::read(words.empty() ? "-" : words[0]);
    if (!content)
      return fail(context, {ExitCode::File, content.error().message});
    input = take_apart(*content);
  } else {
    for (const auto& word : words) {
      const auto bytes = from_hex(word);
      if (!bytes) {
        return fail(context, {ExitCode::Usage,
                              fmt::format("`{}` is neither a file nor hex bytes; write bytes as in "
                                          "`orb decode FFFF00015201AB`",
                                          word)});
      }
      input.bytes.insert(input.bytes.end(), bytes->begin(), bytes->end());
    }
  }
  if (arguments.v2)
    print_v2(input, arguments.format == "json");
  else
    print_v1(input, arguments);
}

} // namespace

void add_decode(const Command& orb, Context& context) {
  const auto command = orb.add_command("decode", "explain packets in words",
                                       "orb decode FF FF 00 01 52 01 AB\n"
                                       "orb decode FFFE08000748656C6C6F0AF2\n"
                                       "orb decode session.txt\norb decode --v2 8D0A11061FBFD8");
  auto arguments = std::make_shared<DecodeArguments>();
  command.add_option(
      "FILE", arguments->words,
      "hex bytes, or a file of hex, raw bytes or a recording; stdin if - or omitted");
  command.add_flag("--v2", arguments->v2, "packets of the newer robots");
  add_format_option(command, arguments->format);
  command
      .add_option("--from", arguments->from,
                  "which side sent the bytes; auto: the one whose checksums match; a recording "
                  "names its side itself")
      .check(one_of({"auto", "client", "ball"}))
      .show_default();
  command.callback([&context, arguments] { decode(context, *arguments); });
}

} // namespace orb::cli
