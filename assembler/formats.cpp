#include "assembler/formats.h"

#include "assembler/timing.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace orb::assembler {
namespace {

using assembler::AssembledMacro;
using assembler::CommandTiming;
using assembler::MacroTiming;
using assembler::PlacedCommand;
using assembler::TimingNote;
using json = nlohmann::ordered_json;

constexpr std::size_t bytes_per_line = 8;

std::string c_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    if (digit && out.empty())
      out += '_';
    out += letter || digit ? c : '_';
  }
  return out.empty() ? "macro" : out;
}

/// The source text of a command.
std::string source_of(const Source& source, const PlacedCommand& command) {
  if (command.origin == PlacedCommand::Origin::Supplied)
    return "(end)";
  return std::string(source.text(command.span));
}

std::string_view word(TimingNote note) {
  switch (note) {
  case TimingNote::Exact: return "exact";
  case TimingNote::UntilStopped: return "until-stopped";
  case TimingNote::Endless: return "endless";
  case TimingNote::Leaves: return "leaves";
  case TimingNote::Calls: return "calls";
  case TimingNote::SystemLoops: return "system-loops";
  case TimingNote::Sleeps: return "sleeps";
  case TimingNote::Broken: return "broken";
  case TimingNote::TooLong: return "too-long";
  }
  return {};
}

json operands_of(const PlacedCommand& command) {
  json operands = json::object();
  for (std::size_t i = 0; i < command.info->operand_count; ++i) {
    const auto& operand = command.info->operand[i];
    if (operand.kind != spec::MacroOperandKind::Text)
      operands[std::string(operand.name)] = command.value[i];
  }
  return operands;
}

std::string wait_text(const CommandTiming& timing) {
  if (timing.least_ms == timing.most_ms)
    return timing.most_ms == 0 ? std::string() : assembler::print_time(timing.most_ms);
  return "< " + assembler::print_time(timing.most_ms);
}

/// Prints the framed macro as a byte array for C.
std::string print_c(std::string_view name, const AssembledMacro& macro) {
  const auto bytes = protocol::encode(macro.image());
  const auto id = c_name(name);
  auto out = fmt::format("// Macro {}: id, flags, commands, end.\nconst unsigned char {}[] = {{",
                         to_printable(name), id);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    out += fmt::format("{}0x{:02X},", i % 12 == 0 ? "\n  " : " ", bytes[i]);
  return out + fmt::format("\n}};\nconst unsigned int {}_size = sizeof {};\n", id, id);
}

