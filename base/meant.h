#pragma once

#include "base/message.h"

#include <span>
#include <string_view>

namespace orb {

/// Returns "did you mean `…`?" with the candidate closest to `word` (base/text/suggest.h), or
/// `otherwise` if none is close.
Message meant_or(std::string_view word, std::span<const std::string_view> candidates,
                 Message otherwise);

} // namespace orb
