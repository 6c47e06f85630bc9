#include "cli/commands/commands.h"
#include "cli/context/json.h"
#include "cli/model/checks.h"
#include "disk/disk.h"

#include "protocol/describe.h"
#include "protocol/describe_v2.h"
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

Json packet_json(const protocol::ItemV2& item, protocol::DescriberV2& describer) {
  Json json{{"kind", kind_name(item)}};
  if (item.kind == protocol::ItemV2::Kind::Packet) {
    const auto& packet = item.packet;
    json.update(
        {{"flags", packet.flags}, {"did", packet.did}, {"cid", packet.cid}, {"seq", packet.seq}});
    if (json["kind"] == "response")
      json["error"] = packet.error;
    json["data"] = to_hex(packet.data);
    if (const auto name = name_of(packet); !name.empty())
      json["name"] = name;
    describer.describe(item); // it hears all
    if (const auto fields = describer.fields_of(packet); !fields.empty())
      json["meaning"] = fields;
  }
  json["raw"] = to_hex(item.raw);
  return json;
}

void print_v2(const Input& input, bool as_json) {
  protocol::DescriberV2 describer;
  // Both directions share one format; the flags tell answers from commands.
  const auto print = [&](protocol::DecoderV2& decoder, std::string_view prefix) {
    while (const auto item = decoder.next())
      if (as_json)
        print_json(packet_json(*item, describer));
      else
        print_out(fmt::format("{}{}\n", prefix, describer.describe(*item)));
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

std::size_t understood_as_v2(ByteView bytes) {
  protocol::DecoderV2 decoder;
  decoder.feed(bytes);
  std::size_t count = 0;
  while (const auto item = decoder.next())
    if (item->kind == protocol::ItemV2::Kind::Packet)
      count += item->raw.size();
  return count;
}

/// How many bytes are part of packets of either kind.
struct Understood {
  std::size_t v1 = 0;
  std::size_t v2 = 0;
};

Understood understood(const Input& input) {
  if (input.recording.empty())
    return {std::max(understood(input.bytes, Direction::ToBall),
                     understood(input.bytes, Direction::FromBall)),
            understood_as_v2(input.bytes)};
  Understood count;
  for (const auto direction : {Direction::ToBall, Direction::FromBall}) {
    Bytes bytes;
    for (const auto& piece : input.recording)
      if (piece.direction == direction)
        bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
    count.v1 += understood(bytes, direction);
    count.v2 += understood_as_v2(bytes);
  }
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
  const auto count = understood(input);
  const bool is_v2 = arguments.v2 || count.v2 > count.v1;
  if (is_v2)
    print_v2(input, arguments.format == "json");
  else
    print_v1(input, arguments);
  if (is_v2 && count.v2 == 0 && count.v1 > 0)
    print_note(context, "these are packets v1; omit `--v2`");
  else if (count.v1 + count.v2 == 0 && (!input.bytes.empty() || !input.recording.empty()))
    print_note(context, "no whole packet here, neither v1 (FF …) nor v2 (8D … D8): check that no "
                        "byte is missing");
}

} // namespace

void add_decode(const Command& orb, Context& context) {
  const auto command = orb.add_command("decode", "explain packets in words",
                                       "orb decode FF FF 00 01 52 01 AB\n"
                                       "orb decode FFFE08000748656C6C6F0AF2\n"
                                       "orb decode session.txt\norb decode 8D0A11061FBFD8");
  auto arguments = std::make_shared<DecodeArguments>();
  command.add_option(
      "FILE", arguments->words,
      "hex bytes, or a file of hex, raw bytes or a recording; stdin if - or omitted");
  command.add_flag("--v2", arguments->v2,
                   "read them as packets v2, of the newer robots; without it whichever fits");
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
