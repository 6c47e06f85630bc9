#include "run/began.h"

#include "protocol/payload.h"
#include "spec/basic.h"

#include <fmt/format.h>

namespace orb::run {
namespace {

/// `line 20: Divide by zero`, or with the source place if the source has no line numbers.
std::string fault_in_words(const LineMap& lines, const ReportedFault& fault) {
  const auto known = spec::find_error(fault.code);
  const auto where = lines.words(fault.line);
  return fmt::format(
      "{}: {}",
      where.empty() || lines.known != Known::FileAndColumn ? fmt::format("line {}", fault.line)
                                                           : where,
      known ? std::string(spec::info(*known).text) : fmt::format("error {:02X}h", fault.code));
}

} // namespace

std::optional<ReportedFault> fault_in(const protocol::Async& message) {
  if (message.id != static_cast<std::uint8_t>(spec::AsyncId::BasicError))
    return std::nullopt;
  const auto fields = protocol::read_fields(spec::fields(spec::AsyncId::BasicError), message.data);
  if (fields.size() != 2)
    return std::nullopt;
  return ReportedFault{static_cast<std::uint16_t>(fields[0].number),
                       static_cast<std::uint16_t>(fields[1].number)};
}

Began watch_start(uploader::Session& session, const LineMap& lines) {
  Began began;
  if (const auto heard = uploader::await_start(session); !heard)
    began.unheard = heard.error();
  for (const auto& message : session.inbox())
    if (const auto fault = fault_in(message); fault && !began.fault)
      began.fault = fault;
  if (!began.fault)
    return began;
  began.words = fmt::format("the program stopped at {}", fault_in_words(lines, *began.fault));
  if (!uploader::brake(session))
    began.words += "; the ball may be rolling: it has not acknowledged a stop";
  return began;
}

} // namespace orb::run
