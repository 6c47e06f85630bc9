#include "cli/commands/commands.h"
#include "cli/context/json.h"
#include "cli/model/checks.h"
#include "disk/disk.h"

#include "base/refuse.h"
#include "base/text/utf8.h"
#include "protocol/describe.h"
#include "protocol/describe_v2.h"
#include "protocol/log_text.h"
#include "protocol/packet_v2.h"

#include <algorithm>
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

/// What is to be decoded: the pieces of a log, or one piece without a direction.
struct Input {
  std::vector<protocol::LogLine> pieces;
  bool is_log = false;
  protocol::LogText log; ///< what could not be read of it; its lines are the pieces
};

/// What stands in front of a packet that this piece has completed.
std::string prefix_of(const Input& input, const protocol::LogLine& piece) {
  if (!input.is_log)
    return {};
  const auto* const sign = piece.direction == Direction::ToBall ? "> " : "< ";
  return piece.when.empty() ? sign : fmt::format("{} {}", piece.when, sign);
}

/// A stream of one direction, printed as its packets become whole.
class Printer {
public:
  Printer(Direction direction, bool as_json, protocol::Describer& describer)
      : decoder_(direction), from_(direction == Direction::ToBall ? "client" : "ball"),
        as_json_(as_json), describer_(describer) {}

  void feed(const protocol::LogLine& piece, std::string prefix) {
    prefix_ = std::move(prefix);
    when_ = piece.when;
    decoder_.feed(piece.bytes);
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
    Json json;
    if (!when_.empty())
      json["at"] = when_;
    json["from"] = from_;
    json.update(packet_json(describer_, item));
    print_json(json);
  }

  protocol::Decoder decoder_;
  std::string_view from_;
  std::string prefix_;
  std::string when_;
  bool as_json_;
  protocol::Describer& describer_;
  std::size_t shown_ = 0; ///< how many of the bytes to come have been printed already
};

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

Json logged_json(const protocol::ItemV2& item, const std::string& when,
                 protocol::DescriberV2& describer) {
  Json json;
  if (!when.empty())
    json["at"] = when;
  json["kind"] = kind_name(item);
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
  protocol::DecoderV2 to_ball, from_ball;
  std::string when, prefix_to_ball, prefix_from_ball;
  const auto print = [&](protocol::DecoderV2& decoder, const std::string& prefix) {
    while (const auto item = decoder.next())
      if (as_json)
        print_json(logged_json(*item, when, describer));
      else
        print_out(fmt::format("{}{}\n", prefix, describer.describe(*item)));
  };
  for (const auto& piece : input.pieces) {
    const bool out = piece.direction == Direction::ToBall;
    auto& decoder = out ? to_ball : from_ball;
    auto& prefix = out ? prefix_to_ball : prefix_from_ball;
    prefix = prefix_of(input, piece);
    when = piece.when;
    decoder.feed(piece.bytes);
    print(decoder, prefix);
  }
  to_ball.expire();
  print(to_ball, prefix_to_ball);
  from_ball.expire();
  print(from_ball, prefix_from_ball);
}

void print_v1(const Input& input, bool as_json) {
  protocol::Describer describer;
  Printer to_ball(Direction::ToBall, as_json, describer);
  Printer from_ball(Direction::FromBall, as_json, describer);
  for (const auto& piece : input.pieces)
    (piece.direction == Direction::ToBall ? to_ball : from_ball)
        .feed(piece, prefix_of(input, piece));
  to_ball.finish();
  from_ball.finish();
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
  std::size_t most() const { return std::max(v1, v2); }
};

Understood understood(const Input& input) {
  Understood count;
  if (!input.is_log) { // which way it travels may have been told wrongly
    const auto& bytes = input.pieces.front().bytes;
    return {std::max(understood(bytes, Direction::ToBall), understood(bytes, Direction::FromBall)),
            understood_as_v2(bytes)};
  }
  for (const auto direction : {Direction::ToBall, Direction::FromBall}) {
    Bytes bytes;
    for (const auto& piece : input.pieces)
      if (piece.direction == direction)
        bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
    count.v1 += understood(bytes, direction);
    count.v2 += understood_as_v2(bytes);
  }
  return count;
}

/// Tells who sent what nobody has told of: `--from`, or whoever's packets have right checksums.
/// Where that does not tell either, it goes on from the piece before; first comes the client.
Input with_directions(Input input, std::string_view from) {
  auto before = Direction::ToBall;
  for (auto& piece : input.pieces) {
    if (piece.direction)
      continue;
    const auto as_client = understood(piece.bytes, Direction::ToBall);
    const auto as_ball = understood(piece.bytes, Direction::FromBall);
    if (from != "auto")
      before = from == "ball" ? Direction::FromBall : Direction::ToBall;
    else if (as_client != as_ball || as_client > 0)
      before = as_ball > as_client ? Direction::FromBall : Direction::ToBall;
    piece.direction = before;
  }
  return input;
}

