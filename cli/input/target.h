#pragma once

#include "compiler/lint/lint.h"

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// Options for the robot that a program targets: `--target`, `--ram`, `--area`.
struct TargetOptions {
  std::string version;
  std::int32_t ram = 0; ///< 0 if not given
  std::string area = "ram";

  compiler::Target target() const;
};

/// Adds the options. `ORB_TARGET` also sets `--target`.
void add_target_options(const Command& command, TargetOptions& options);

} // namespace orb::cli
