#include "assembler/disassemble.h"

#include "protocol/macro.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::assembler {
namespace {

using protocol::MacroError;
using protocol::MacroStep;
using spec::MacroOperand;
using spec::MacroOperandKind;
using spec::MacroUnit;

bool is_documented(const MacroStep& step) {
  for (std::size_t i = 0; i < step.info->operand_count; ++i)
    if (!spec::is_documented(step.info->operand[i], step.value[i]))
      return false;
  return true;
}

std::string quoted(ByteView text) {
  std::string out = "\"";
  for (const auto byte : text) {
    if (byte == '"' || byte == '\\')
      out += fmt::format("\\{}", static_cast<char>(byte));
    else if (byte == '\n')
      out += "\\n";
    else if (byte >= ' ' && byte <= '~')
      out += static_cast<char>(byte);
    else
      out += fmt::format("\\x{:02X}", byte);
  }
  return out + '"';
}

std::string printed(const MacroOperand& operand, std::int32_t value) {
  const auto* word = std::find_if(operand.begin_words(), operand.end_words(),
                                  [&](const spec::MacroWord& w) { return w.value == value; });
  if (word != operand.end_words())
    return std::string(word->word);
  switch (operand.unit) {
  case MacroUnit::None: return fmt::format("{}", value);
  case MacroUnit::Milliseconds: return fmt::format("{}ms", value);
  case MacroUnit::Ticks10ms: return fmt::format("{}ms", value * 10);
  case MacroUnit::Degrees: return fmt::format("{}deg", value);
  }
  return {};
}

std::string command_line(const MacroStep& step, ByteView body) {
  std::string line(step.info->mnemonic);
  if (step.info->variable_length)
    return line + " " + quoted(body.subspan(step.text, step.offset + step.size - step.text));
  std::size_t shown = step.info->operand_count;
  if (shown > 0 && step.info->operand[shown - 1].kind == MacroOperandKind::Delay &&
      step.value[shown - 1] == 0)
    --shown;
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& operand = step.info->operand[i];
    line += shown == 1 ? " " : fmt::format(" {}=", operand.name);
    line += printed(operand, step.value[i]);
  }
  return line;
}

std::string raw_line(ByteView bytes) {
  std::string line = ".raw";
  for (const auto byte : bytes)
    line += fmt::format(" 0x{:02X}", byte);
  return line;
}

std::string header_line(const protocol::MacroHeader& header) {
  std::string flags;
  for (const auto& flag : spec::macro_flags)
    if (flag.flag != spec::MacroFlag::ExtFlags && spec::has_flag(header.flags, flag.flag))
      flags += fmt::format("{}{}", flags.empty() ? "" : ",", flag.word);
  return fmt::format(".macro macro_{} id={} flags={}{}\n", header.id, header.id,
                     flags.empty() ? "none" : flags,
                     header.extended_flags ? fmt::format(" ext={}", *header.extended_flags) : "");
}

/// The same error, with the offset from the start of the file.
std::string in_file(MacroError error, std::uint32_t header) {
  error.offset += header;
  return protocol::to_string(error);
}

} // namespace

tl::expected<std::string, std::string> disassemble(ByteView bytes, Reading reading) {
  std::string out;
  std::uint32_t header_size = 0;
  if (reading == Reading::Framed) {
    const auto header = protocol::read_macro_header(bytes);
    if (!header)
      return tl::unexpected(protocol::to_string(header.error()));
    if (header->id == spec::macro_id_none)
      return tl::unexpected(
          fmt::format("offset 0 (00h): id {} means no macro; expected an id from {} to {}",
                      spec::macro_id_none, spec::macro_id_system_first, spec::macro_id_temporary));
    out = header_line(*header);
    header_size = header->size;
  }
  const auto body = bytes.subspan(header_size);
  if (body.empty())
    return tl::unexpected(
        fmt::format("offset {} ({:02X}h): unexpected end of the bytes; expected a macro command",
                    header_size, header_size));
  const auto listing = protocol::decode_macro_body(body);
  if (listing.error)
    return tl::unexpected(in_file(*listing.error, header_size));
  for (const auto& step : listing.steps)
    out += (is_documented(step) ? command_line(step, body)
                                : raw_line(body.subspan(step.offset, step.size))) +
           "\n";
  if (!listing.has_end)
    out += ".noend\n";
  return out;
}

bool is_whole(ByteView bytes, Reading reading) {
  if (reading == Reading::Framed) {
    const auto header = protocol::read_macro_header(bytes);
    if (!header || header->id == spec::macro_id_none)
      return false;
    bytes = bytes.subspan(header->size);
  }
  const auto listing = protocol::decode_macro_body(bytes);
  return !listing.error && listing.has_end;
}

} // namespace orb::assembler
