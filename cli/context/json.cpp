#include "cli/context/json.h"

#include "cli/context/context.h"
#include "cli/model/command.h"

#include <fmt/format.h>

namespace orb::cli {
namespace {

using protocol::Item;

std::string_view kind_name(Item::Kind kind) {
  switch (kind) {
  case Item::Kind::Command: return "command";
  case Item::Kind::Response: return "response";
  case Item::Kind::Async: return "message";
  case Item::Kind::Noise: return "noise";
  case Item::Kind::BadChecksum: return "bad-checksum";
  case Item::Kind::Fragment: return "incomplete";
  }
  return "";
}

} // namespace

void add_format_option(const Command& command, std::string& format) {
  command.add_option("--format", format, "text, or JSON for other programs")
      .check(one_of({"text", "json"}))
      .show_default();
}

void put_fields(Json& json, const protocol::Parts& parts) {
  auto fields = Json::object();
  auto meanings = Json::object();
  for (const auto& field : parts.fields) {
    const Json value = field.number ? Json(*field.number) : Json(field.text);
    if (!fields.contains(field.name))
      fields[field.name] = value;
    else if (fields[field.name].is_array()) // each frame of a stream repeats the sensor names
      fields[field.name].push_back(value);
    else
      fields[field.name] = Json::array({fields[field.name], value});
    if (field.number && !field.text.empty())
      meanings[field.name] = field.text;
  }
  json["fields"] = std::move(fields);
  if (!meanings.empty())
    json["meanings"] = std::move(meanings);
  if (!parts.rest.empty())
    json["data"] = to_hex(parts.rest);
}

Json packet_json(protocol::Describer& describer, const Item& item) {
  Json json;
  json["kind"] = kind_name(item.kind);
  const bool whole = item.kind == Item::Kind::Command || item.kind == Item::Kind::Response ||
                     item.kind == Item::Kind::Async;
  if (whole) {
    const auto parts = describer.parts(item);
    if (!parts.name.empty())
      json["name"] = parts.name;
    if (item.kind == Item::Kind::Command) {
      json["did"] = item.did;
      json["cid"] = item.cid;
    } else {
      json[item.kind == Item::Kind::Response ? "code" : "id"] = item.code;
    }
    if (item.kind != Item::Kind::Async)
      json["seq"] = item.seq;
    put_fields(json, parts);
  }
  json["raw"] = to_hex(item.raw);
  return json;
}

Json message_json(const protocol::Async& message) {
  const auto packet = encode(message);
  protocol::Describer describer;
  return packet_json(describer, item_of(message, packet));
}

void print_json(const Json& json) {
  print_out(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace orb::cli
