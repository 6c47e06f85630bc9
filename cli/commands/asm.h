#pragma once

#include "cli/context/context.h"

#include <string>

namespace orb::cli {

/// How to convert macro source to bytes.
struct AsmWay {
  std::string format; ///< empty: the extension of the output file decides, else `sphero`
  std::string macro;  ///< the one macro to write; empty for all
  bool listing = false;
  bool fold_delays = false;
};

/// Runs `orb asm`, and `orb build` of macro source. Assembles `file` (`-` is stdin) and writes the
/// bytes to `out`: empty or `-` is stdout; a folder receives one file per macro.
void run_asm(Context& context, const std::string& file, const AsmWay& way, const std::string& out);

} // namespace orb::cli
