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

/// Compiles a structured program. `path` is what the files it names count from; they are read
/// through `files`. Any bytes will do. The variables `kept` have a letter of their own and hold
/// their values to the end, read or not: what somebody looks at from outside.
Compiled compile(std::string name, std::string path, std::string_view text,
                 const compiler::Target& target, Files& files,
                 const std::vector<std::string>& kept = {}, Shape shape = Shape::Shortest);

/// The robot's lines, parsed. They refer to `compiled`, which must stay where it is, and can be
/// taken once.
compiler::Program take_lines(Compiled& compiled);

/// The letter that holds a variable of the whole program, 0 for A; nothing where none has that
/// name, or where it is neither kept nor in use.
std::optional<std::uint8_t> letter_of(const Compiled& compiled, std::string_view name);

/// That a program holds nothing that would run, which `check` allows and every other command
/// refuses.
Diagnostic nothing_to_run();

/// The same lines numbered 10 by 10, with the names of subs and variables and the lines of the
/// source in comments: a valid program that does the same.
std::string readable(const Compiled& compiled);

} // namespace orb::structured
