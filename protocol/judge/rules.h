#pragma once

#include "base/rules.h"

/// The rules for clients of robots: `rules::WireChecksum`.
namespace orb::protocol::rules {

#define ORB_RULES "protocol/judge/rules.def"
#include "base/rules.inc"

} // namespace orb::protocol::rules
