#pragma once

#include "compiler/lint/lint.h"

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// The robot that a program is meant for, as options: `--target`, `--ram`, `--area`.
struct TargetOptions {
  std::string version;
  std::int32_t ram = 0; ///< 0 where not given
  std::string area = "ram";

  compiler::Target target() const;
};

/// Adds the options to a command. `--target` also comes from `ORB_TARGET`.
void add_target_options(const Command& command, TargetOptions& options);

} // namespace orb::cli
