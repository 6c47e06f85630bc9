#include "cli/messages.h"

#include "cli/interrupt.h"
#include "cli/json.h"
#include "disk/disk.h"
#include "protocol/describe.h"
#include "spec/basic.h"

#include <fmt/format.h>

namespace orb::cli {
namespace {

using protocol::Async;
using protocol::LinkError;
using spec::AsyncId;

/// How long the built-in ball may be silent before it is asked whether anything still runs.
constexpr Duration look = 100ms;
constexpr std::size_t error_size = 4; // line and code. Source: low-level API §Error Reporting

bool is(const Async& message, AsyncId id) {
  return message.id == static_cast<std::uint8_t>(id);
}

std::string place(const run::LineMap& lines, std::uint32_t robot_line) {
  const auto words = lines.words(robot_line);
  return words.empty() ? words : words + ": ";
}

/// Prints the fault that a ball reports: its number alone where the robot's table has no such.
void print_fault(const Context& context, const Lookup& lookup, std::uint16_t line,
                 std::uint16_t code) {
  const auto known = spec::find_error(code);
  if (known && lookup.input != nullptr) {
    print_fault(context, run::explain(*lookup.input, {}, line, *known, nullptr));
    return;
  }
  const auto where = place(lookup.lines, line);
  const bool named = !where.empty() && lookup.lines.known == run::Known::FileAndColumn;
  print_err(fmt::format("{}{}: {}{}\n", where, context.err_style().paint(Role::Error, "error"),
                        named ? std::string() : fmt::format("line {}: ", line),
                        known ? std::string(spec::info(*known).text)
                              : fmt::format("error {:02X}h", code)));
}

/// A message as JSON; a fault has its place and cause as well.
void print_json_message(const Async& message, const Lookup& lookup, Watched& watched) {
  const auto packet = encode(message);
  protocol::Decoder decoder(protocol::Direction::FromBall);
  protocol::Describer describer;
  decoder.feed(packet);
  const auto item = decoder.next();
  if (!item)
    return;
  auto json = packet_json(describer, *item);
  if (is(message, AsyncId::BasicError) && message.data.size() >= error_size) {
    watched.faulted = true;
    const auto line = read_u16(message.data, 0);
    const auto known = spec::find_error(read_u16(message.data, 2));
    if (known && lookup.input != nullptr) {
      const auto fault = run::explain(*lookup.input, {}, line, *known, nullptr);
      json["file"] = fault.file;
      json["line"] = fault.place.line;
      json["column"] = fault.place.column;
      if (!fault.cause.seen.empty())
        json["detail"] = fault.cause.seen;
      if (const auto& help = fault.cause.help.empty() ? fault.help : fault.cause.help;
          !help.empty())
        json["help"] = help;
    }
  }
  print_json(json);
}

void print_message(const Context& context, const Async& message, const Lookup& lookup,
                   Watched& watched) {
  if (is(message, AsyncId::BasicPrint)) {
    print_out(as_text(message.data));
    return;
  }
  if (is(message, AsyncId::BasicErrorText))
    return; // comes in binary too
  if (is(message, AsyncId::BasicError) && message.data.size() >= error_size) {
    watched.faulted = true;
    print_fault(context, lookup, read_u16(message.data, 0), read_u16(message.data, 2));
    return;
  }
  const auto packet = encode(message);
  protocol::Decoder decoder(protocol::Direction::FromBall);
  protocol::Describer describer;
  decoder.feed(packet);
  if (const auto item = decoder.next())
    print_out(describer.describe(*item) + "\n");
}

} // namespace

void print_fault(const Context& context, const run::Fault& fault) {
  const auto place = fault.place.line == 0
                         ? std::string()
                         : fmt::format(":{}:{}", fault.place.line, fault.place.column);
  const auto& cause = fault.cause;
  const auto line = fault.numbered ? fmt::format("line {}: ", fault.robot_line) : std::string();
  print_err(fmt::format("{}{}: {}: {}{}{}{}\n", fault.file, place,
                        context.err_style().paint(Role::Error, "error"), line,
                        spec::info(fault.code).text, cause.seen.empty() ? "" : ": ", cause.seen));
  const auto& details = cause.seen.empty() ? fault.finding : cause.variables;
  if (!details.empty())
    print_err(fmt::format("  {}\n", details));
  const auto& help = cause.help.empty() ? fault.help : cause.help;
  if (!help.empty())
    print_err(fmt::format("  help: {}\n", help));
}

Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const Lookup& lookup, std::string_view format) {
  Watched watched;
  auto& inbox = session.inbox();
  while (true) {
    while (!inbox.empty()) {
      if (format == "json")
        print_json_message(inbox.front(), lookup, watched);
      else
        print_message(context, inbox.front(), lookup, watched);
      inbox.pop_front();
    }
    const auto resting = link.is_sim && link.ball->idle();
    const auto heard = session.listen(session.now() + look, [&] { return !inbox.empty(); });
    if (!heard) {
      const auto why = heard.error().link.kind;
      watched.lost = why != LinkError::Kind::Interrupted && why != LinkError::Kind::Ended;
      if (watched.lost)
        print_error(context, heard.error().link.message);
      return watched;
    }
    if (resting && inbox.empty())
      return watched;
  }
}

} // namespace orb::cli