/// Prints a macro as JSON of schema `orb.macro/1`: bytes, commands with their operands, times.
std::string print_json(std::string_view name, const Source& source, const Assembly& assembly,
                       std::size_t index) {
  const auto& macro = assembly.macros[index];
  const auto image = macro.image();
  const auto timing = assembler::time_macro(assembly, index);
  const auto bytes = protocol::encode(image);
  json out;
  out["schema"] = "orb.macro/1";
  out["name"] = name;
  out["id"] = image.id;
  out["flags"] = image.flags;
  if (image.extended_flags)
    out["extendedFlags"] = *image.extended_flags;
  out["size"] = bytes.size();
  out["bytes"] = to_hex(bytes);
  out["duration"] = {
      {"minimumMs", timing.least_ms}, {"maximumMs", timing.most_ms}, {"kind", word(timing.note)}};
  out["commands"] = json::array();
  for (std::size_t i = 0; i < macro.commands.size(); ++i) {
    const auto& command = macro.commands[i];
    json row;
    row["number"] = i + 1;
    row["offset"] = command.offset;
    row["bytes"] = to_hex(ByteView(macro.body).subspan(command.offset, command.size));
    row["command"] = command.info == nullptr ? ".raw" : std::string(command.info->mnemonic);
    if (command.info != nullptr)
      row["operands"] = operands_of(command);
    if (command.origin != PlacedCommand::Origin::Supplied)
      row["line"] = source.position(command.span.begin).line;
    if (const auto& time = timing.commands[i]) {
      row["beginsMs"] = time->begins_ms;
      row["minimumMs"] = time->least_ms;
      row["maximumMs"] = time->most_ms;
      row["times"] = time->times;
    }
    out["commands"].push_back(std::move(row));
  }
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

/// Prints offset, command number, bytes, times and source, one command per line.
std::string print_listing(std::string_view name, const Source& source, const Assembly& assembly,
                          std::size_t index) {
  const auto& macro = assembly.macros[index];
  const auto image = macro.image();
  const auto timing = assembler::time_macro(assembly, index);
  auto out = fmt::format("{}: id {}, flags {:02X}h, {} bytes, {}\n", name, image.id, image.flags,
                         macro.framed_size(), assembler::to_string(timing));
  out += fmt::format("{:<6}  {:>3}  {:<23}  {:>9}  {:>9}  {}\n", "offset", "#", "bytes", "begins",
                     "waits", "source");
  for (std::size_t i = 0; i < macro.commands.size(); ++i) {
    const auto& command = macro.commands[i];
    const auto& time = timing.commands[i];
    const auto bytes = ByteView(macro.body).subspan(command.offset, command.size);
    const auto repeats = time && time->times > 1 && timing.note != TimingNote::Endless
                             ? fmt::format(" (x{})", time->times)
                             : "";
    out += fmt::format("{:04X}    {:>3}  {:<23}  {:>9}  {:>9}  {}{}\n", command.offset, i + 1,
                       to_hex(bytes.first(std::min(bytes.size(), bytes_per_line))),
                       time ? assembler::print_time(time->begins_ms) : "never",
                       time ? wait_text(*time) : "", source_of(source, command), repeats);
    for (auto at = bytes_per_line; at < bytes.size(); at += bytes_per_line)
      out += fmt::format("{:04X}         {}\n", command.offset + at,
                         to_hex(bytes.subspan(at, std::min(bytes.size() - at, bytes_per_line))));
  }
  return out;
}

std::string print(const Format* format, std::string_view name, const Source& source,
                  const Assembly& assembly, std::size_t index) {
  const auto& macro = assembly.macros[index];
  if (format == nullptr)
    return print_listing(name, source, assembly, index);
  if (format->name == "sphero")
    return std::string(as_text(macro.body));
  if (format->name == "bin")
    return std::string(as_text(protocol::encode(macro.image())));
  if (format->name == "hex")
    return to_hex(protocol::encode(macro.image())) + "\n";
  if (format->name == "c")
    return print_c(name, macro);
  return print_json(name, source, assembly, index);
}

std::string size_of(std::string_view name, const Assembly& assembly, std::size_t index) {
  const auto& macro = assembly.macros[index];
  return fmt::format("{}: {}, {} ({} with id and flags), {}", name,
                     plural(macro.commands.size(), "command"), plural(macro.body.size(), "byte"),
                     macro.framed_size(), to_string(time_macro(assembly, index)));
}

} // namespace

const Format& format_of(std::string_view name, std::string_view ending) {
  for (const auto& format : formats)
    if (format.name == name)
      return format;
  for (const auto& format : formats)
    if (!ending.empty() &&
        fmt::format("{} ", format.endings).find(fmt::format("{} ", ending)) != std::string::npos)
      return format;
  return formats[0];
}

tl::expected<std::vector<Written>, std::string>
write(const Source& source, const Assembly& assembly, const Wanted& wanted) {
  std::vector<Written> all;
  std::vector<std::string> names;
  const auto& format = format_of(wanted.format, wanted.ending);
  const auto ending = format.endings.substr(0, format.endings.find(' '));
  for (std::size_t i = 0; i < assembly.macros.size(); ++i) {
    const auto& given = assembly.macros[i].name;
    names.push_back(given.empty() ? wanted.unnamed : given);
    const auto& name = names.back();
    if (wanted.macro.empty() || wanted.macro == name)
      all.push_back({name, fmt::format("{}{}", name, ending),
                     print(wanted.listing ? nullptr : &format, name, source, assembly, i),
                     format.is_binary && !wanted.listing, size_of(name, assembly, i)});
  }
  if (!all.empty())
    return all;
  return tl::unexpected(fmt::format(
      "{} has no macro `{}`; {}", source.name(), wanted.macro,
      did_you_mean(wanted.macro, names, fmt::format("it has {}", fmt::join(names, ", ")))));
}

} // namespace orb::assembler
