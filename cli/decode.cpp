#include "cli/commands.h"
#include "cli/options.h"
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
  std::string from = "client";
};

/// A stream of one direction, printed as its packets become whole.
class Printer {
public:
  Printer(Direction direction, std::string prefix, protocol::Describer& describer)
      : decoder_(direction), prefix_(std::move(prefix)), describer_(describer) {}

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
      print_out(fmt::format("{}{}\n", prefix_, describer_.describe(*item)));
      if (item->kind == Item::Kind::BadChecksum || item->kind == Item::Kind::Fragment)
        shown_ = item->raw.size() - 1;
    }
  }

  protocol::Decoder decoder_;
  std::string prefix_;
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

void print_v2(const Input& input) {
  // Both directions share one format; the flags tell answers from commands.
  const auto print = [](protocol::DecoderV2& decoder, std::string_view prefix) {
    while (const auto item = decoder.next())
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

void print_v1(const Input& input, Direction direction) {
  protocol::Describer describer;
  if (input.recording.empty()) {
    Printer printer(direction, "", describer);
    printer.feed(input.bytes);
    printer.finish();
    return;
  }
  Printer to_ball(Direction::ToBall, "> ", describer);
  Printer from_ball(Direction::FromBall, "< ", describer);
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
      (words.size() == 1 && (words[0] == "-" || std::filesystem::exists(words[0], ignored)))) {
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
    print_v2(input);
  else
    print_v1(input, arguments.from == "ball" ? Direction::FromBall : Direction::ToBall);
}

} // namespace

void add_decode(CLI::App& app, Context& context) {
  auto* command = add_command(app, "decode", "put packets into words",
                              "orb decode FF FF 00 01 52 01 AB\n"
                              "orb decode --from ball FFFE08000748656C6C6F0AF2\n"
                              "orb decode session.txt\norb decode --v2 8D0A11061FBFD8");
  auto arguments = std::make_shared<DecodeArguments>();
  command->add_option("FILE", arguments->words,
                      "hex bytes, or a file with hex, bytes or a recording; - or nothing is stdin");
  command->add_flag("--v2", arguments->v2, "packets of the newer robots");
  command->add_option("--from", arguments->from, "who sent the bytes; a recording says so itself")
      ->check(one_of({"client", "ball"}))
      ->capture_default_str();
  command->callback([&context, arguments] { decode(context, *arguments); });
}

} // namespace orb::cli