bool is_text(std::string_view content) {
  return std::ranges::none_of(
             content, [](char c) { return is_binary_byte[static_cast<unsigned char>(c)]; }) &&
         to_valid_utf8(content) == content;
}

Input one_piece(Bytes bytes, std::string_view from) {
  Input input;
  input.pieces.push_back({{}, std::nullopt, std::move(bytes)});
  return with_directions(std::move(input), from);
}

/// The lines of a log in text, hex that may go on from line to line, or the bytes themselves:
/// whatever holds more packets.
Input take_apart(std::string_view content, std::string_view from) {
  const auto bytes = as_bytes(content);
  if (!is_text(content))
    return one_piece({bytes.begin(), bytes.end()}, from);
  Input lines;
  lines.is_log = true;
  lines.log = protocol::read_log(content);
  lines.pieces = std::exchange(lines.log.lines, {});
  lines = with_directions(std::move(lines), from);
  if (auto hex = from_hex(content)) {
    auto whole = one_piece(*std::move(hex), from);
    const bool is_apart = lines.log.strangers == 0 && lines.log.read_lines > 1;
    return is_apart && understood(lines).most() > understood(whole).most() ? lines : whole;
  }
  return lines;
}

/// What of a text is no packet; nothing where all of it is.
tl::expected<void, Failure> check_strangers(const Input& input, const std::string& name) {
  constexpr std::size_t shown = 60; // bytes of the line
  const auto& log = input.log;
  if (log.strangers == 0)
    return {};
  return refuse(
      ExitCode::BadInput,
      fmt::format("{}: {} of {} no bytes; the first is line {}: `{}`; write "
                  "`> FF FF 00 01 52 01 AB`, and `#` before what is no packet",
                  name, log.strangers,
                  log.read_lines == 1 ? "1 line has" : fmt::format("{} lines have", log.read_lines),
                  log.first_stranger, to_printable(log.stranger.substr(0, shown))));
}

/// A recording of `orb run --port … --record`, which has what a program and its robot said to each
/// other, and not in packets.
constexpr std::string_view drive_recording = "orb.drive/";

tl::expected<Input, Failure> read_file(const DecodeArguments& arguments, const std::string& file) {
  const auto content = disk::read(file);
  if (!content)
    return refuse(ExitCode::File, content.error().message);
  if (content->starts_with(drive_recording))
    return refuse(ExitCode::BadInput,
                  fmt::format("{0} records a drive, without packets; `orb run PROGRAM --replay "
                              "{0}` repeats it",
                              disk::display_name(file)));
  return take_apart(*content, arguments.from);
}

tl::expected<Input, Failure> read_words(const DecodeArguments& arguments) {
  Bytes all;
  for (const auto& word : arguments.words) {
    const auto bytes = from_hex(word);
    if (!bytes)
      return refuse(ExitCode::Usage,
                    fmt::format("`{}` is neither a file nor hex bytes; write bytes as in "
                                "`orb decode FFFF00015201AB`",
                                word));
    all.insert(all.end(), bytes->begin(), bytes->end());
  }
  return one_piece(std::move(all), arguments.from);
}

void decode(Context& context, const DecodeArguments& arguments) {
  const auto& words = arguments.words;
  std::error_code ignored;
  const bool is_file =
      words.empty() ||
      (words.size() == 1 &&
       (words[0] == "-" || std::filesystem::exists(disk::as_path(words[0]), ignored)));
  const auto file = words.empty() ? "-" : words[0];
  const auto input = is_file ? read_file(arguments, file) : read_words(arguments);
  if (!input)
    return fail(context, input.error());
  const auto count = understood(*input);
  const bool is_v2 = arguments.v2 || count.v2 > count.v1;
  if (is_v2)
    print_v2(*input, arguments.format == "json");
  else
    print_v1(*input, arguments.format == "json");
  const bool has_bytes = std::ranges::any_of(
      input->pieces, [](const protocol::LogLine& piece) { return !piece.bytes.empty(); });
  if (is_v2 && count.v2 == 0 && count.v1 > 0)
    print_note(context, "these are packets v1; omit `--v2`");
  else if (count.most() == 0 && has_bytes)
    print_note(context, "no whole packet here, neither v1 (FF …) nor v2 (8D … D8): check that no "
                        "byte is missing");
  if (const auto all = check_strangers(*input, disk::display_name(file)); !all)
    fail(context, all.error());
}

} // namespace

void add_decode(const Command& orb, Context& context) {
  const auto command = orb.add_command("decode", "explain packets in words",
                                       "orb decode FF FF 00 01 52 01 AB\n"
                                       "orb decode FFFE08000748656C6C6F0AF2\n"
                                       "orb decode session.txt\norb decode 8D0A11061FBFD8\n"
                                       "orb decode robot.log");
  auto arguments = std::make_shared<DecodeArguments>();
  command.add_option(
      "FILE", arguments->words,
      "hex bytes, or a file of hex, raw bytes, a recording or a log; stdin if - or omitted");
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
