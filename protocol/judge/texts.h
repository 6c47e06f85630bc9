#pragma once

#include "base/texts.h"

/// The texts about clients of robots: `texts::WrongChecksum(command)`.
namespace orb::protocol::texts {

using namespace orb::texts;

#define ORB_TEXTS "protocol/judge/rules.def"
#include "base/texts.inc"

} // namespace orb::protocol::texts
