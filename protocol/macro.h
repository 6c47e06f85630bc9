#pragma once

#include "base/bytes.h"
#include "spec/macro.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::protocol {

/// A macro as it is transferred: the payload of Save Macro. Source: low-level API §Macro Format.
struct MacroImage {
  std::uint8_t id = spec::macro_id_temporary;
  std::uint8_t flags = 0;
  std::optional<std::uint8_t> extended_flags; ///< present exactly if `flags` has ExtFlags
  Bytes body;                                 ///< commands, including End

  friend bool operator==(const MacroImage&, const MacroImage&) = default;
};

/// The header of an image: id, flags and perhaps extended flags.
struct MacroHeader {
  std::uint8_t id = spec::macro_id_none;
  std::uint8_t flags = 0;
  std::optional<std::uint8_t> extended_flags;
  std::uint32_t size = 0; ///< bytes of the header
};

/// One command and its place.
struct MacroStep {
  const spec::MacroCommandInfo* info = nullptr;
  std::uint32_t offset = 0;                                   ///< of its code, in the bytes read
  std::uint32_t size = 0;                                     ///< in bytes, including the code
  std::array<std::int32_t, spec::macro_max_operands> value{}; ///< by operand; for a text its length
  std::uint32_t text = 0;                                     ///< offset of a comment's text
};

/// Why bytes are not a macro, and where.
struct MacroError {
  enum class Kind : std::uint8_t {
    NoHeader,    ///< id or flags are missing at `offset`
    UnknownCode, ///< `byte` is not a command
    CutOperand,  ///< the bytes end before `operand` of `command`
    CutText,     ///< the text of a comment exceeds the bytes
    AfterEnd     ///< bytes follow End
  };
  Kind kind = Kind::NoHeader;
  std::uint32_t offset = 0;
  std::uint8_t byte = 0;
  const spec::MacroCommandInfo* command = nullptr;
  const spec::MacroOperand* operand = nullptr;
  std::uint32_t wanted = 0;  ///< bytes that the rest of the command needs
  std::uint32_t present = 0; ///< bytes available
};

/// Returns what was found and what was expected: ``offset 12 (0Ch): 16h is not a macro command;
/// …``.
std::string to_string(const MacroError& error);

/// All commands of a macro, or those before the first error, and the error.
struct MacroListing {
  std::vector<MacroStep> steps;
  std::optional<MacroError> error;
  bool has_end = false;
};

/// Returns the bytes of an image: id, flags, extended flags if present, body.
Bytes encode(const MacroImage& image);

/// Parses id and flags at the front of an image.
tl::expected<MacroHeader, MacroError> read_macro_header(ByteView bytes);

/// Splits an image. The body is not checked; any bytes will do.
tl::expected<MacroImage, MacroError> decode_macro(ByteView bytes);

/// Parses the command at `offset`, which must lie in `bytes`. Never reads past the end, whatever
/// the bytes. Operands may exceed their documented range (spec::is_documented).
tl::expected<MacroStep, MacroError> read_macro_command(ByteView bytes, std::uint32_t offset);

/// Parses all commands of a body, which must end at its first End. A body without End is complete,
/// too (see `has_end`): the robot runs it to its last byte.
MacroListing decode_macro_body(ByteView body);

/// Appends a command. `values` has one value per operand other than a text; each must fit its
/// width.
void append_macro_command(Bytes& out, spec::MacroCommand command,
                          std::span<const std::int32_t> values, std::string_view text = {});

} // namespace orb::protocol
