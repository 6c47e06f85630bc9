#pragma once

#include "cli/context/context.h"

#include <string>

namespace orb::cli {

/// How macro source becomes bytes.
struct AsmWay {
  std::string format; ///< empty: the ending of the file to write says it, else `sphero`
  std::string macro;  ///< the one to write; empty for all
  bool listing = false;
  bool fold_delays = false;
};

/// `orb asm`; `orb build` of macro source does the same. Assembles `file` (`-` is stdin) and writes
/// the bytes to `out`: empty or `-` is stdout, a folder takes a file per macro.
void run_asm(Context& context, const std::string& file, const AsmWay& way, const std::string& out);

} // namespace orb::cli
