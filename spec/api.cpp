#include "spec/api.h"

#include <algorithm>

namespace orb::spec {
namespace {

constexpr auto operand_rows = std::to_array<Field>({
#define OPERAND(enumerator, type, name, least, most, presence, unit)                               \
  {static_cast<std::uint16_t>(ApiCommand::enumerator),                                             \
   FieldType::type,                                                                                \
   name,                                                                                           \
   least,                                                                                          \
   most,                                                                                           \
   Presence::presence,                                                                             \
   unit},
#include "spec/api.def"
});

constexpr auto distance_rows = std::to_array<Distance>({
#define DISTANCE(enumerator, upper, lower, least) {ApiCommand::enumerator, upper, lower, least},
#include "spec/api.def"
});

constexpr auto async_rows = std::to_array<Field>({
#define ASYNC_FIELD(enumerator, type, name, unit)                                                  \
  {static_cast<std::uint16_t>(AsyncId::enumerator),                                                \
   FieldType::type,                                                                                \
   name,                                                                                           \
   0,                                                                                              \
   0,                                                                                              \
   Presence::Required,                                                                             \
   unit},
#include "spec/async.def"
});

#define RECORD_ROW(type, name, unit) {0, FieldType::type, name, 0, 0, Presence::Required, unit},
constexpr auto config_rows = std::to_array<Field>({
#define CONFIG_FIELD(enumerator, type, name, unit) RECORD_ROW(type, name, unit)
#include "spec/records.def"
});
constexpr auto soul_rows = std::to_array<Field>({
#define SOUL_FIELD(enumerator, type, name, unit) RECORD_ROW(type, name, unit)
#include "spec/records.def"
});
constexpr auto life_rows = std::to_array<Field>({
#define LIFE_FIELD(enumerator, type, name, unit) RECORD_ROW(type, name, unit)
#include "spec/records.def"
});
#undef RECORD_ROW

constexpr auto value_rows = std::to_array<Named>({
#define NAMED_VALUE(subject, name, value, text) {#subject, value, text},
#include "spec/names.def"
});

constexpr auto bit_rows = std::to_array<Named>({
#define NAMED_BIT(subject, name, bit, text) {#subject, std::uint32_t{1} << (bit), text},
#include "spec/names.def"
});

/// True if `code` ascends strictly over the rows.
template <class Rows, class Code>
constexpr bool ascending(const Rows& rows, Code code) {
  return std::adjacent_find(std::begin(rows), std::end(rows), [code](const auto& a, const auto& b) {
           return a.*code >= b.*code;
         }) == std::end(rows);
}

constexpr bool follow_owners(std::span<const Field> rows) {
  return std::is_sorted(rows.begin(), rows.end(),
                        [](const Field& a, const Field& b) { return a.owner < b.owner; });
}

template <class Rows>
constexpr bool unique_names(const Rows& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (rows[i].name == rows[j].name)
        return false;
  return true;
}

static_assert(ascending(api_commands, &CommandInfo::command), "commands ascend by DID and CID");
static_assert(ascending(responses, &ResponseInfo::code), "response codes ascend");
static_assert(ascending(asyncs, &AsyncInfo::id), "async ids ascend");
static_assert(follow_owners(operand_rows), "operands follow their row");
static_assert(follow_owners(answer_rows), "answers follow their row");
static_assert(follow_owners(async_rows), "fields follow their row");
static_assert(unique_names(api_commands) && unique_names(asyncs) && unique_names(streams));

std::span<const Field> owned_by(std::span<const Field> rows, std::uint16_t owner) {
  const auto first = std::partition_point(rows.begin(), rows.end(),
                                          [&](const Field& row) { return row.owner < owner; });
  const auto last =
      std::partition_point(first, rows.end(), [&](const Field& row) { return row.owner == owner; });
  return {first, last};
}

/// Finds the row whose `column` equals `value`; null if there is none.
template <class Rows, class Column, class Value>
const auto* find_row(const Rows& rows, Column column, const Value& value) {
  const auto* found = std::find_if(rows.data(), rows.data() + rows.size(),
                                   [&](const auto& row) { return row.*column == value; });
  return found == rows.data() + rows.size() ? nullptr : found;
}

/// Compares subjects: `power state` equals the namespace power_state.
bool same_subject(std::string_view row, std::string_view subject) {
  return std::equal(row.begin(), row.end(), subject.begin(), subject.end(),
                    [](char a, char b) { return a == b || (a == '_' && b == ' '); });
}

} // namespace

const ResponseInfo* find_response(std::uint8_t code) {
  return find_row(responses, &ResponseInfo::code, static_cast<ResponseCode>(code));
}

Retry retry_of(std::uint8_t code) {
  const auto* row = find_response(code);
  return row == nullptr ? Retry::No : row->retry;
}

std::span<const Field> operands(ApiCommand command) {
  return owned_by(operand_rows, static_cast<std::uint16_t>(command));
}

const Distance* distance(ApiCommand command) {
  return find_row(distance_rows, &Distance::command, command);
}

std::span<const Field> answer(ApiCommand command) {
  return owned_by(answer_rows, static_cast<std::uint16_t>(command));
}

const CommandInfo* find_command(std::uint8_t did, std::uint8_t cid) {
  const auto command = api_command(did, cid);
  const auto* found =
      std::partition_point(api_commands.begin(), api_commands.end(),
                           [&](const CommandInfo& row) { return row.command < command; });
  return found == api_commands.end() || found->command != command ? nullptr : found;
}

const CommandInfo* find_command(std::string_view name) {
  return find_row(api_commands, &CommandInfo::name, name);
}

const CommandInfo& info(ApiCommand command) {
  return *find_command(did(command), cid(command));
}

std::span<const Field> fields(AsyncId id) {
  return owned_by(async_rows, static_cast<std::uint16_t>(id));
}

std::span<const Field> config_fields() {
  return config_rows;
}

std::span<const Field> soul_fields() {
  return soul_rows;
}

std::span<const Field> life_fields() {
  return life_rows;
}

const AsyncInfo* find_async(std::uint8_t id) {
  return find_row(asyncs, &AsyncInfo::id, static_cast<AsyncId>(id));
}

std::string_view value_name(std::string_view subject, std::uint32_t value) {
  for (const auto& row : value_rows)
    if (row.value == value && same_subject(row.subject, subject))
      return row.text;
  return {};
}

std::string bit_names(std::string_view subject, std::uint32_t value) {
  std::string out;
  for (const auto& row : bit_rows)
    if ((row.value & value) != 0 && same_subject(row.subject, subject)) {
      if (!out.empty())
        out += ", ";
      out += row.text;
    }
  return out;
}

} // namespace orb::spec
