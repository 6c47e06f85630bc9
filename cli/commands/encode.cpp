#include "cli/commands/commands.h"
#include "cli/model/checks.h"

#include "base/text/suggest.h"
#include "protocol/packet.h"
#include "protocol/packet_v2.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"
#include "spec/robots.h"

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace orb::cli {
namespace {

struct EncodeArguments {
  std::string name;
  std::vector<std::string> operands;
  bool v2 = false;
  bool no_answer = false;
  unsigned seq = 0;
  std::string robot;
};

void fail(Context& context, std::string_view message, ExitCode code) {
  print_error(context, message);
  context.exit = code;
}

void print_bytes(ByteView bytes) {
  print_out(to_hex(bytes) + "\n");
}

constexpr std::string_view numbers_taken =
    "a v2 packet takes a name, or DID CID [HEX], with two hex digits each for DID and CID, as in "
    "`orb encode --v2 13 0D`";

/// Reads a command of the newer robots given by numbers; nothing for other words.
std::optional<protocol::PacketV2> numbered_v2(const EncodeArguments& arguments) {
  const auto did = from_hex(arguments.name);
  if (!did || did->size() != 1 || arguments.operands.empty())
    return std::nullopt;
  Bytes rest;
  for (const auto& word : arguments.operands) {
    const auto bytes = from_hex(word);
    if (!bytes || (rest.empty() && bytes->size() != 1))
      return std::nullopt;
    rest.insert(rest.end(), bytes->begin(), bytes->end());
  }
  protocol::PacketV2 packet;
  packet.did = did->front();
  packet.cid = rest.front();
  packet.data.assign(rest.begin() + 1, rest.end());
  return packet;
}

tl::expected<protocol::PacketV2, std::string> packet_v2(const EncodeArguments& arguments) {
  if (const auto* row = spec::find_v2_command(arguments.name)) {
    auto data = protocol::encode_operands(row->command, arguments.operands);
    if (!data)
      return tl::unexpected(data.error());
    return protocol::make_request(row->command, *std::move(data), 0);
  }
  if (auto packet = numbered_v2(arguments))
    return *std::move(packet);
  if (from_hex(arguments.name))
    return tl::unexpected(std::string(numbers_taken));
  std::vector<std::string_view> names;
  for (const auto& row : spec::v2_commands)
    names.push_back(row.name);
  return tl::unexpected(fmt::format("`{}` is not a v2 command; {}", arguments.name,
                                    did_you_mean(arguments.name, names, numbers_taken)));
}

void encode_v2(Context& context, const EncodeArguments& arguments) {
  auto packet = packet_v2(arguments);
  if (!packet)
    return fail(context, packet.error(), ExitCode::Usage);
  const auto answer = arguments.no_answer ? 0 : static_cast<int>(spec::V2Flag::RequestResponse);
  packet->flags = static_cast<std::uint8_t>(answer | static_cast<int>(spec::V2Flag::Activity));
  packet->seq = static_cast<std::uint8_t>(arguments.seq);
  const auto* robot = spec::find_robot(arguments.robot);
  print_bytes(encode(robot == nullptr ? *packet : protocol::address(*packet, *robot)));
}

void encode_v1(Context& context, const EncodeArguments& arguments) {
  const auto* row = spec::find_command(arguments.name);
  if (row == nullptr) {
    std::vector<std::string_view> names;
    for (const auto& command : spec::api_commands)
      names.push_back(command.name);
    return fail(
        context,
        fmt::format("`{}` is not a command; {}", arguments.name,
                    did_you_mean(arguments.name, names, "`orb spec api-commands` lists them")),
        ExitCode::Usage);
  }
  const auto payload = protocol::encode_operands(row->command, arguments.operands);
  if (!payload)
    return fail(context, payload.error().message, ExitCode::Usage);
  auto command =
      protocol::make_command(row->command, *payload, static_cast<std::uint8_t>(arguments.seq));
  if (arguments.no_answer)
    command.flags = static_cast<std::uint8_t>(command.flags & ~spec::sop2_answer);
  print_bytes(encode(command));
}

} // namespace

void add_encode(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("encode", "print the bytes of a packet",
                      "orb encode ping\norb encode set-rgb-led 255 0 0 0\n"
                      "orb encode append-orbbasic-fragment ram \"10 end\\n\\0\"\n"
                      "orb encode configure-locator -- 1 -300 0 90\n"
                      "orb encode --v2 13 0D\norb encode --robot bolt drive-with-heading 60 90");
  auto arguments = std::make_shared<EncodeArguments>();
  command.add_option("NAME", arguments->name, "an API command, or the DID of a v2 packet")
      .required();
  command.add_option("ARGS", arguments->operands,
                     "its operands: numbers, 0x hex, named values, text or hex bytes");
  command.add_option("--seq", arguments->seq, "the sequence number")
      .check(whole_number(0, std::numeric_limits<std::uint8_t>::max()))
      .show_default();
  command.add_flag("--no-answer", arguments->no_answer, "do not ask for an answer");
  command.add_flag("--v2", arguments->v2,
                   "a packet for the newer robots: a name and operands, or DID CID [HEX]");
  std::vector<std::string> robots;
  for (const auto& row : spec::robots)
    if (row.packets == spec::Packets::V2)
      robots.emplace_back(row.name);
  command
      .add_option(
          "--robot", arguments->robot,
          "the newer robot that the packet is for; some robots name a processor in each packet")
      .check(one_of(std::move(robots)));
  command.callback([&context, arguments] {
    const bool only_v2 = spec::find_command(arguments->name) == nullptr &&
                         spec::find_v2_command(arguments->name) != nullptr;
    if (arguments->v2 || !arguments->robot.empty() || only_v2)
      encode_v2(context, *arguments);
    else
      encode_v1(context, *arguments);
  });
}

} // namespace orb::cli
