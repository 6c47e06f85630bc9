#pragma once

#include "base/bytes.h"

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

namespace orb::assembler {

/// The contents of a file of bytes: only commands, as the vendor's tools store them, or the whole
/// image with id and flags, as sent to the ball.
enum class Reading : std::uint8_t { Headerless, Framed };

/// Prints source that assembles to the same bytes. The error names the offset and what was expected
/// there. Commands with operands outside their documented range become `.raw` bytes.
tl::expected<std::string, std::string> disassemble(ByteView bytes, Reading reading);

/// True if the bytes form a whole macro in this reading: valid commands, and one End, at the end.
bool is_whole(ByteView bytes, Reading reading);

} // namespace orb::assembler
