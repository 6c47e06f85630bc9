#include "protocol/macro.h"
#include "base/text/text.h"

#include <fmt/format.h>

namespace orb::protocol {
namespace {

using spec::MacroCommand;
using spec::MacroFlag;
using spec::MacroOperandKind;

std::uint32_t operands_size(ByteView bytes) {
  return static_cast<std::uint32_t>(bytes.size());
}

std::int32_t read_operand(ByteView bytes, std::uint32_t offset, const spec::MacroOperand& operand) {
  if (operand.width == 1)
    return bytes[offset];
  const auto raw = read_u16(bytes, offset);
  return operand.is_signed ? static_cast<std::int16_t>(raw) : raw;
}

MacroError cut_operand(ByteView bytes, std::uint32_t offset, const spec::MacroCommandInfo& info) {
  MacroError error{MacroError::Kind::CutOperand, offset, info.code, &info, nullptr, info.length,
                   operands_size(bytes) - offset};
  std::uint32_t at = offset + 1;
  for (const auto& operand : info) {
    error.operand = &operand;
    if (at + operand.width > operands_size(bytes))
      break;
    at += operand.width;
  }
  error.offset = at;
  return error;
}

std::string seen_and_expected(const MacroError& error) {
  switch (error.kind) {
  case MacroError::Kind::NoHeader:
    return fmt::format("unexpected end of data; expected {}", error.offset == 0 ? "a macro id"
                                                              : error.offset == 1
                                                                  ? "the flags"
                                                                  : "the extended flags");
  case MacroError::Kind::UnknownCode:
    return fmt::format(
        "{:02X}h is not a macro command; expected a command code, {:02X}h to {:02X}h", error.byte,
        std::begin(spec::macro_commands)->code, (std::end(spec::macro_commands) - 1)->code);
  case MacroError::Kind::CutOperand:
    return fmt::format(
        "the data ends inside `{}` ({:02X}h); expected its operand `{}`, found {} of the "
        "{} that the command takes",
        error.command->mnemonic, error.byte, error.operand->name, error.present,
        plural(error.wanted, "byte"));
  case MacroError::Kind::CutText:
    return fmt::format("the data ends inside a `{}` ({:02X}h); expected {} of text, found {}",
                       error.command->mnemonic, error.byte, plural(error.wanted, "byte"),
                       error.present);
  case MacroError::Kind::AfterEnd:
    return fmt::format("{} after `{}`; expected the macro to end here",
                       plural(error.present, "byte"), spec::info(MacroCommand::End).mnemonic);
  }
  return {};
}

} // namespace

std::string to_string(const MacroError& error) {
  return fmt::format("offset {} ({:02X}h): {}", error.offset, error.offset,
                     seen_and_expected(error));
}

Bytes encode(const MacroImage& image) {
  Bytes out;
  out.reserve(image.body.size() + 3);
  out.push_back(image.id);
  out.push_back(image.flags);
  if (image.extended_flags)
    out.push_back(*image.extended_flags);
  out.insert(out.end(), image.body.begin(), image.body.end());
  return out;
}

tl::expected<MacroHeader, MacroError> read_macro_header(ByteView bytes) {
  MacroError error;
  error.offset = operands_size(bytes);
  if (bytes.size() < 2)
    return tl::unexpected(error);
  MacroHeader header{bytes[0], bytes[1], std::nullopt, 2};
  if (!spec::has_flag(header.flags, MacroFlag::ExtFlags))
    return header;
  if (bytes.size() < 3)
    return tl::unexpected(error);
  header.extended_flags = bytes[2];
  header.size = 3;
  return header;
}

tl::expected<MacroImage, MacroError> decode_macro(ByteView bytes) {
  const auto header = read_macro_header(bytes);
  if (!header)
    return tl::unexpected(header.error());
  const auto body = bytes.subspan(header->size);
  return MacroImage{header->id, header->flags, header->extended_flags, {body.begin(), body.end()}};
}

tl::expected<MacroStep, MacroError> read_macro_command(ByteView bytes, std::uint32_t offset) {
  const auto code = bytes[offset];
  const auto* info = spec::find_macro_command(code);
  if (info == nullptr)
    return tl::unexpected(
        MacroError{MacroError::Kind::UnknownCode, offset, code, nullptr, nullptr, 0, 0});
  const auto present = operands_size(bytes) - offset;
  if (info->length > present)
    return tl::unexpected(cut_operand(bytes, offset, *info));
  MacroStep step;
  step.info = info;
  step.offset = offset;
  step.size = info->length;
  auto at = offset + 1;
  for (std::uint32_t i = 0; i < info->operand_count; ++i) {
    const auto& operand = info->operand[i];
    step.value[i] = read_operand(bytes, at, operand);
    at += operand.width;
  }
  if (!info->variable_length)
    return step;
  const auto text_size = static_cast<std::uint32_t>(step.value[0]);
  step.text = at;
  step.size += text_size;
  if (step.size > present)
    return tl::unexpected(MacroError{MacroError::Kind::CutText, at, code, info, info->begin(),
                                     text_size, present - info->length});
  return step;
}

MacroListing decode_macro_body(ByteView body) {
  MacroListing listing;
  for (std::uint32_t offset = 0; offset < body.size();) {
    if (listing.has_end) {
      listing.error =
          MacroError{MacroError::Kind::AfterEnd,  offset, body[offset], nullptr, nullptr, 0,
                     operands_size(body) - offset};
      break;
    }
    const auto step = read_macro_command(body, offset);
    if (!step) {
      listing.error = step.error();
      break;
    }
    listing.steps.push_back(*step);
    listing.has_end = step->info->command == MacroCommand::End;
    offset += step->size;
  }
  return listing;
}

void append_macro_command(Bytes& out, MacroCommand command, std::span<const std::int32_t> values,
                          std::string_view text) {
  const auto& info = spec::info(command);
  out.push_back(info.code);
  std::size_t next = 0;
  for (const auto& operand : info) {
    if (operand.kind == MacroOperandKind::Text) {
      append_u16(out, static_cast<std::uint32_t>(text.size()));
      out.insert(out.end(), text.begin(), text.end());
      continue;
    }
    const auto value = static_cast<std::uint32_t>(values[next++]);
    if (operand.width == 1)
      out.push_back(static_cast<std::uint8_t>(value));
    else
      append_u16(out, value);
  }
}

} // namespace orb::protocol
