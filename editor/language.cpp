#include "editor/language.h"

namespace orb::editor::nothing {

Occurrences occurrences(const Source&, std::uint32_t, const LanguageOptions&) {
  return {};
}

std::vector<Rewrite> rewrites(const Source&, const LanguageOptions&) {
  return {};
}

} // namespace orb::editor::nothing
