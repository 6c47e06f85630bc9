#pragma once

// Private to repair/.

#include "base/diagnostic.h"
#include "repair/scenery.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {

/// Rewrites foreign blocks (`if c then` … `else` … `end if`, `while c:` …) over several lines of a
/// numbered program as jumps.
struct BlockRewrite {
  std::map<std::uint32_t, std::string> lines; ///< the new text of each; empty: remove it
  std::vector<Edit> edits;                    ///< all edits, including added lines
  bool sure = true;                           ///< its end was written
};

/// Finds the outermost blocks of a program, each with its contents. `parses` tells if a line is
/// valid as it is. A block without an end is included only if it is an endless loop at the end of
/// the program.
std::vector<BlockRewrite> blocks_as_jumps(const Source& source, const Scenery& scenery,
                                          const std::function<bool(std::string_view)>& parses);

} // namespace orb::repair
