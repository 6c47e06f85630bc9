#pragma once

#include "assembler/assemble.h"
#include "base/source.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::assembler {

/// An output format for the bytes of a macro.
struct Format {
  std::string_view name;
  std::string_view endings; ///< file extensions, each with its dot, space-separated
  bool is_binary = false;
};

inline constexpr Format formats[] = {
    {"sphero", ".sphero", true}, {"bin", ".bin", true},    {"hex", ".hex", false},
    {"c", ".c .h .inc", false},  {"json", ".json", false},
};

/// Finds a format by name; without a name, by the file extension (`.hex`), else `sphero`.
const Format& format_of(std::string_view name, std::string_view ending);

/// What to write of a file of macros.
struct Wanted {
  std::string unnamed;  ///< the name for a macro without one
  std::string macro;    ///< the name of the macro to write; empty: all
  std::string format;   ///< its name; empty: by the file extension
  std::string ending;   ///< extension of the file to write: `.hex`
  bool listing = false; ///< print a listing instead of the bytes: offset, bytes, times and source
};

/// A macro in its output format.
struct Written {
  std::string name;
  std::string file_name; ///< `wink.hex`
  std::string text;
  bool is_binary = false;
  std::string size; ///< `wink: 4 commands, 21 bytes (23 with id and flags), 1.2 s`
};

/// Writes the macros of `assembly`, which must have no errors, in order. Fails if none has the
/// wanted name: `dance.macro has no macro `x`; did you mean `y`?`.
tl::expected<std::vector<Written>, std::string>
write(const Source& source, const Assembly& assembly, const Wanted& wanted);

} // namespace orb::assembler
