#pragma once

#include "cli/context/context.h"

#include <string>

namespace orb::cli {

struct AsmOptions {
  std::string file;
  std::string out;    ///< empty or `-` is stdout; a folder takes a file per macro
  std::string format; ///< empty: the ending of `out` says it, else `sphero`
  std::string macro;  ///< the one to write; empty for all
  bool listing = false;
  bool fold_delays = false;
};

/// `orb asm`; `orb build` of macro source does the same.
void run_asm(Context& context, const AsmOptions& options);

} // namespace orb::cli
