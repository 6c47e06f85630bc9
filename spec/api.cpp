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

/// Whether `code` ascends strictly over the rows.
template <class Rows, class Code>
constexpr bool ascending(const Rows& rows, Code code) {
  return std::ranges::adjacent_find(rows, std::ranges::greater_equal{}, code) == std::end(rows);
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
static_assert(std::ranges::is_sorted(operand_rows, {}, &Field::owner), "operands follow their row");
static_assert(std::ranges::is_sorted(answer_rows, {}, &Field::owner), "answers follow their row");
static_assert(std::ranges::is_sorted(async_rows, {}, &Field::owner), "fields follow their row");
static_assert(unique_names(api_commands) && unique_names(asyncs) && unique_names(streams));

template <class Rows>
std::span<const Field> owned_by(const Rows& rows, std::uint16_t owner) {
  const auto* first = std::ranges::lower_bound(rows, owner, {}, &Field::owner);
  const auto* last = std::ranges::upper_bound(rows, owner, {}, &Field::owner);
  return {first, last};
}

/// `power state` is the namespace power_state.
bool same_subject(std::string_view row, std::string_view subject) {
  return std::ranges::equal(row, subject,
                            [](char a, char b) { return a == b || (a == '_' && b == ' '); });
}

} // namespace

const ResponseInfo* find_response(std::uint8_t code) {
  const auto* found =
      std::ranges::find(responses, static_cast<ResponseCode>(code), &ResponseInfo::code);
  return found == responses.end() ? nullptr : found;
}

Retry retry_of(std::uint8_t code) {
  const auto* row = find_response(code);
  return row == nullptr ? Retry::No : row->retry;
}

std::span<const Field> operands(ApiCommand command) {
  return owned_by(operand_rows, static_cast<std::uint16_t>(command));
}

const Distance* distance(ApiCommand command) {
  const auto* found = std::ranges::find(distance_rows, command, &Distance::command);
  return found == distance_rows.end() ? nullptr : found;
}

std::span<const Field> answer(ApiCommand command) {
  return owned_by(answer_rows, static_cast<std::uint16_t>(command));
}

const CommandInfo* find_command(std::uint8_t did, std::uint8_t cid) {
  const auto command = api_command(did, cid);
  const auto* found = std::ranges::lower_bound(api_commands, command, {}, &CommandInfo::command);
  return found == api_commands.end() || found->command != command ? nullptr : found;
}

const CommandInfo* find_command(std::string_view name) {
  const auto* found = std::ranges::find(api_commands, name, &CommandInfo::name);
  return found == api_commands.end() ? nullptr : found;
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
  const auto* found = std::ranges::find(asyncs, static_cast<AsyncId>(id), &AsyncInfo::id);
  return found == asyncs.end() ? nullptr : found;
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
