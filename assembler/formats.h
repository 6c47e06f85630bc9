#pragma once

#include "assembler/assemble.h"
#include "base/source.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::assembler {

/// How the bytes of a macro are written.
struct Format {
  std::string_view name;
  std::string_view endings; ///< of files, each with its dot, blank between
  bool is_binary = false;
};

inline constexpr Format formats[] = {
    {"sphero", ".sphero", true}, {"bin", ".bin", true},    {"hex", ".hex", false},
    {"c", ".c .h .inc", false},  {"json", ".json", false},
};

/// The format of that name; without a name, that of files with this ending (`.hex`), else `sphero`.
const Format& format_of(std::string_view name, std::string_view ending);

/// What is to be written of a file of macros.
struct Wanted {
  std::string unnamed;  ///< what a macro without a name is called
  std::string macro;    ///< the name of the one that is wanted; empty for all
  std::string format;   ///< its name; empty: by the ending of the file
  std::string ending;   ///< of the file to write: `.hex`
  bool listing = false; ///< instead of the bytes: offset, bytes, times and source, a line a command
};

/// A macro, written.
struct Written {
  std::string name;
  std::string file_name; ///< `wink.hex`
  std::string text;
  bool is_binary = false;
  std::string size; ///< `wink: 4 commands, 21 bytes (23 with id and flags), 1.2 s`
};

/// The macros of `assembly`, which has no errors, in its order. Fails where none has the wanted
/// name: `dance.macro has no macro `x`; did you mean `y`?`.
tl::expected<std::vector<Written>, std::string>
write(const Source& source, const Assembly& assembly, const Wanted& wanted);

} // namespace orb::assembler
