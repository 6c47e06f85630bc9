// The tables of the API.

#include "reference/sections.h"
#include "spec/api.h"
#include "spec/firmware.h"

#include <fmt/format.h>

namespace orb::reference {
namespace {

std::string_view describe(spec::Status status) {
  switch (status) {
  case spec::Status::Implemented: return "implemented";
  case spec::Status::Factory: return "refused with 05h: works only at the factory";
  case spec::Status::Unsupported: return "refused with 05h: no firmware supports it";
  case spec::Status::Password: return "refused with 0Bh: the password is not public";
  case spec::Status::Bootloader: return "refused with 09h";
  }
  return "";
}

std::string_view describe(spec::Retry retry) {
  switch (retry) {
  case spec::Retry::No: return "no";
  case spec::Retry::SameAgain: return "send the same packet again";
  case spec::Retry::Later: return "send it again when the ball's state has changed";
  case spec::Retry::StartOver: return "repeat the whole operation";
  }
  return "";
}

std::string_view type_name(spec::FieldType type) {
  switch (type) {
  case spec::FieldType::U8: return "u8";
  case spec::FieldType::U16: return "u16";
  case spec::FieldType::U32: return "u32";
  case spec::FieldType::U64: return "u64";
  case spec::FieldType::S16: return "s16";
  case spec::FieldType::S32: return "s32";
  case spec::FieldType::Data: return "bytes";
  case spec::FieldType::Data32: return "32 bytes";
  case spec::FieldType::Text12: return "text of 12 bytes";
  case spec::FieldType::Text16: return "text of 16 bytes";
  }
  return "";
}

/// Describes a field briefly: `u16 heading 0 to 359 deg`, with the range if the table has one.
std::string describe(const spec::Field& field) {
  const bool exact =
      field.type == spec::FieldType::Data && field.least == field.most && field.most > 0;
  auto out = fmt::format("{}{} {}", exact ? fmt::format("{} ", field.most) : "",
                         type_name(field.type), field.name);
  if (field.least < field.most)
    out += fmt::format(" {} to {}{}", field.least, field.most,
                       spec::is_number(field.type) ? "" : " bytes");
  if (!field.unit.empty() && field.unit != field.name)
    out += fmt::format(" {}", field.unit);
  if (field.presence == spec::Presence::Optional)
    out += " (optional)";
  return out;
}

std::string describe(std::span<const spec::Field> fields) {
  std::string out;
  for (const auto& field : fields)
    out += (out.empty() ? "" : ", ") + describe(field);
  return out;
}

} // namespace

Section api_commands_section() {
  Section section{"api-commands", "API commands", "API command", {}};
  section.overview = "| DID CID | command | virtual ball | source |\n|---|---|---|---|\n";
  for (const auto& row : spec::api_commands) {
    const auto did = spec::did(row.command);
    const auto cid = spec::cid(row.command);
    Entry entry;
    entry.name = row.name;
    entry.aliases = {fmt::format("{:02X}h {:02X}h", did, cid)};
    entry.summary = row.summary;
    section.overview += fmt::format("| {:02X}h {:02X}h | [{}](#{}) | {} | {} |\n", did, cid,
                                    row.name, row.name, describe(row.status), row.source);
    entry.facts.emplace_back("DID CID", fmt::format("{:02X}h {:02X}h", did, cid));
    if (const auto fields = spec::operands(row.command); !fields.empty())
      entry.facts.emplace_back("takes", describe(fields));
    const auto fields = spec::answer(row.command);
    entry.facts.emplace_back("answers", fields.empty() ? "a simple response" : describe(fields));
    entry.facts.emplace_back("virtual ball", describe(row.status));
    entry.facts.emplace_back("may be repeated",
                             row.idempotent == spec::Idempotent::Yes ? "yes" : "no");
    entry.facts.emplace_back("since",
                             fmt::format("API {}.{:02}", row.since.major, row.since.minor));
    entry.facts.emplace_back("source", row.source);
    entry.code.emplace_back("example", fmt::format("orb encode {}{}{}", row.name,
                                                   row.example.empty() ? "" : " ", row.example));
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section api_messages_section() {
  Section section{"api-messages", "Asynchronous messages", "API message", {}};
  for (const auto& row : spec::asyncs) {
    Entry entry;
    entry.name = row.name;
    entry.summary = row.summary;
    entry.facts.emplace_back("id", fmt::format("{:02X}h", static_cast<unsigned>(row.id)));
    entry.facts.emplace_back("fields", describe(spec::fields(row.id)));
    entry.facts.emplace_back("turned on by", row.enabler);
    entry.facts.emplace_back("source", row.source);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section responses_section() {
  Section section{"responses", "Response codes", "response code", {}};
  for (const auto& row : spec::responses) {
    Entry entry;
    entry.name = fmt::format("MRSP {:02X}h", static_cast<unsigned>(row.code));
    entry.aliases = {std::string(row.name), std::string(row.constant)};
    entry.summary = row.meaning;
    entry.facts.emplace_back("vendor's name", row.constant);
    entry.facts.emplace_back("again", describe(row.retry));
    entry.facts.emplace_back("what helps", row.remedy);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section streams_section() {
  Section section{"streams", "Data streaming sources", "stream", {}};
  for (const auto& row : spec::streams) {
    Entry entry;
    entry.name = row.name;
    const bool first = row.mask <= 0xFFFFFFFFU;
    entry.summary = fmt::format("bit {:08X}h of {}", first ? row.mask : row.mask >> 32,
                                first ? "MASK" : "MASK2");
    entry.facts.emplace_back("range", fmt::format("{} to {}", row.least, row.most));
    entry.facts.emplace_back("unit", row.unit);
    section.entries.push_back(std::move(entry));
  }
  return section;
}

Section firmwares_section() {
  Section section{"firmwares", "Firmware of the virtual ball", "firmware", {}};
  for (const auto& row : spec::firmwares) {
    Entry entry;
    entry.name = row.name;
    entry.summary = row.summary;
    std::string record;
    for (const auto byte : row.record())
      record += fmt::format("{}{:02X}", record.empty() ? "" : " ", byte);
    entry.facts.emplace_back("version record", record);
    entry.facts.emplace_back("orbBasic RAM", row.has_orbbasic()
                                                 ? fmt::format("{} bytes", row.ram_bytes())
                                                 : "no orbBasic");
    entry.facts.emplace_back("API", fmt::format("{}.{:02}", row.api.major, row.api.minor));
    entry.facts.emplace_back("Level 2 diagnostics",
                             row.level_2 == spec::Level2::Supported ? "supported" : "refused");
    section.entries.push_back(std::move(entry));
  }
  return section;
}

} // namespace orb::reference
