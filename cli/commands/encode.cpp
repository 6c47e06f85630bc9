#include "cli/commands.h"
#include "cli/options.h"

#include "base/suggest.h"
#include "protocol/packet.h"
#include "protocol/packet_v2.h"
#include "protocol/payload.h"

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <vector>

namespace orb::cli {
namespace {

struct EncodeArguments {
  std::string name;
  std::vector<std::string> operands;
  bool v2 = false;
  bool no_answer = false;
  unsigned seq = 0;
};

void fail(Context& context, std::string_view message, ExitCode code) {
  print_error(context, message);
  context.exit = code;
}

void print_bytes(ByteView bytes) {
  print_out(to_hex(bytes) + "\n");
}

void encode_v2(Context& context, const EncodeArguments& arguments) {
  std::vector<Bytes> parts;
  for (const auto& word : arguments.operands) {
    const auto bytes = from_hex(word);
    if (!bytes)
      return fail(context, fmt::format("`{}` is not hex bytes", word), ExitCode::Usage);
    parts.push_back(*bytes);
  }
  const auto did = from_hex(arguments.name);
  if (!did || did->size() != 1 || parts.empty() || parts[0].size() != 1)
    return fail(context,
                "a v2 packet takes DID CID [HEX], two hex digits each for DID and CID; "
                "write `orb encode --v2 13 0D`",
                ExitCode::Usage);
  protocol::PacketV2 packet;
  const auto answer = arguments.no_answer ? 0 : static_cast<int>(spec::V2Flag::RequestResponse);
  packet.flags = static_cast<std::uint8_t>(answer | static_cast<int>(spec::V2Flag::Activity));
  packet.did = did->front();
  packet.cid = parts[0].front();
  packet.seq = static_cast<std::uint8_t>(arguments.seq);
  for (std::size_t i = 1; i < parts.size(); ++i)
    packet.data.insert(packet.data.end(), parts[i].begin(), parts[i].end());
  print_bytes(encode(packet));
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

void add_encode(CLI::App& app, Context& context) {
  auto* command = add_command(app, "encode", "make the bytes of a packet",
                              "orb encode ping\norb encode set-rgb-led 255 0 0 0\n"
                              "orb encode append-orbbasic-fragment ram '10 print \"hi\"\\n\\0'\n"
                              "orb encode configure-locator -- 1 -300 0 90\n"
                              "orb encode --v2 13 0D");
  auto arguments = std::make_shared<EncodeArguments>();
  command->add_option("NAME", arguments->name, "a command of the API, or the DID of a v2 packet")
      ->required();
  command->add_option("ARGS", arguments->operands,
                      "its operands: numbers, 0x hex, named values, text or hex bytes");
  command->add_option("--seq", arguments->seq, "the sequence number")
      ->check(whole_number(0, std::numeric_limits<std::uint8_t>::max()))
      ->capture_default_str();
  command->add_flag("--no-answer", arguments->no_answer, "ask for no answer");
  command->add_flag("--v2", arguments->v2, "a packet of the newer robots: DID CID [HEX]");
  command->callback([&context, arguments] {
    if (arguments->v2)
      encode_v2(context, *arguments);
    else
      encode_v1(context, *arguments);
  });
}

} // namespace orb::cli
