#pragma once

#include "base/diagnostic.h"
#include "compiler/lint/lint.h"
#include "structured/emit/compiled.h"
#include "structured/optimise/optimise.h"
#include "structured/text/files.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// Compiles a structured program. Included paths are relative to `path` and are read through
/// `files`. Accepts any bytes. The variables `kept` get letters of their own and keep their values
/// to the end, read or not, so that they can be inspected from outside.
Compiled compile(std::string name, std::string path, std::string_view text,
                 const compiler::Target& target, Files& files,
                 const std::vector<std::string>& kept = {}, Shape shape = Shape::Shortest);

/// Takes the robot's lines, parsed; call it once. They refer to `compiled`, which must stay in
/// place.
compiler::Program take_lines(Compiled& compiled);

/// The letter of a global variable, 0 for A; nothing if there is no such variable, or if it is
/// neither kept nor used.
std::optional<std::uint8_t> letter_of(const Compiled& compiled, std::string_view name);

/// The finding about a program without statements. `check` allows it, every other command refuses
/// it.
Diagnostic nothing_to_run();

/// The same lines numbered by 10, with comments that give the names of subs and variables and the
/// source lines: a valid program with the same behaviour.
std::string readable(const Compiled& compiled);

} // namespace orb::structured
