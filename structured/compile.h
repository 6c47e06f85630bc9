#pragma once

#include "base/diagnostic.h"
#include "compiler/lint.h"
#include "structured/code.h"
#include "structured/files.h"
#include "structured/letters.h"
#include "structured/names.h"
#include "structured/print.h"
#include "structured/program.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// A structured program, all that is to be said about it, and, where no error was found, the lines
/// of the robot that it becomes.
struct Compiled {
  Program program;
  Names names;
  Code code;
  Letters letters;
  RobotText robot;             ///< empty where there are errors, or nothing to run
  std::size_t image_bytes = 0; ///< of the packed image
  bool runs = false;           ///< whether there is a program to run

  bool has_errors() const;
};

/// Compiles a structured program. `path` is what the files it names count from; they are read
/// through `files`. Any bytes will do. The variables `kept` have a letter of their own and hold
/// their values to the end, read or not: what somebody looks at from outside.
Compiled compile(std::string name, std::string path, std::string_view text,
                 const compiler::Target& target, Files& files,
                 const std::vector<std::string>& kept = {});

/// The letter that holds a variable of the whole program, 0 for A; nothing where none has that
/// name, or where it is neither kept nor in use.
std::optional<std::uint8_t> letter_of(const Compiled& compiled, std::string_view name);

/// That a program holds nothing that would run, which `check` allows and every other command
/// refuses.
Diagnostic nothing_to_run();

/// The same lines numbered 10 by 10, with the names of subs and variables and the lines of the
/// source in comments: a valid program that does the same.
std::string readable(const Compiled& compiled);

/// A place in one of a program's files.
struct Place {
  std::uint32_t file = 0; ///< index into Program::files
  Span span;              ///< in that file
};
Place place_of(const Program& program, Span span);

/// The findings about each file, with spans in that file's own text, in the order of the files.
std::vector<std::vector<Diagnostic>> findings_by_file(const Program& program);

} // namespace orb::structured
