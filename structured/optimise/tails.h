#pragma once

#include "structured/lower/code.h"

namespace orb::structured {

/// Merges the common tails of paths that meet: removes the lines of one path and redirects it to
/// the other. Returns true if there were any.
bool merge_tails(Code& code);

} // namespace orb::structured
