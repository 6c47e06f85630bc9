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

/// The robot that a program is meant for.
struct Target {
  spec::BasicVersion version = spec::default_basic_version;
  Area area = Area::Ram;
  /// Bytes of the RAM area: 1024, 3072 or 4096. Nothing means: the most that the version has, with
  /// a warning above what every robot has.
  std::optional<std::int32_t> ram_bytes;
  /// Which robot drives; nothing: any.
  std::optional<spec::Robot> robot = {};
};

/// The bytes that `target` offers for a program, final NUL included.
std::int32_t area_bytes(const Target& target);

/// Everything that is to be said about a program, in the order of its text; empty for a program
/// that is fine. What a comment `' orb: allow RULE` silences is left out.
std::vector<Diagnostic> lint(const Program& program, const Target& target);

/// Of these what the program does that cannot work or can hardly be meant, however it is written:
/// what is said of a structured program, too, once it is lines whose words are its own.
std::vector<Diagnostic> lint_meaning(const Program& program, const Target& target);

/// Of these only what the robot does not have.
std::vector<Diagnostic> robot_findings(const Program& program, spec::Robot robot);

} // namespace orb::compiler
