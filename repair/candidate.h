#pragma once

#include "base/message.h"

#include <string>

namespace orb::repair {

/// A proposed replacement for a line: a statement, or several separated by `\n`, without line
/// number and comment.
struct Candidate {
  std::string text;
  int cost = 0;                   ///< in tenths of a changed token; below 10: a typo
  const orb::Text* why = nullptr; ///< a remark shown beside the line; null: none
  bool sure = true;               ///< no other meaning is possible
};

} // namespace orb::repair
