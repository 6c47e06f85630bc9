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

/// A macro as it travels: the payload of Save Macro. Source: low-level API §Macro Format.
struct MacroImage {
  std::uint8_t id = spec::macro_id_temporary;
  std::uint8_t flags = 0;
  std::optional<std::uint8_t> extended_flags; ///< there exactly when `flags` has ExtFlags
  Bytes body;                                 ///< commands, with their End

  friend bool operator==(const MacroImage&, const MacroImage&) = default;
};

/// What stands before the commands of an image: id, flags and perhaps extended flags.
struct MacroHeader {
  std::uint8_t id = spec::macro_id_none;
  std::uint8_t flags = 0;
  std::optional<std::uint8_t> extended_flags;
  std::uint32_t size = 0; ///< bytes of the header
};

/// One command in place.
struct MacroStep {
  const spec::MacroCommandInfo* info = nullptr;
  std::uint32_t offset = 0; ///< of its code, in the bytes that were read
  std::uint32_t size = 0;   ///< bytes with the code
  std::array<std::int32_t, spec::macro_max_operands> value{}; ///< by operand; of a text its length
  std::uint32_t text = 0; ///< where the text of a comment begins
};

/// Why bytes are not a macro, and where.
struct MacroError {
  enum class Kind : std::uint8_t {
    NoHeader,    ///< `offset` is where id or flags are missing
    UnknownCode, ///< `byte` is not a command
    CutOperand,  ///< the bytes end where `operand` of `command` should stand
    CutText,     ///< the text of a comment runs past the end
    AfterEnd     ///< there are bytes after End
  };
  Kind kind = Kind::NoHeader;
  std::uint32_t offset = 0;
  std::uint8_t byte = 0;
  const spec::MacroCommandInfo* command = nullptr;
  const spec::MacroOperand* operand = nullptr;
  std::uint32_t wanted = 0;  ///< bytes that the rest of the command needs
  std::uint32_t present = 0; ///< bytes that there are
};

/// What was seen and what was expected: ``offset 12 (0Ch): 16h is not a macro command; …``.
std::string to_string(const MacroError& error);

/// All commands of a macro, or those before the first fault and the fault.
struct MacroListing {
  std::vector<MacroStep> steps;
  std::optional<MacroError> error;
  bool has_end = false;
};

/// The bytes of an image: id, flags, extended flags where the flags say so, body.
Bytes encode(const MacroImage& image);

/// Reads id and flags from the front of an image.
tl::expected<MacroHeader, MacroError> read_macro_header(ByteView bytes);

/// Takes an image apart. The body is not looked at; any bytes will do.
tl::expected<MacroImage, MacroError> decode_macro(ByteView bytes);

/// Reads the command at `offset`, which lies in `bytes`. Never reads past the end, whatever the
/// bytes; operands may lie outside their documented range (spec::is_documented).
tl::expected<MacroStep, MacroError> read_macro_command(ByteView bytes, std::uint32_t offset);

/// Reads all commands of a body, which must end at its first End. A body without End is whole too
/// (`has_end` says so): the robot runs it to its last byte.
MacroListing decode_macro_body(ByteView body);

/// Appends a command. `values` has one value per operand that is not a text; each must fit its
/// width.
void append_macro_command(Bytes& out, spec::MacroCommand command,
                          std::span<const std::int32_t> values, std::string_view text = {});

} // namespace orb::protocol
