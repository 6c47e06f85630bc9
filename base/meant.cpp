#include "base/meant.h"

#include "base/text/suggest.h"
#include "base/texts.h"

#include <utility>

namespace orb {

Message meant_or(std::string_view word, std::span<const std::string_view> candidates,
                 Message otherwise) {
  const auto meant = closest(word, candidates);
  return meant && *meant != word ? texts::DidYouMean(*meant) : std::move(otherwise);
}

} // namespace orb
