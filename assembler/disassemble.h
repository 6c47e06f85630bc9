#pragma once

#include "base/bytes.h"

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

namespace orb::assembler {

/// What a file of bytes is: commands alone, as the vendor's tools store them, or the whole image
/// with id and flags, as it travels.
enum class Reading : std::uint8_t { Headerless, Framed };

/// Source that assembles to the same bytes. The error names the offset and what was expected there.
/// Commands whose operands lie outside their documented range come out as `.raw` bytes.
tl::expected<std::string, std::string> disassemble(ByteView bytes, Reading reading);

/// Whether the bytes make a whole macro in this reading: all commands, one End, at the end.
bool is_whole(ByteView bytes, Reading reading);

} // namespace orb::assembler
