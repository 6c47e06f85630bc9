#include "cli/monitoring.h"

#include "cli/interrupt.h"
#include "protocol/describe.h"
#include "spec/basic.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace orb::cli {
namespace {

using protocol::Async;
using spec::AsyncId;

/// How long the built-in ball may be silent before it is asked whether anything still runs.
constexpr Duration look = 100ms;
constexpr std::size_t error_size = 4; // line and code. Source: low-level API §Error Reporting

bool is(const Async& message, AsyncId id) {
  return message.id == static_cast<std::uint8_t>(id);
}

std::string place(const LineMap& lines, std::uint32_t robot_line) {
  const auto found = lines.source_line.find(robot_line);
  if (lines.file.empty() || found == lines.source_line.end())
    return {};
  return fmt::format("{}:{}:1: ", lines.file, found->second);
}

void print_message(const Context& context, const Async& message, const LineMap& lines,
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
    print_err(fmt::format(
        "{}{}: line {}: {}\n", place(lines, line), context.err_style().paint(Role::Error, "error"),
        line, known ? std::string(spec::info(*known).text) : fmt::format("error {:02X}h", code)));
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

LineMap line_map(const std::string& file, const compiler::Image& image) {
  LineMap map{file, {}};
  for (const auto& line : image.lines)
    if (line.number != compiler::none)
      map.source_line.emplace(line.number, line.source_line);
  return map;
}

tl::expected<LineMap, std::string> read_line_map(const std::string& path) {
  const auto text = disk::read(path);
  if (!text)
    return tl::unexpected(text.error().message);
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  LineMap map;
  const auto wrong = fmt::format("{} is not a map that `orb build --map` wrote", path);
  if (!json.is_object() || !json.contains("lines") || !json["lines"].is_array())
    return tl::unexpected(wrong);
  if (json.contains("file") && json["file"].is_string())
    map.file = json["file"].get<std::string>();
  for (const auto& line : json["lines"]) {
    if (!line.is_object() || !line.contains("line") || !line["line"].is_number_unsigned())
      return tl::unexpected(wrong);
    if (line.contains("basicLine") && line["basicLine"].is_number_unsigned())
      map.source_line.emplace(line["basicLine"].get<std::uint32_t>(),
                              line["line"].get<std::uint32_t>());
  }
  return map;
}

Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const LineMap& lines) {
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
      watched.lost = heard.error().link.kind != protocol::LinkError::Kind::Interrupted;
      if (watched.lost)
        print_error(context, heard.error().link.message);
      return watched;
    }
    if (resting && inbox.empty())
      return watched;
  }
}

} // namespace orb::cli
