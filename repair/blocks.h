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

/// Blocks of other languages (`if c then` … `else` … `end if`, `while c:` …), over several lines of
/// a program with line numbers, as the jumps that they are there.
struct BlockRewrite {
  std::map<std::uint32_t, std::string> lines; ///< what each becomes; empty: it is left out
  std::vector<Edit> edits;                    ///< all of it, lines that are added included
  bool sure = true;                           ///< its end was written
};

/// The outermost blocks of a program, each with all that is in it. `parses` says of a line whether
/// the language knows it as it is. Of blocks without an end only loops for ever are among them,
/// where the program ends with their lines.
std::vector<BlockRewrite> blocks_as_jumps(const Source& source, const Scenery& scenery,
                                          const std::function<bool(std::string_view)>& parses);

} // namespace orb::repair
