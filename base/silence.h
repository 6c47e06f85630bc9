#pragma once

#include "base/diagnostic.h"

#include <span>
#include <string_view>
#include <vector>

namespace orb {

/// What a comment begins with that allows findings: `orb: allow RULE, RULE…`.
inline constexpr std::string_view allow_mark = "orb: allow";

/// A comment that holds the mark.
struct AllowComment {
  Span comment; ///< up to the end of its line
  Span about;   ///< where findings of the rules it names may begin: on its line or the next one
};

/// Leaves out the findings that a comment of `text` allows, and adds one of rule `unknown` for each
/// name in them that is not a rule of `table`.
void silence(std::string_view text, std::span<const AllowComment> comments,
             std::span<const Rule> table, const Rule& unknown, std::vector<Diagnostic>& findings);

} // namespace orb
