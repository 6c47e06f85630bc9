#include "cli/messages.h"

#include "cli/interrupt.h"
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

void print_message(const Context& context, const Async& message, const run::LineMap& lines,
                   Watched& watched) {
  if (is(message, AsyncId::BasicPrint)) {
    print_out(as_text(message.data));
    return;
  }
  if (is(message, AsyncId::BasicErrorText))
    return; // comes in binary too
  if (is(message, AsyncId::BasicError) && message.data.size() >= error_size) {
    watched.faulted = true;
    const auto line = read_u16(message.data, 0);
    const auto code = read_u16(message.data, 2);
    const auto known = spec::find_error(code);
    const auto where = place(lines, line);
    const bool named = !where.empty() && lines.known == run::Known::FileAndColumn;
    print_err(fmt::format("{}{}: {}{}\n", where, context.err_style().paint(Role::Error, "error"),
                          named ? std::string() : fmt::format("line {}: ", line),
                          known ? std::string(spec::info(*known).text)
                                : fmt::format("error {:02X}h", code)));
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

Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const run::LineMap& lines) {
  Watched watched;
  auto& inbox = session.inbox();
  while (true) {
    while (!inbox.empty()) {
      print_message(context, inbox.front(), lines, watched);
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
