#include "playground/engine/log_link.h"

namespace orb::playground {
namespace {

protocol::LinkError read_error(const ordered_json& error) {
  const auto kind = error.value("kind", "broken");
  return {kind == "closed"        ? protocol::LinkError::Kind::Closed
          : kind == "interrupted" ? protocol::LinkError::Kind::Interrupted
                                  : protocol::LinkError::Kind::Broken,
          error.value("message", "")};
}

} // namespace

Done read_done(const ordered_json& message) {
  Done done{Instant{} + duration_of(message.at("at").get<double>()), {}, {}};
  if (const auto bytes = message.find("bytes"); bytes != message.end())
    done.bytes = bytes_of(*bytes);
  if (const auto error = message.find("error"); error != message.end())
    done.error = read_error(*error);
  return done;
}

} // namespace orb::playground
