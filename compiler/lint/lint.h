#pragma once

#include "base/diagnostic.h"
#include "compiler/text/program.h"
#include "spec/api.h"
#include "spec/basic.h"
#include "spec/robots.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace orb::compiler {

using spec::Area;

/// The robot that a program is written for.
struct Target {
  spec::BasicVersion version = spec::default_basic_version;
  Area area = Area::Ram;
  /// Size of the RAM area: 1024, 3072 or 4096 bytes. Nothing: the most of this version, with a
  /// warning above the size that every robot has.
  std::optional<std::int32_t> ram_bytes;
  /// The robot that drives; nothing: any.
  std::optional<spec::Robot> robot = {};
};

/// The bytes that `target` has for a program, including the final NUL.
std::int32_t area_bytes(const Target& target);

/// Returns all findings about a program, in text order. Findings silenced by a comment `' orb:
/// allow RULE` are left out.
std::vector<Diagnostic> lint(const Program& program, const Target& target);

/// Of these, only findings about what the program does, independent of notation. Also applied to
/// structured programs, whose compiled lines have words of their own.
std::vector<Diagnostic> lint_meaning(const Program& program, const Target& target);

/// Of these, only features that the robot lacks.
std::vector<Diagnostic> robot_findings(const Program& program, spec::Robot robot);

} // namespace orb::compiler
