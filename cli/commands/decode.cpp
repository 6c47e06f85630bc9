#include "cli/ball/judged.h"
#include "cli/commands/commands.h"
#include "cli/context/json.h"
#include "cli/context/language.h"
#include "cli/model/checks.h"
#include "disk/disk.h"

#include "base/refuse.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "protocol/capture/capture.h"
#include "protocol/describe.h"
#include "protocol/describe_v2.h"
#include "protocol/log_text.h"
#include "protocol/packet_v2.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <vector>

namespace orb::cli {
namespace {

using protocol::Conversation;
using protocol::Direction;
using protocol::Item;
using protocol::LogLine;

struct DecodeArguments {
  std::vector<std::string> words;
  bool v2 = false;
  std::string from = "auto";
  std::string format = "text";
  bool judge = false;
  std::string robot;
};

/// The input to decode: the conversations of a log or a capture, or one piece without a direction.
struct Input {
  std::vector<protocol::Conversation> conversations;
  bool is_log = false;
  bool is_capture = false;
  protocol::LogText log;          ///< the unreadable parts of a text
  std::optional<Failure> refused; ///< set for a capture without a robot
  std::string warning;            ///< set for a truncated capture
};

/// The beginning of what is printed of a packet: when, of which robot, and who sent it.
Json logged_at(const std::string& when, const std::string& robot, std::string_view from) {
  Json json;
  if (!when.empty())
    json["at"] = when;
  if (!robot.empty())
    json["robot"] = robot;
  json["from"] = from;
  return json;
}

/// A stream of one direction. Prints packets as soon as they are complete.
class Printer {
public:
  Printer(Direction direction, bool as_json, std::string robot, protocol::Describer& describer)
      : decoder_(direction), from_(direction == Direction::ToBall ? "client" : "ball"),
        robot_(std::move(robot)), as_json_(as_json), describer_(describer) {}

  void feed(const LogLine& piece, std::string prefix) {
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
      // Bytes of a damaged packet are scanned again, but printed once.
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
    auto json = logged_at(when_, robot_, from_);
    json.update(packet_json(describer_, item));
    print_json(json);
  }

  protocol::Decoder decoder_;
  std::string_view from_;
  std::string robot_;
  std::string prefix_;
  std::string when_;
  bool as_json_;
  protocol::Describer& describer_;
  std::size_t shown_ = 0; ///< how many upcoming bytes are printed already
};

std::string_view v2_kind_name(const protocol::ItemV2& item) {
  using Kind = protocol::ItemV2::Kind;
  switch (item.kind) {
  case Kind::Packet: return kind_of(item.packet);
  case Kind::Noise: return "noise";
  case Kind::BadChecksum: return "bad-checksum";
  case Kind::Incomplete: return "incomplete";
  }
  return "";
}

Json v2_packet_json(protocol::DescriberV2& describer, const protocol::ItemV2& item) {
  Json json;
  json["kind"] = v2_kind_name(item);
  if (item.kind == protocol::ItemV2::Kind::Packet) {
    const auto& packet = item.packet;
    json.update(
        {{"flags", packet.flags}, {"did", packet.did}, {"cid", packet.cid}, {"seq", packet.seq}});
    if (json["kind"] == "response")
      json["error"] = packet.error;
    json["data"] = to_hex(packet.data);
    if (const auto name = name_of(packet); !name.empty())
      json["name"] = name;
    describer.describe(item); // the describer has to see every packet
    if (const auto fields = describer.fields_of(packet); !fields.empty())
      json["meaning"] = fields;
  }
  json["raw"] = to_hex(item.raw);
  return json;
}

/// Prints a conversation as it arrives.
class Speech {
public:
  virtual ~Speech() = default;
  /// `prefix` precedes the packets that the line completes.
  virtual void take(const LogLine& line, std::string prefix) = 0;
  virtual void finish() = 0;
};

class SpeechV1 final : public Speech {
public:
  SpeechV1(bool as_json, const std::string& robot)
      : to_ball_(Direction::ToBall, as_json, robot, describer_),
        from_ball_(Direction::FromBall, as_json, robot, describer_) {}

  void take(const LogLine& line, std::string prefix) override {
    (line.direction == Direction::ToBall ? to_ball_ : from_ball_).feed(line, std::move(prefix));
  }
  void finish() override {
    to_ball_.finish();
    from_ball_.finish();
  }

private:
  protocol::Describer describer_;
  Printer to_ball_;
  Printer from_ball_;
};

/// Both directions share one format; the flags tell answers from commands.
class SpeechV2 final : public Speech {
public:
  SpeechV2(bool as_json, std::string robot) : as_json_(as_json), robot_(std::move(robot)) {}

