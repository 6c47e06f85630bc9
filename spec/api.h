#pragma once

#include "spec/carried.h"

#include <array>
#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The API of the robot: packets, commands, answers and messages. Source: API, PKT.
namespace orb::spec {

inline constexpr std::uint8_t sop1 = 0xFF;
inline constexpr std::size_t sop_size = 2; ///< SOP1 and SOP2, not covered by the checksum
/// SOP2 of a command is F8h to FFh: the two low bits are options, bits 2 and 3 are ignored.
inline constexpr std::uint8_t sop2_least = 0xF8;
inline constexpr std::uint8_t sop2_default = 0xFF;
inline constexpr std::uint8_t sop2_answer = 0x01;        ///< bit 0: send an answer
inline constexpr std::uint8_t sop2_reset_timeout = 0x02; ///< bit 1: reset the inactivity timer
inline constexpr std::uint8_t sop2_response = 0xFF;
inline constexpr std::uint8_t sop2_async = 0xFE;

constexpr bool is_sop2(std::uint8_t byte) {
  return byte >= sop2_least;
}

/// Sizes of the headers before the data.
inline constexpr std::size_t command_header_size = 6;  ///< SOP1 SOP2 DID CID SEQ DLEN
inline constexpr std::size_t response_header_size = 5; ///< SOP1 SOP2 MRSP SEQ DLEN
inline constexpr std::size_t async_header_size = 5;    ///< SOP1 SOP2 ID DLEN-MSB DLEN-LSB

/// DLEN counts the data and the checksum. For a few commands, FFh means a fixed longer payload.
inline constexpr std::uint8_t dlen_long = 0xFF;
inline constexpr std::size_t max_payload = dlen_long - 1;
/// Async messages with a longer payload are treated as noise: no document describes one [?].
inline constexpr std::size_t max_async_payload = 4096;

/// The ball drops an incomplete packet if the next byte takes longer (UPLOAD quirk).
inline constexpr std::chrono::milliseconds fragment_timeout{500};

inline constexpr std::size_t ssb_modifier_size = 272;
inline constexpr std::size_t ssb_size = 1024;
inline constexpr std::size_t password_size = 4;
inline constexpr std::size_t config_block_size = 1024; ///< REC

/// The options of a sender after a refused command. Source: UPLOAD.
enum class Retry : std::uint8_t {
  No,        ///< the same packet will be refused again
  SameAgain, ///< not executed: send it again at once
  Later,     ///< not executed: send it again after the ball's state has changed
  StartOver  ///< unknown how much was executed: repeat the whole operation
};

enum class ResponseCode : std::uint8_t {
#define RESPONSE(enumerator, code, retry, constant, meaning, remedy) enumerator = code,
#include "spec/responses.def"
#undef RESPONSE
};

struct ResponseInfo {
  ResponseCode code;
  Retry retry;
  std::string_view name;     ///< the enumerator
  std::string_view constant; ///< its name in the vendor's header
  std::string_view meaning;
  std::string_view remedy; ///< empty for success
};

inline constexpr auto responses = std::to_array<ResponseInfo>({
#define RESPONSE(enumerator, code, retry, constant, meaning, remedy)                               \
  {ResponseCode::enumerator, Retry::retry, #enumerator, constant, meaning, remedy},
#include "spec/responses.def"
#undef RESPONSE
});

/// Finds the row of a response code; null if no document names it.
const ResponseInfo* find_response(std::uint8_t code);
/// How to react to a response code; nothing if no document names it.
Retry retry_of(std::uint8_t code);

/// A command: the device id in the high byte, the command id in the low one.
enum class ApiCommand : std::uint16_t {
#define COMMAND(enumerator, did, cid, ...) enumerator = (did) << 8 | (cid),
#include "spec/api.def"
};

constexpr std::uint8_t did(ApiCommand command) {
  return static_cast<std::uint8_t>(static_cast<std::uint16_t>(command) >> 8);
}
constexpr std::uint8_t cid(ApiCommand command) {
  return static_cast<std::uint8_t>(static_cast<std::uint16_t>(command));
}
/// Combines the numbers of a command; the result may be a value without a row.
constexpr ApiCommand api_command(std::uint8_t did, std::uint8_t cid) {
  return static_cast<ApiCommand>(did << 8 | cid);
}

inline constexpr std::uint8_t did_core = 0x00;
inline constexpr std::uint8_t did_bootloader = 0x01;
inline constexpr std::uint8_t did_sphero = 0x02;

/// True if the command belongs to orbBasic, which some robots lack.
constexpr bool is_orbbasic(ApiCommand command) {
  return command >= ApiCommand::EraseOrbbasicStorage && command <= ApiCommand::CommitRamToFlash70;
}

/// How the simulated ball treats a command: executes it or refuses it. Source: UPLOAD.
enum class Status : std::uint8_t {
  Implemented,
  Factory,     ///< answers 05h: works only at the factory
  Unsupported, ///< answers 05h: no firmware implements it
  Password,    ///< answers 0Bh: the password is not public
  Bootloader   ///< answers 09h: the simulated bootloader accepts only leave-bootloader
};

enum class Idempotent : std::uint8_t { No, Yes };
enum class Presence : std::uint8_t { Required, Optional };

/// The encoding of a field; numbers are sent most significant byte first.
enum class FieldType : std::uint8_t {
  U8,
  U16,
  U32,
  U64,
  S16,
  S32,
  Data,   ///< all remaining bytes
  Data32, ///< exactly 32 bytes
  Text12, ///< exactly 12 bytes of text
  Text16  ///< exactly 16 bytes of text, padded with NUL
};

/// The size of a field in bytes; 0 for Data, which takes the rest.
constexpr std::size_t field_size(FieldType type) {
  switch (type) {
  case FieldType::U8: return 1;
  case FieldType::U16:
  case FieldType::S16: return 2;
  case FieldType::U32:
  case FieldType::S32: return 4;
  case FieldType::U64: return 8;
  case FieldType::Text12: return 12;
  case FieldType::Text16: return 16;
  case FieldType::Data32: return 32;
  case FieldType::Data: return 0;
  }
  return 0;
}

constexpr bool is_number(FieldType type) {
  return type <= FieldType::S32;
}

/// One operand of a command, or one field of an answer or message.
struct Field {
  std::uint16_t owner; ///< the code of the command or message
  FieldType type;
  std::string_view name;
  std::int64_t least; ///< range of a number, or of the size of Data; only operands have one
  std::int64_t most;
  Presence presence;
  std::string_view unit; ///< a unit, or a subject of spec/names.def with spaces for `_`
};

/// A revision of the API document.
struct Revision {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;

  friend constexpr auto operator<=>(const Revision&, const Revision&) = default;
};

struct CommandInfo {
  ApiCommand command;
  std::string_view name; ///< kebab-case, as in `orb encode` and `orb exec`
  Status status;
  Idempotent idempotent;
  Revision since; ///< the first revision that documents it
  std::string_view source;
  std::string_view example; ///< operands as for `orb encode NAME`
  std::string_view summary;
};

inline constexpr auto api_commands = std::to_array<CommandInfo>({
#define COMMAND(enumerator, did, cid, name, status, idempotent, major, minor, source, example,     \
                summary)                                                                           \
  carried(CommandInfo{ApiCommand::enumerator,                                                      \
                      name,                                                                        \
                      Status::status,                                                              \
                      Idempotent::idempotent,                                                      \
                      {major, minor},                                                              \
                      source,                                                                      \
                      example,                                                                     \
                      summary}),
#include "spec/api.def"
});

/// Two operands of a command that must keep a minimum distance.
struct Distance {
  ApiCommand command;
  std::size_t upper; ///< index of the operand
  std::size_t lower;
  std::int64_t least; ///< minimum of `upper` - `lower`, in the unit of both
};

/// Finds the row of a command; null for most.
const Distance* distance(ApiCommand command);

/// The fields of all answers, in the order of the commands.
inline constexpr auto answer_rows = std::to_array<Field>({
#define ANSWER_FIELD(enumerator, type, name, presence, unit)                                       \
  {static_cast<std::uint16_t>(ApiCommand::enumerator),                                             \
   FieldType::type,                                                                                \
   name,                                                                                           \
   0,                                                                                              \
   0,                                                                                              \
   Presence::presence,                                                                             \
   unit},
#define ANSWER(enumerator, type, name, unit) ANSWER_FIELD(enumerator, type, name, Required, unit)
#define ANSWER_MORE(enumerator, type, name, unit)                                                  \
  ANSWER_FIELD(enumerator, type, name, Optional, unit)
#include "spec/api.def"
});
#undef ANSWER_FIELD

/// The offset of a field in an answer. An unknown field name does not compile.
consteval std::size_t answer_offset(ApiCommand command, std::string_view field) {
  std::size_t offset = 0;
  for (const auto& row : answer_rows) {
    if (row.owner != static_cast<std::uint16_t>(command))
      continue;
    if (row.name == field)
      return offset;
    offset += field_size(row.type);
  }
  throw "the answer has no such field";
}

/// The operands of a command, in wire order.
std::span<const Field> operands(ApiCommand command);
/// The fields of its answer; empty for a Simple Response.
std::span<const Field> answer(ApiCommand command);

/// Finds a command by its numbers or its name; null if there is none.
const CommandInfo* find_command(std::uint8_t did, std::uint8_t cid);
const CommandInfo* find_command(std::string_view name);
/// The row of an enumerator.
const CommandInfo& info(ApiCommand command);

/// The messages that the ball sends unsolicited.
enum class AsyncId : std::uint8_t {
#define ASYNC(enumerator, code, ...) enumerator = code,
#include "spec/async.def"
};

/// How a message arrives: unsolicited, or as the rest of an answer that only announced it.
enum class Arrival : std::uint8_t { Unasked, AsAnswer };

struct AsyncInfo {
  AsyncId id;
  std::string_view name;    ///< kebab-case
  std::string_view enabler; ///< the command that enables it, DID and CID; empty if none does
  Arrival arrival;
  std::string_view source;
  std::string_view summary;
};

inline constexpr auto asyncs = std::to_array<AsyncInfo>({
#define ASYNC(enumerator, code, name, enabler, arrival, source, summary)                           \
  {AsyncId::enumerator, name, enabler, Arrival::arrival, source, summary},
#include "spec/async.def"
});

std::span<const Field> fields(AsyncId id);

/// The records of spec/records.def, and the offsets of their fields.
std::span<const Field> config_fields();
namespace config_at {
enum : std::size_t {
#define CONFIG_FIELD(enumerator, type, name, unit) enumerator,
#include "spec/records.def"
};
} // namespace config_at
std::span<const Field> soul_fields();
namespace soul_at {
enum : std::size_t {
#define SOUL_FIELD(enumerator, type, name, unit) enumerator,
#include "spec/records.def"
};
} // namespace soul_at
std::span<const Field> life_fields();
namespace life_at {
enum : std::size_t {
#define LIFE_FIELD(enumerator, type, name, unit) enumerator,
#include "spec/records.def"
};
} // namespace life_at

/// Finds the row of a message id; null if there is none.
const AsyncInfo* find_async(std::uint8_t id);

// Values and bits of fields: a namespace per subject, such as power_state::charging.
#define NAMED_VALUE(subject, name, value, text)                                                    \
  namespace subject {                                                                              \
  inline constexpr std::uint8_t name = value;                                                      \
  }
#define NAMED_BIT(subject, name, bit, text)                                                        \
  namespace subject {                                                                              \
  inline constexpr std::uint32_t name = std::uint32_t{1} << (bit);                                 \
  }
#include "spec/names.def"

/// The storage areas for programs, by their number in commands. Source: API §Erase orbBasic
/// Storage.
enum class Area : std::uint8_t { Ram = area::ram, Flash = area::flash };

/// A named value or bit of the fields whose unit is `subject`.
struct Named {
  std::string_view subject;
  std::uint32_t value; ///< the value, or the mask of the bit
  std::string_view text;
};

/// The name of a value of a subject such as `power state`; empty if it has none.
std::string_view value_name(std::string_view subject, std::uint32_t value);
/// The names of the set bits, comma-separated; empty if none is set or the subject has no bits.
std::string bit_names(std::string_view subject, std::uint32_t value);

/// The sources of data streaming. Source: API §Set Data Streaming.
enum class StreamSource : std::uint8_t {
#define STREAM(enumerator, ...) enumerator,
#include "spec/streams.def"
#undef STREAM
};

struct StreamInfo {
  StreamSource source;
  std::uint64_t mask; ///< MASK in the low 32 bits, MASK2 in the high ones
  std::string_view name;
  std::int32_t least;
  std::int32_t most;
  std::string_view unit; ///< of one LSB
};

/// In the order of their values in a frame.
inline constexpr auto streams = std::to_array<StreamInfo>({
#define STREAM(enumerator, word, bit, name, least, most, unit)                                     \
  {StreamSource::enumerator,                                                                       \
   std::uint64_t{1} << (((word)-1) * 32 + (bit)),                                                  \
   name,                                                                                           \
   least,                                                                                          \
   most,                                                                                           \
   unit},
#include "spec/streams.def"
#undef STREAM
});

/// The fixed payload size that DLEN FFh means for this command; 0 if FFh is an ordinary length.
constexpr std::size_t long_payload(std::uint8_t did, std::uint8_t cid) {
  if (did != did_sphero)
    return 0;
  const auto command = api_command(did, cid);
  return command == ApiCommand::SetSsbModifierBlock     ? password_size + ssb_modifier_size
         : command == ApiCommand::SetConfigurationBlock ? config_block_size
         : command == ApiCommand::SetSsb                ? password_size + ssb_size
                                                        : 0;
}

} // namespace orb::spec
