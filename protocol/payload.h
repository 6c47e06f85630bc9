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

/// A payload field and its value: a number, or bytes if the field is not a number.
struct FieldValue {
  const spec::Field* field = nullptr;
  std::int64_t number = 0;
  ByteView bytes;
};

/// Why a payload does not match its fields, as the ball reports it.
struct PayloadFault {
  spec::ResponseCode code = spec::ResponseCode::BadMessage; ///< BadMessage or BadParameter
  const spec::Field* field = nullptr; ///< for BadParameter: the first field out of range
};

/// Splits `data` into fields. Omits fields beyond its end and ignores bytes after the last field,
/// because records grow with the firmware.
std::vector<FieldValue> read_fields(std::span<const spec::Field> fields, ByteView data);

/// The content for a field: a number, or bytes if the field is not a number.
struct FieldContent {
  FieldContent(std::integral auto value) : number(static_cast<std::int64_t>(value)) {}
  FieldContent(ByteView value) : bytes(value) {}
  FieldContent(const Bytes& value) : bytes(value) {}

  std::int64_t number = 0;
  ByteView bytes;
};

/// Builds a payload from one content per field. Numbers are truncated to their width; bytes are
/// truncated or padded with NUL to a size given by the row.
Bytes write_fields(std::span<const spec::Field> fields, std::span<const FieldContent> contents);

/// Makes a message with the fields of its row.
Async make_async(spec::AsyncId id, std::initializer_list<FieldContent> contents = {});

/// The validated operands of one command, without allocation.
class Operands {
public:
  /// Checks sizes first (BadMessage), then ranges (BadParameter).
  static tl::expected<Operands, PayloadFault> read(spec::ApiCommand command, ByteView data);

  /// Returns the number of an operand; 0 if an optional one is absent.
  std::int64_t number(std::size_t index) const { return numbers_[index]; }
  std::uint8_t u8(std::size_t index) const { return static_cast<std::uint8_t>(numbers_[index]); }
  /// Returns true if the operand was given.
  bool has(std::size_t index) const { return index < count_; }
  /// The bytes of the last operand, if its type is Data.
  ByteView data() const { return data_; }

private:
  static constexpr std::size_t most = 8;
  std::array<std::int64_t, most> numbers_{};
  std::size_t count_ = 0;
  ByteView data_;
};

/// Why operands cannot be encoded: a sentence with what is wrong, then what helps.
struct EncodeError {
  std::string message;
};

/// Builds a command's payload from words as people type them: numbers in decimal or 0x hex, named
/// values such as `flash`, hex for bytes, plain text with \n, \0 and \xHH escapes for text. Checks
/// ranges.
tl::expected<Bytes, EncodeError> encode_operands(spec::ApiCommand command,
                                                 std::span<const std::string> words);

/// Returns the syntax of a command with its operands: `roll SPEED HEADING [GO]`.
std::string usage(const spec::CommandInfo& row);

} // namespace orb::protocol