  void take(const LogLine& line, std::string prefix) override {
    auto& half = line.direction == Direction::ToBall ? to_ball_ : from_ball_;
    half.prefix = std::move(prefix);
    when_ = line.when;
    half.decoder.feed(line.bytes);
    print(half);
  }
  void finish() override {
    for (auto* half : {&to_ball_, &from_ball_}) {
      half->decoder.expire();
      print(*half);
    }
  }

private:
  struct Half {
    protocol::DecoderV2 decoder;
    std::string prefix;
  };

  void print(Half& half) {
    while (const auto item = half.decoder.next()) {
      if (!as_json_) {
        print_out(fmt::format("{}{}\n", half.prefix, describer_.describe(*item)));
        continue;
      }
      // Nobody else answers, even where the direction of the bytes was only guessed.
      const bool speaks =
          item->kind == protocol::ItemV2::Kind::Packet && kind_of(item->packet) != "command";
      auto json = logged_at(when_, robot_, speaks || &half == &from_ball_ ? "ball" : "client");
      json.update(v2_packet_json(describer_, *item));
      print_json(json);
    }
  }

  bool as_json_;
  std::string robot_;
  std::string when_;
  protocol::DescriberV2 describer_;
  Half to_ball_, from_ball_;
};

/// How many bytes belong to packets of each kind.
struct Understood {
  std::size_t v1 = 0;
  std::size_t v2 = 0;
  std::size_t most() const { return std::max(v1, v2); }
};

Understood understood(const Conversation& conversation) {
  Understood count;
  for (const auto direction : {Direction::ToBall, Direction::FromBall}) {
    Bytes bytes;
    for (const auto& line : conversation.lines)
      if (line.direction == direction && !line.greets)
        bytes.insert(bytes.end(), line.bytes.begin(), line.bytes.end());
    count.v1 += protocol::understood(bytes, direction);
    count.v2 += protocol::understood_as_v2(bytes);
  }
  return count;
}

/// The same for a single piece whose direction may be wrong.
Understood understood_either_way(const Bytes& bytes) {
  return {std::max(protocol::understood(bytes, Direction::ToBall),
                   protocol::understood(bytes, Direction::FromBall)),
          protocol::understood_as_v2(bytes)};
}

/// The sum over all conversations.
Understood understood(const Input& input) {
  if (!input.is_log)
    return understood_either_way(input.conversations.front().lines.front().bytes);
  Understood count;
  for (const auto& conversation : input.conversations) {
    const auto one = understood(conversation);
    count.v1 += one.v1;
    count.v2 += one.v2;
  }
  return count;
}

/// Decides which packets a conversation uses.
spec::Packets packets_of(const Understood& count, const DecodeArguments& arguments) {
  return arguments.v2 || count.v2 > count.v1 ? spec::Packets::V2 : spec::Packets::V1;
}

/// True if output has to name the robots.
bool has_several_robots(const Input& input) {
  return std::ranges::any_of(input.conversations, [&](const Conversation& one) {
    return one.robot != input.conversations.front().robot;
  });
}

/// The text before a packet that this line completed.
std::string prefix_of(const LogLine& line, const std::string& robot) {
  std::string prefix;
  for (const auto& word : {line.when, robot})
    prefix += word.empty() ? "" : word + " ";
  return prefix + (line.direction == Direction::ToBall ? "> " : "< ");
}

/// Prints the text that opens a robot over Bluetooth LE; it is not a packet.
void print_greeting(const LogLine& line, const std::string& prefix, const std::string& robot,
                    bool as_json) {
  if (!as_json) {
    const auto text = as_text(line.bytes);
    const bool is_word = line.bytes.size() > 1 && to_printable(text) == text;
    return print_out(fmt::format("{}greeting {}\n", prefix,
                                 is_word ? fmt::format("\"{}\"", text) : to_hex(line.bytes)));
  }
  auto json = logged_at(line.when, robot, "client");
  json["kind"] = "greeting";
  json["raw"] = to_hex(line.bytes);
  print_json(json);
}

/// Prints all conversations in order of time.
void print(const Input& input, const DecodeArguments& arguments) {
  const bool as_json = arguments.format == "json";
  const bool several = has_several_robots(input);
  struct LoggedLine {
    const LogLine* line;
    std::size_t conversation;
  };
  std::vector<LoggedLine> all;
  std::vector<std::unique_ptr<Speech>> speeches;
  std::vector<std::string> robots;
  const auto whole = input.is_log ? Understood{} : understood(input);
  for (const auto& conversation : input.conversations) {
    const auto count = input.is_log ? understood(conversation) : whole;
    robots.push_back(several ? conversation.robot : "");
    if (packets_of(count, arguments) == spec::Packets::V2)
      speeches.push_back(std::make_unique<SpeechV2>(as_json, robots.back()));
    else
      speeches.push_back(std::make_unique<SpeechV1>(as_json, robots.back()));
    for (const auto& line : conversation.lines)
      all.push_back({&line, speeches.size() - 1});
  }
  std::ranges::stable_sort(all, {}, [](const LoggedLine& said) { return said.line->number; });
  for (const auto& [line, index] : all) {
    auto prefix = input.is_log ? prefix_of(*line, robots[index]) : "";
    if (line->greets)
      print_greeting(*line, prefix, robots[index], as_json);
    else
      speeches[index]->take(*line, std::move(prefix));
  }
  for (const auto& speech : speeches)
    speech->finish();
}

/// Sets the direction of pieces without one: from `--from`, or from the side whose packets have
/// valid checksums. If neither decides, directions alternate, starting with the client.
void set_directions(Conversation& conversation, std::string_view from) {
  auto before = Direction::ToBall;
  for (auto& line : conversation.lines) {
    if (line.direction)
      continue;
    const auto as_client = protocol::understood(line.bytes, Direction::ToBall);
    const auto as_ball = protocol::understood(line.bytes, Direction::FromBall);
    if (from != "auto")
      before = from == "ball" ? Direction::FromBall : Direction::ToBall;
    else if (as_client != as_ball || as_client > 0)
      before = as_ball > as_client ? Direction::FromBall : Direction::ToBall;
    line.direction = before;
  }
}

bool is_text(std::string_view content) {
  return std::ranges::none_of(
             content, [](char c) { return is_binary_byte[static_cast<unsigned char>(c)]; }) &&
         to_valid_utf8(content) == content;
}

Input one_piece(Bytes bytes, std::string_view from) {
  Input input;
  input.conversations.emplace_back().lines.emplace_back().bytes = std::move(bytes);
  set_directions(input.conversations.front(), from);
  return input;
}

/// The conversations in a Bluetooth capture.
Input of_capture(protocol::Capture capture, const std::string& name, std::string_view from) {
  Input input;
  input.is_log = input.is_capture = true;
  const auto& frames = capture.frames;
  if (frames.cut)
    input.warning =
        fmt::format("{} ends within a frame; {} before it", name, plural(frames.count, "frame"));
  if (capture.conversations.empty())
    input.refused = Failure{
        ExitCode::BadInput,
        frames.foreign_link && frames.packets.empty()
            ? fmt::format("{} is a {} capture of link type {}, which `orb decode` does not read; "
                          "capture HCI: Android's btsnoop_hci.log, `btmon -w FILE`, or "
                          "Wireshark on a Bluetooth adapter",
                          name, frames.format, *frames.foreign_link)
            : fmt::format("{} is a {} capture of {}, and no robot speaks in it", name,
                          frames.format, plural(frames.count, "frame"))};
  input.conversations = std::move(capture.conversations);
  for (auto& conversation : input.conversations)
    set_directions(conversation, from);
  return input;
}

/// Reads a capture, a text log, hex that may span lines, or raw bytes: the reading that gives most
/// packets wins.
Input take_apart(std::string_view content, const std::string& name, std::string_view from) {
  const auto bytes = as_bytes(content);
  if (auto capture = protocol::read_capture(bytes))
    return of_capture(*std::move(capture), name, from);
  if (!is_text(content))
    return one_piece({bytes.begin(), bytes.end()}, from);
  Input lines;
  lines.is_log = true;
  lines.log = protocol::read_log(content);
  auto& conversation = lines.conversations.emplace_back();
  conversation.lines = std::exchange(lines.log.lines, {});
  set_directions(conversation, from);
  // A log kept by a client is complete from its first word.
  conversation.has_start =
      !conversation.lines.empty() && conversation.lines.front().direction == Direction::ToBall;
  conversation.has_end = true;
  if (auto hex = from_hex(content)) {
    auto whole = one_piece(*std::move(hex), from);
    const bool is_apart = lines.log.strangers == 0 && lines.log.read_lines > 1;
    return is_apart && understood(lines).most() > understood(whole).most() ? lines : whole;
  }
  return lines;
}

/// Fails if part of a text is not a packet.
tl::expected<void, Failure> check_strangers(const Input& input, const std::string& name) {
  constexpr std::size_t shown = 60; // bytes of the line to show
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

/// A recording of `orb run --port … --record`. It holds the values that a program and its robot
/// exchanged, not packets.
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
  return take_apart(*content, disk::display_name(file), arguments.from);
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

/// True if the bytes look like packets v2, although none is complete.
bool begins_as_v2(const Conversation& conversation) {
  return std::ranges::any_of(conversation.lines, [](const LogLine& line) {
    return !line.bytes.empty() && line.bytes.front() == spec::v2_start;
  });
}

/// Prints the mistakes of the clients in place of the packets.
void print_judgement(Context& context, Input& input, const std::string& name,
                     const DecodeArguments& arguments) {
  using Awake = protocol::ClientJudge::Awake;
  JudgedLog log{name, input.is_capture ? Numbered::Frames : Numbered::Lines, {}};
  std::set<std::string> known;
  for (auto& conversation : input.conversations) {
    if (!arguments.robot.empty())
      conversation.kind = spec::find_robot(arguments.robot)->robot; // the option has been checked
    const auto count = understood(conversation);
    const auto packets = count.most() == 0 && begins_as_v2(conversation)
                             ? spec::Packets::V2
                             : packets_of(count, arguments);
    if (conversation.kind && spec::info(*conversation.kind).packets != packets)
      conversation.kind.reset();
    const bool is_first = known.insert(conversation.robot).second;
    log.conversations.push_back(
        {conversation.robot, packets,
         protocol::judge(conversation, packets, is_first ? Awake::No : Awake::Perhaps)});
  }
  const auto say = say_in(context.ui_language);
  print_out(arguments.format == "json"    ? judged_json(log, say)
            : arguments.format == "junit" ? judged_junit(log)
                                          : judged_text(log, context.out_style(), say));
  if (!log.is_clean())
    context.exit = ExitCode::BadInput;
}

void decode(Context& context, const DecodeArguments& arguments) {
  const auto& words = arguments.words;
  std::error_code ignored;
  const bool is_file =
      words.empty() ||
      (words.size() == 1 &&
       (words[0] == "-" || std::filesystem::exists(disk::as_path(words[0]), ignored)));
  const auto file = words.empty() ? "-" : words[0];
  if (arguments.format == "junit" && !arguments.judge)
    return fail(context, {ExitCode::Usage, "`--format junit` is for verdicts; add `--judge`"});
  auto input = is_file ? read_file(arguments, file) : read_words(arguments);
  if (!input)
    return fail(context, input.error());
  if (input->refused)
    return fail(context, *input->refused);
  const auto count = understood(*input);
  const bool is_v2 = packets_of(count, arguments) == spec::Packets::V2;
  const bool has_bytes = std::ranges::any_of(input->conversations, [](const Conversation& one) {
    return std::ranges::any_of(one.lines, [](const LogLine& line) { return !line.bytes.empty(); });
  });
  if (arguments.judge && !input->is_log)
    return fail(context, {ExitCode::Usage, "`--judge` takes a log that tells who speaks, such as "
                                           "that of `orb ball --log`, or a capture"});
  if (arguments.judge && has_bytes)
    print_judgement(context, *input, disk::display_name(file), arguments);
  else
    print(*input, arguments);
  if (!input->warning.empty())
    print_warning(context, input->warning);
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
  const auto command =
      orb.add_command("decode", "explain packets in words",
                      "orb decode FF FF 00 01 52 01 AB\n"
                      "orb decode FFFE08000748656C6C6F0AF2\n"
                      "orb decode session.txt\norb decode 8D0A11061FBFD8\n"
                      "orb decode btsnoop_hci.log\n"
                      "orb decode --judge session.log\n"
                      "orb decode --judge --robot bolt --format junit robot.pcapng");
  auto arguments = std::make_shared<DecodeArguments>();
  command.add_option(
      "FILE", arguments->words,
      "hex bytes, or a file: hex, raw bytes, a recording, a log, or a capture of Bluetooth "
      "(btsnoop, pcap, pcapng); stdin if - or omitted");
  command.add_flag("--v2", arguments->v2,
                   "read them as packets v2, of the newer robots; without it whichever fits");
  command.add_flag("--judge", arguments->judge,
                   "say what the client did wrong, instead of what was said; exit code 1 if "
                   "anything");
  command
      .add_option("--robot", arguments->robot,
                  "which robot it was, for --judge; without it what all have in common counts, or "
                  "the name in a capture")
      .check(one_of(names_of(spec::robots)));
  command
      .add_option("--format", arguments->format,
                  "text, JSON for other programs, or with --judge JUnit for CI")
      .check(one_of({"text", "json", "junit"}))
      .show_default();
  command
      .add_option("--from", arguments->from,
                  "which side sent the bytes; auto: the one whose checksums match; a recording "
                  "names its side itself")
      .check(one_of({"auto", "client", "ball"}))
      .show_default();
  command.callback([&context, arguments] { decode(context, *arguments); });
}

} // namespace orb::cli
