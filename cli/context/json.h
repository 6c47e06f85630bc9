#pragma once

#include "protocol/describe.h"

#include <nlohmann/json.hpp>
#include <string>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

using Json = nlohmann::ordered_json;

/// Adds `--format text|json`.
void add_format_option(const Command& command, std::string& format);

/// The fields of a packet by name: numbers and texts; what numbers stand for is a second object.
void put_fields(Json& json, const protocol::Parts& parts);

/// One thing found on the wire: a packet with its fields, or bytes that are not a packet
/// (docs/json.md).
Json packet_json(protocol::Describer& describer, const protocol::Item& item);

/// A message of the ball, as packet_json() tells it.
Json message_json(const protocol::Async& message);

/// Prints a value on a line of its own.
void print_json(const Json& json);

} // namespace orb::cli
