#pragma once

#include "protocol/packet.h"

#include <array>
#include <concepts>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::protocol {

/// One field of a payload with its value: a number, or bytes where the field is not a number.
struct FieldValue {
  const spec::Field* field = nullptr;
  std::int64_t number = 0;
  ByteView bytes;
};

/// Why a payload does not suit its fields, as the ball answers it.
struct PayloadFault {
  spec::ResponseCode code = spec::ResponseCode::BadMessage; ///< BadMessage or BadParameter
  const spec::Field* field = nullptr; ///< of a BadParameter: the first that is out of its range
};

/// The fields of `data` by their rows. Fields that the data is too short for are left out; bytes
/// after the last field are ignored: records grow with the firmware.
std::vector<FieldValue> read_fields(std::span<const spec::Field> fields, ByteView data);

/// What a field is filled with: a number, or bytes where the field is not a number.
struct FieldContent {
  FieldContent(std::integral auto value) : number(static_cast<std::int64_t>(value)) {}
  FieldContent(ByteView value) : bytes(value) {}
  FieldContent(const Bytes& value) : bytes(value) {}

  std::int64_t number = 0;
  ByteView bytes;
};

/// The payload of these fields, one content a field: numbers are cut to their width, bytes are cut
/// or filled up with NUL where the row gives their size.
Bytes write_fields(std::span<const spec::Field> fields, std::span<const FieldContent> contents);

/// A message with the fields of its row.
Async make_async(spec::AsyncId id, std::initializer_list<FieldContent> contents = {});

/// The checked operands of one command, without allocation.
class Operands {
public:
  /// Checks sizes first (BadMessage), then ranges (BadParameter).
  static tl::expected<Operands, PayloadFault> read(spec::ApiCommand command, ByteView data);

  /// The number of the `index`-th operand; 0 where an optional one is absent.
  std::int64_t number(std::size_t index) const { return numbers_[index]; }
  std::uint8_t u8(std::size_t index) const { return static_cast<std::uint8_t>(numbers_[index]); }
  /// Whether the `index`-th operand was given.
  bool has(std::size_t index) const { return index < count_; }
  /// The bytes of the last operand, where it is Data.
  ByteView data() const { return data_; }

private:
  static constexpr std::size_t most = 8;
  std::array<std::int64_t, most> numbers_{};
  std::size_t count_ = 0;
  ByteView data_;
};

/// A sentence about operands that cannot be encoded: what was seen, then what helps.
struct EncodeError {
  std::string message;
};

/// Builds the payload of a command from words as people type them: numbers in decimal or 0x hex,
/// named values such as `flash`, hex for bytes, plain text with \n, \0 and \xHH escapes for text.
/// Ranges are checked.
tl::expected<Bytes, EncodeError> encode_operands(spec::ApiCommand command,
                                                 std::span<const std::string> words);

/// How the command is called with its operands: `roll SPEED HEADING [GO]`.
std::string usage(const spec::CommandInfo& row);

} // namespace orb::protocol
