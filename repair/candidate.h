#pragma once

#include "base/message.h"

#include <string>

namespace orb::repair {

/// A statement, or several with `\n` between them, that a line may have been meant to be: without
/// the number in front and the comment behind.
struct Candidate {
  std::string text;
  int cost = 0;                   ///< in tenths of a changed token; a slip of the hand is below 10
  const orb::Text* why = nullptr; ///< what is said beside the line; null where nothing is
  bool sure = true;               ///< nothing else can have been meant
};

} // namespace orb::repair
