#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// The API of the robot: packets, commands, answers and messages. Source: API, PKT.
namespace orb::spec {

inline constexpr std::uint8_t sop1 = 0xFF;
inline constexpr std::size_t sop_size = 2; ///< SOP1 and SOP2, which no checksum covers
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

/// DLEN counts the data and the checksum; FFh means a fixed longer payload for a few commands.
inline constexpr std::uint8_t dlen_long = 0xFF;
inline constexpr std::size_t max_payload = dlen_long - 1;
/// An async message with a longer payload is taken for noise: no document describes one [?].
inline constexpr std::size_t max_async_payload = 4096;

/// How long the ball waits for the next byte of a packet before it drops it (UPLOAD quirk).
inline constexpr std::chrono::milliseconds fragment_timeout{500};

inline constexpr std::size_t ssb_modifier_size = 272;
inline constexpr std::size_t ssb_size = 1024;
inline constexpr std::size_t password_size = 4;
inline constexpr std::size_t config_block_size = 256; ///< [?]

/// What the sender of a refused command may do next. Source: UPLOAD.
enum class Retry : std::uint8_t {
  No,        ///< the same packet will be refused again
  SameAgain, ///< the packet was not executed: send it again at once
  Later,     ///< the packet was not executed: send it again when the ball's state has changed
  StartOver  ///< it is not known what was executed: repeat the whole operation
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
  std::string_view constant; ///< in the vendor's header
  std::string_view meaning;
  std::string_view remedy; ///< empty for success
};

inline constexpr auto responses = std::to_array<ResponseInfo>({
#define RESPONSE(enumerator, code, retry, constant, meaning, remedy)                               \
  {ResponseCode::enumerator, Retry::retry, #enumerator, constant, meaning, remedy},
#include "spec/responses.def"
#undef RESPONSE
});

/// The row of a response code; null for a value that no document names.
const ResponseInfo* find_response(std::uint8_t code);

/// A command: the device id in the high byte, the command id in the low one.
enum class ApiCommand : std::uint16_t {
#define COMMAND(enumerator, did, cid, name) enumerator = (did) << 8 | (cid),
#include "spec/api.def"
#undef COMMAND
};

constexpr std::uint8_t did(ApiCommand command) {
  return static_cast<std::uint8_t>(static_cast<std::uint16_t>(command) >> 8);
}
constexpr std::uint8_t cid(ApiCommand command) {
  return static_cast<std::uint8_t>(static_cast<std::uint16_t>(command));
}
constexpr ApiCommand api_command(std::uint8_t did, std::uint8_t cid) {
  return static_cast<ApiCommand>(did << 8 | cid);
}

/// The fixed payload that DLEN FFh stands for with this command; 0 where FFh is an ordinary length.
constexpr std::size_t long_payload(std::uint8_t did, std::uint8_t cid) {
  const auto command = api_command(did, cid);
  return command == ApiCommand::SetSsbModifierBlock     ? password_size + ssb_modifier_size
         : command == ApiCommand::SetConfigurationBlock ? config_block_size
         : command == ApiCommand::SetSsb                ? password_size + ssb_size
                                                        : 0;
}

} // namespace orb::spec
