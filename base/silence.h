#pragma once

#include "base/diagnostic.h"

#include <span>
#include <string_view>
#include <vector>

namespace orb {

/// The start of a comment that allows findings: `orb: allow RULE, RULE…`.
inline constexpr std::string_view allow_mark = "orb: allow";

/// A comment with the mark.
struct AllowComment {
  Span comment; ///< up to the end of its line
  Span about;   ///< where an allowed finding may begin: on this line or the next one
};

/// Removes the findings allowed by a comment of `text`, and adds one of rule `unknown` for each
/// name in a comment that is not a rule of `table`.
void silence(std::string_view text, std::span<const AllowComment> comments,
             std::span<const Rule> table, const Rule& unknown, std::vector<Diagnostic>& findings);

} // namespace orb
